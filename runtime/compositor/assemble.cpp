#include "runtime/compositor/assemble.h"
#include "runtime/motion/view_poses.h"

namespace arift
{

namespace
{

/// An eye's camera image, its own, else the other's; and where the head was when it was exposed.
struct SeenImage {
	CameraView view;
	XrPosef head;
};
std::optional<SeenImage> seenImage(const Rig &rig, const ipc::ViewTable &views, const PoseMoment &poses, XrTime displayTime,
								   const Latched &latched, uint32_t eye)
{
	for (const uint32_t lens : {eye, 1 - eye}) {
		if (!latched.cameras[lens] || lens >= rig.cameras.size()) continue;
		const CameraImage &image = *latched.cameras[lens];
		if (displayTime - image.frame.midExposure > oldestImage) continue;
		const XrPosef head = headInOrigin(views, poses.at(image.frame.midExposure));
		return SeenImage{{.frame = image.frame,
						  .cameraInOrigin = head * rig.cameras[lens].cameraInHead,
						  .lens = lens,
						  .blackLevel = image.blackLevel,
						  .whiteBalance = image.whiteBalance,
						  .linear = image.linear},
						 head};
	}
	return std::nullopt;
}

} // namespace

PanelInputs assemble(const Rig &rig, const ipc::ViewTable &views, const PoseMoment &poses, XrTime displayTime, Latched latched)
{
	PanelInputs inputs{.displayTime = displayTime, .blendMode = latched.blendMode, .passthroughDistance = latched.passthroughDistance};
	const XrDuration toEdge = XrDuration(double(rig.timing.lineTime) * (rig.lens.panel().height - 1) / 2);
	const XrPosef top = headInOrigin(views, poses.at(displayTime - toEdge)), bottom = headInOrigin(views, poses.at(displayTime + toEdge));
	for (uint32_t eye = 0; eye < 2; ++eye) {
		const std::optional<SeenImage> seen = seenImage(rig, views, poses, displayTime, latched, eye);
		if (seen) inputs.cameras[eye] = seen->view;
		inputs.top[eye] = {viewInOrigin(views, eye, top, seen ? seen->head : top), top};
		inputs.bottom[eye] = {viewInOrigin(views, eye, bottom, seen ? seen->head : bottom), bottom};
	}
	inputs.layers = std::move(latched.layers);
	return inputs;
}

} // namespace arift
