#include "runtime/motion/spaces.h"
#include "runtime/motion/view_poses.h"

namespace arift
{

FrameMotion carried(const FrameMotion &parent, const XrPosef &childInParent)
{
	const XrVector3f arm = rotate(parent.pose.orientation, childInParent.position);
	return {parent.pose * childInParent, parent.linearVelocity + cross(parent.angularVelocity, arm), parent.angularVelocity};
}

FrameMotion relativeTo(const FrameMotion &base, const FrameMotion &frame)
{
	const XrPosef toBase = inverse(base.pose);
	const XrVector3f arm = frame.pose.position - base.pose.position;
	const XrVector3f linear = frame.linearVelocity - base.linearVelocity - cross(base.angularVelocity, arm);
	return {toBase * frame.pose, rotate(toBase.orientation, linear),
			rotate(toBase.orientation, frame.angularVelocity - base.angularVelocity)};
}

FrameMotion viewSpaceInOrigin(const ipc::ViewTable &views, const HeadMotion &head)
{
	const NeckModel neck{views.pivotInHead};
	const XrQuaternionf &orientation = head.at.headInOrigin;
	return {neck.head(orientation), neck.headVelocity(orientation, head.at.angularVelocity), rotate(orientation, head.at.angularVelocity)};
}

XrPosef localInOrigin(const ipc::ViewTable &views) { return views.localInOrigin; }

XrPosef localFloorInOrigin(const ipc::ViewTable &views)
{
	return views.localInOrigin * XrPosef{identityOrientation, {0, -views.floorBelowLocal, 0}};
}

XrPosef stageInOrigin(const ipc::ViewTable &views)
{
	return {identityOrientation, {0, views.localInOrigin.position.y - views.floorBelowLocal, 0}};
}

ipc::ViewTable recentred(const ipc::ViewTable &views, const HeadMotion &head)
{
	ipc::ViewTable table = views;
	table.localInOrigin = NeckModel{views.pivotInHead}.head(headingOf(head.at.headInOrigin));
	table.floorBelowLocal += table.localInOrigin.position.y - views.localInOrigin.position.y;
	++table.recenterCount;
	return table;
}

} // namespace arift
