// Poses, camera images and layers at one display time -> PanelInputs. Pure: asks what the pose history holds at one moment and nobody else.
#pragma once
#include "runtime/compositor/camera_feed.h"
#include "runtime/compositor/panel_inputs.h"
#include "runtime/ipc/pages.h"
#include "runtime/motion/pose_history.h"
#include "runtime/optics/rig.h"

namespace arift
{

/// What was newest when the compositor looked.
struct Latched {
	std::array<std::optional<CameraImage>, 2> cameras; ///< left, right; nothing where the camera is lost
	std::vector<PanelLayer> layers;                    ///< bottom first
	XrEnvironmentBlendMode blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	double passthroughDistance = 2; ///< metres
};

/// An image older than this when it is shown is no image: a frozen world must not look alive.
constexpr XrDuration oldestImage = 1 * second;

/// `displayTime` is the middle line's. Each eye gets its own camera's image, or the other's when its own is lost or too old. The views
/// stand where the shared rule puts them (motion/view_poses.h), for the image that is really shown.
PanelInputs assemble(const Rig &rig, const ipc::ViewTable &views, const PoseMoment &poses, XrTime displayTime, Latched latched);

} // namespace arift
