#include "runtime/compositor/assemble.h"
#include "runtime/motion/view_poses.h"

namespace arift
{

namespace
{

/// An eye's camera image: its own, else the other's.
std::optional<CameraView> cameraView(const Rig &rig, const ipc::ViewTable &views, const PoseHistory &poses, XrTime displayTime,
									 const Latched &latched, uint32_t eye)
{
	for (const uint32_t lens : {eye, 1 - eye}) {
		if (!latched.cameras[lens] || lens >= rig.cameras.size()) continue;
		const CameraImage &image = *latched.cameras[lens];
		if (displayTime - image.frame.midExposure > oldestImage) continue;
		const XrPosef head = headInOrigin(views, poses.at(image.frame.midExposure));
		return CameraView{.frame = image.frame,
						  .cameraInOrigin = head * rig.cameras[lens].cameraInHead,
						  .lens = lens,
						  .blackLevel = image.blackLevel,
						  .whiteBalance = image.whiteBalance,
						  .linear = image.linear};
	}
	return std::nullopt;
}

} // namespace

PanelInputs assemble(const Rig &rig, const ipc::ViewTable &views, const PoseHistory &poses, XrTime displayTime, Latched latched)
{
	PanelInputs inputs{.displayTime = displayTime, .blendMode = latched.blendMode, .passthroughDistance = latched.passthroughDistance};
	const XrDuration toEdge = XrDuration(double(rig.timing.lineTime) * (rig.lens.panel().height - 1) / 2);
	for (uint32_t eye = 0; eye < 2; ++eye) {
		inputs.cameras[eye] = cameraView(rig, views, poses, displayTime, latched, eye);
		const auto viewAt = [&](XrTime time) {
			const XrPosef head = headInOrigin(views, poses.at(time));
			const XrPosef then = inputs.cameras[eye] ? headInOrigin(views, poses.at(inputs.cameras[eye]->frame.midExposure)) : head;
			return ViewAtLine{viewInOrigin(views, eye, head, then), head};
		};
		inputs.top[eye] = viewAt(displayTime - toEdge);
		inputs.bottom[eye] = viewAt(displayTime + toEdge);
	}
	inputs.layers = std::move(latched.layers);
	return inputs;
}

} // namespace arift
