// Where OpenXR's reference spaces lie in the origin frame, and how one moves as seen from another (specification, chapter "Spaces").
#pragma once
#include "runtime/ipc/pages.h"
#include "runtime/motion/motion_sample.h"

namespace arift
{

/// A frame at one instant: metres, metres per second and radians per second, all along the axes of the frame it is given in.
struct FrameMotion {
	XrPosef pose = identityPose;
	XrVector3f linearVelocity{0, 0, 0}; ///< of the frame's own origin
	XrVector3f angularVelocity{0, 0, 0};
};

/// A frame fixed in a moving one: `childInParent` never changes.
FrameMotion carried(const FrameMotion &parent, const XrPosef &childInParent);

/// How `frame` moves for somebody who sits in `base`; both are given in one third frame. This is what xrLocateSpace answers.
FrameMotion relativeTo(const FrameMotion &base, const FrameMotion &frame);

/// VIEW: the head, with the velocity that turning about the neck gives it. Moves; the other three stand still.
FrameMotion viewSpaceInOrigin(const ipc::ViewTable &views, const HeadMotion &head);
/// LOCAL: level, where the head was when it was last recentred.
XrPosef localInOrigin(const ipc::ViewTable &views);
/// LOCAL_FLOOR: LOCAL lowered to the floor.
XrPosef localFloorInOrigin(const ipc::ViewTable &views);
/// STAGE: on the floor below the origin frame; recentring does not move it.
XrPosef stageInOrigin(const ipc::ViewTable &views);

/// The table with LOCAL where the head would be if it looked straight ahead, level, in the heading it has; the floor stays where it is.
ipc::ViewTable recentred(const ipc::ViewTable &views, const HeadMotion &head);

} // namespace arift
