#include "runtime/compositor/camera_fade.h"
#include <algorithm>

namespace arift
{

void CameraFade::apply(PanelInputs &inputs)
{
	for (size_t eye = 0; eye < 2; ++eye) {
		auto &camera = inputs.cameras[eye];
		const std::optional<uint32_t> lens = camera ? std::optional(camera->lens) : std::nullopt;
		Shown &shown = shown_[eye];
		if (lens != shown.lens) shown = {lens, inputs.displayTime};
		if (camera) camera->weight = float(std::clamp(double(inputs.displayTime - shown.since) / double(duration), 0.0, 1.0));
	}
}

} // namespace arift
