// XrSpace. OpenXR 1.1, chapters "Spaces" and "View Configurations" (xrLocateViews). Locating reads shared memory only: no system call, no
// allocation and, but for the spaces of actions, no lock.
#pragma once
#include "runtime/motion/spaces.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{

class Space : public Object
{
	static bool isIdentity(const XrPosef &pose)
	{
		const auto &[q, p] = pose;
		return q.x == 0 && q.y == 0 && q.z == 0 && q.w == 1 && p.x == 0 && p.y == 0 && p.z == 0;
	}

public:
	using Kind = SpaceKind;

	/// A reference space.
	Space(Session &owner, Kind what, const XrPosef &poseInBase)
		: session(owner), kind(what), offset(poseInBase), isOffset(!isIdentity(poseInBase))
	{
	}
	/// An action space.
	Space(Session &owner, std::shared_ptr<const ActionCore> pose, XrPath subaction, const XrPosef &poseInAction)
		: session(owner),
		  kind(Kind::action),
		  offset(poseInAction),
		  isOffset(!isIdentity(poseInAction)),
		  action(std::move(pose)),
		  subactionPath(subaction)
	{
	}
	void requireAlive() const override { session.requireAlive(); }

	/// Moves with the head, wherever the head may be.
	bool isHeadLocked() const { return kind == Kind::view; }

	Session &session;
	const Kind kind;
	const XrPosef offset;                           ///< this space in the reference space or action it is derived from
	const bool isOffset;                            ///< most are not
	const std::shared_ptr<const ActionCore> action; ///< Kind::action
	const XrPath subactionPath = XR_NULL_PATH;      ///< of the action
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
	/// Where a space is in the origin frame: an XrPosef or, with how it moves, a FrameMotion. Nothing for a space that has no place at this
	/// time.
	template <typename Frame> std::optional<Frame> inOrigin(const Space &space) const;
	const ipc::ViewTable &views() const { return views_; }
	const HeadMotion &head() const { return head_; }
	/// Of the head at another time, by the same samples; nothing where nothing is known of that time.
	std::optional<XrPosef> headAt(XrTime time) const;

private:
	template <typename Frame> std::optional<Frame> actionInOrigin(const Space &space) const;

	ipc::ViewTable views_;
	PoseMoment poses_;
	HeadMotion head_;
};

/// Where a pose in a reference space is, whatever becomes of the space. Throws XR_ERROR_VALIDATION_FAILURE for an action's space.
Placed placedIn(const Space &space, const XrPosef &pose);

/// Throws XR_ERROR_TIME_INVALID.
void requireTime(XrTime time);
/// Throws XR_ERROR_POSE_INVALID; `what` names the pose. The pose with its quaternion of unit length.
XrPosef requirePose(const XrPosef &pose, const char *what);

XrResult enumerateReferenceSpaces(Session &session, OutputArray<XrReferenceSpaceType> types);
void createReferenceSpace(Session &session, const XrReferenceSpaceCreateInfo &info, XrSpace &space);
XrResult getReferenceSpaceBoundsRect(Session &session, XrReferenceSpaceType type, XrExtent2Df &bounds);
void createActionSpace(Session &session, const XrActionSpaceCreateInfo &info, XrSpace &space);
void locateSpace(Space &space, EvenIfLost<Space> base, XrTime time, XrSpaceLocation &location);
void locateSpaces(Session &session, const XrSpacesLocateInfo &info, XrSpaceLocations &locations);
/// As locateSpaces, for the core of OpenXR 1.1. Throws XR_ERROR_FUNCTION_UNSUPPORTED for an instance of 1.0.
void locateSpacesOf1_1(Session &session, const XrSpacesLocateInfo &info, XrSpaceLocations &locations);
void destroySpace(EvenIfLost<Space> space);
XrResult locateViews(Session &session, const XrViewLocateInfo &info, XrViewState &state, OutputArray<XrView> views);

} // namespace arift::openxr
