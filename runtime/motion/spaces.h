// Where OpenXR's reference spaces lie in the origin frame, and how one moves as seen from another (specification, chapter "Spaces").
// What every pose asked for goes through is inline.
#pragma once
#include "runtime/motion/view_poses.h"

namespace arift
{

/// A frame at one instant: metres, metres per second and radians per second, all along the axes of the frame it is given in.
struct FrameMotion {
	XrPosef pose = identityPose;
	XrVector3f linearVelocity{0, 0, 0}; ///< of the frame's own origin
	XrVector3f angularVelocity{0, 0, 0};
};

/// A frame fixed in another: `childInParent` never changes. As a pose alone, or with how it moves.
inline XrPosef carried(const XrPosef &parent, const XrPosef &childInParent) { return parent * childInParent; }
inline FrameMotion carried(const FrameMotion &parent, const XrPosef &childInParent)
{
	const XrVector3f arm = rotate(parent.pose.orientation, childInParent.position);
	return {{parent.pose.orientation * childInParent.orientation, parent.pose.position + arm},
			parent.linearVelocity + cross(parent.angularVelocity, arm),
			parent.angularVelocity};
}

/// Where `frame` is, and how it moves, for somebody who sits in `base`; both are given in one third frame. What xrLocateSpace answers.
inline XrPosef relativeTo(const XrPosef &base, const XrPosef &frame)
{
	const XrQuaternionf toBase = inverse(base.orientation);
	return {toBase * frame.orientation, rotate(toBase, frame.position - base.position)};
}
inline FrameMotion relativeTo(const FrameMotion &base, const FrameMotion &frame)
{
	const XrQuaternionf toBase = inverse(base.pose.orientation);
	const XrVector3f arm = frame.pose.position - base.pose.position;
	const XrVector3f linear = frame.linearVelocity - base.linearVelocity - cross(base.angularVelocity, arm);
	return {relativeTo(base.pose, frame.pose), rotate(toBase, linear), rotate(toBase, frame.angularVelocity - base.angularVelocity)};
}

/// VIEW: the head, with the velocity that turning about the neck gives it. Moves; the other three stand still.
inline FrameMotion viewSpaceInOrigin(const ipc::ViewTable &views, const HeadMotion &head)
{
	const NeckModel neck{views.pivotInHead};
	const XrVector3f rate = rotate(head.at.headInOrigin, head.at.angularVelocity);
	const XrPosef pose = neck.head(head.at.headInOrigin);
	return {pose, cross(rate, pose.position - neck.pivotInHead), rate};
}
/// LOCAL: level, where the head was when it was last recentred.
inline XrPosef localInOrigin(const ipc::ViewTable &views) { return views.localInOrigin; }
/// LOCAL_FLOOR: LOCAL lowered to the floor.
inline XrPosef localFloorInOrigin(const ipc::ViewTable &views)
{
	return views.localInOrigin * XrPosef{identityOrientation, {0, -views.floorBelowLocal, 0}};
}
/// STAGE: on the floor below the origin frame; recentring does not move it.
inline XrPosef stageInOrigin(const ipc::ViewTable &views)
{
	return {identityOrientation, {0, views.localInOrigin.position.y - views.floorBelowLocal, 0}};
}

/// The table with LOCAL where the head would be if it looked straight ahead, level, in the heading it has; the floor stays where it is.
ipc::ViewTable recentred(const ipc::ViewTable &views, const HeadMotion &head);

} // namespace arift
