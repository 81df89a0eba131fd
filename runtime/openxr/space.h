// XrSpace. OpenXR 1.1, chapters "Spaces" and "View Configurations" (xrLocateViews). Locating reads shared memory only: no lock, no system
// call, no allocation.
#pragma once
#include "runtime/motion/spaces.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{

class Space : public Object
{
public:
	/// A reference space, or an action space: nothing is bound to any action yet, so those have no place.
	enum class Kind { view, local, localFloor, stage, action };

	Space(Session &owner, Kind what, const XrPosef &poseInBase) : session(owner), kind(what), offset(poseInBase) {}
	void requireAlive() const override { session.requireAlive(); }

	/// Moves with the head, wherever the head may be.
	bool isHeadLocked() const { return kind == Kind::view; }

	Session &session;
	const Kind kind;
	const XrPosef offset; ///< this space in the reference space or action it is derived from
};

template <> struct HandleOf<Space> {
	using type = XrSpace;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_SPACE;
};

/// What locating needs, read once for several spaces.
class Locator
{
public:
	Locator(const Session &session, XrTime time);
	/// Where a space is in the origin frame and how it moves; nothing for a space that has no place at this time.
	std::optional<FrameMotion> inOrigin(const Space &space) const;
	const ipc::ViewTable &views() const { return views_; }
	const HeadMotion &head() const { return head_; }

private:
	ipc::ViewTable views_;
	HeadMotion head_;
};

/// One answer of xrLocateSpace; flags are 0 where there is none.
struct Located {
	XrSpaceLocationFlags locationFlags = 0;
	XrSpaceVelocityFlags velocityFlags = 0;
	FrameMotion motion;
};
Located locate(const Locator &locator, const Space &space, const Space &base);

/// Throws XR_ERROR_TIME_INVALID.
void requireTime(XrTime time);
/// Throws XR_ERROR_POSE_INVALID; `what` names the pose. The pose with its quaternion of unit length.
XrPosef requirePose(const XrPosef &pose, const char *what);

XrResult enumerateReferenceSpaces(Session &session, OutputArray<XrReferenceSpaceType> types);
void createReferenceSpace(Session &session, const XrReferenceSpaceCreateInfo &info, XrSpace &space);
XrResult getReferenceSpaceBoundsRect(Session &session, XrReferenceSpaceType type, XrExtent2Df &bounds);
void createActionSpace(Session &session, const XrActionSpaceCreateInfo &info, XrSpace &space);
void locateSpace(Space &space, Space &base, XrTime time, XrSpaceLocation &location);
void locateSpaces(Session &session, const XrSpacesLocateInfo &info, XrSpaceLocations &locations);
void destroySpace(EvenIfLost<Space> space);
XrResult locateViews(Session &session, const XrViewLocateInfo &info, XrViewState &state, OutputArray<XrView> views);

} // namespace arift::openxr
