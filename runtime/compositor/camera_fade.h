// A camera's image that takes another's place, or the pattern's, comes softly.
#pragma once
#include "runtime/compositor/panel_inputs.h"

namespace arift
{

class CameraFade
{
public:
	static constexpr XrDuration duration = 300 * millisecond;
	/// Sets the weights of the camera images by how long, in display time, each eye has been shown the camera it is shown now.
	void apply(PanelInputs &inputs);

private:
	struct Shown {
		std::optional<uint32_t> lens;
		XrTime since = 0;
	};
	std::array<Shown, 2> shown_;
};

} // namespace arift
