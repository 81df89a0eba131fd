#include "runtime/openxr/space.h"
#include "runtime/motion/view_poses.h"
#include "runtime/openxr/action.h"

namespace arift::openxr
{
namespace
{

constexpr XrSpaceLocationFlags oriented = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
constexpr XrSpaceLocationFlags placed = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
constexpr XrSpaceLocationFlags tracked = placed | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
constexpr XrSpaceVelocityFlags moving = XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;

/// How well the head's place is known. Its position is the neck model's, which is valid but not tracked.
XrSpaceLocationFlags flagsOf(const HeadMotion &head)
{
	switch (head.found) {
	case Found::none: return 0;
	case Found::frozen: return placed;
	default: return placed | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
	}
}

struct ReferenceSpace {
	XrReferenceSpaceType type;
	Space::Kind kind;
};
constexpr std::array referenceSpaces{
	ReferenceSpace{XR_REFERENCE_SPACE_TYPE_VIEW, Space::Kind::view},
	ReferenceSpace{XR_REFERENCE_SPACE_TYPE_LOCAL, Space::Kind::local},
	ReferenceSpace{XR_REFERENCE_SPACE_TYPE_STAGE, Space::Kind::stage},
	ReferenceSpace{XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR, Space::Kind::localFloor},
	ReferenceSpace{XR_REFERENCE_SPACE_TYPE_UNBOUNDED_MSFT, Space::Kind::unbounded},
};

/// Whether the instance's version and extensions have it.
bool isThere(const Instance &instance, const ReferenceSpace &space)
{
	switch (space.kind) {
	case Space::Kind::localFloor: return instance.hasLocalFloor();
	case Space::Kind::unbounded: return instance.has(Extension::MSFT_unbounded_reference_space);
	default: return true;
	}
}

Space::Kind requireReferenceSpace(const Session &session, XrReferenceSpaceType type)
{
	for (const ReferenceSpace &space : referenceSpaces)
		if (space.type == type && isThere(session.instance, space)) return space.kind;
	throw Error(XR_ERROR_REFERENCE_SPACE_UNSUPPORTED, "reference space {} is not supported", int(type));
}

void requireSameSession(const Session &session, const Space &space, const char *what)
{
	if (&space.session != &session) throw Error(XR_ERROR_VALIDATION_FAILURE, "{} belongs to another session", what);
}

Space &requireSpace(const Session &session, XrSpace handle, const char *what)
{
	Space &space = handles.at<Space>(handle);
	requireSameSession(session, space, what);
	return space;
}

/// Where the reference space of `kind` is, as XrPosef or FrameMotion.
template <typename Frame> Frame referenceInOrigin(Space::Kind kind, const ipc::ViewTable &views, const HeadMotion &head)
{
	switch (kind) {
	case Space::Kind::local: return {localInOrigin(views)};
	case Space::Kind::localFloor: return {localFloorInOrigin(views)};
	case Space::Kind::stage: return {stageInOrigin(views)};
	case Space::Kind::unbounded: return {identityPose};
	default:
		if constexpr (std::is_same_v<Frame, XrPosef>)
			return headInOrigin(views, head);
		else
			return viewSpaceInOrigin(views, head);
	}
}

/// One answer of xrLocateSpace; flags are 0 where there is none.
template <typename Frame> struct Located {
	XrSpaceLocationFlags flags = 0;
	Frame frame{};
};

template <typename Frame> Located<Frame> locate(const Locator &locator, const Space &space, const Space &base)
{
	// Both hang on the same frame: exactly where they are in each other, whether or not anything is tracked.
	if (space.kind == base.kind && space.kind != Space::Kind::action) return {tracked, relativeTo(Frame{base.offset}, Frame{space.offset})};
	const auto baseInOrigin = locator.inOrigin<Frame>(base);
	const auto spaceInOrigin = locator.inOrigin<Frame>(space);
	if (!baseInOrigin || !spaceInOrigin) return {};
	const bool onHead = space.isHeadLocked() || base.isHeadLocked();
	return {onHead ? flagsOf(locator.head()) : tracked, relativeTo(*baseInOrigin, *spaceInOrigin)};
}

/// Writes XrSpaceVelocity or XrSpaceVelocityData.
void writeVelocity(const Located<FrameMotion> &located, auto &velocity)
{
	velocity.velocityFlags = located.flags ? moving : 0;
	velocity.linearVelocity = located.frame.linearVelocity;
	velocity.angularVelocity = located.frame.angularVelocity;
}

} // namespace

void requireTime(XrTime time)
{
	if (time <= 0) throw Error(XR_ERROR_TIME_INVALID, "{} is no time", time);
}

XrPosef requirePose(const XrPosef &pose, const char *what)
{
	const auto &[orientation, position] = pose;
	if (!isValidPose(pose))
		throw Error(XR_ERROR_POSE_INVALID, "{} has the orientation ({}, {}, {}, {}) and position ({}, {}, {})", what, orientation.x,
					orientation.y, orientation.z, orientation.w, position.x, position.y, position.z);
	return {toXr(glm::normalize(toGlm(orientation))), position};
}

Locator::Locator(const Session &session, XrTime time)
	: views_(session.instance.service.views()), poses_(session.instance.service.poses().now()), head_(poses_.at(time))
{
}

template <typename Frame> std::optional<Frame> Locator::inOrigin(const Space &space) const
{
	if (space.kind == Space::Kind::action) return actionInOrigin<Frame>(space);
	if (space.isHeadLocked() && head_.found == Found::none) return std::nullopt;
	const auto reference = referenceInOrigin<Frame>(space.kind, views_, head_);
	return space.isOffset ? carried(reference, space.offset) : reference;
}

template <typename Frame> std::optional<Frame> Locator::actionInOrigin(const Space &space) const
{
	const std::optional<Placed> place = space.session.input.result(*space.action, space.subactionPath).place;
	if (!place || (place->reference == Space::Kind::view && head_.found == Found::none)) return std::nullopt;
	return carried(referenceInOrigin<Frame>(place->reference, views_, head_), place->pose * space.offset);
}

template std::optional<XrPosef> Locator::inOrigin(const Space &space) const;

std::optional<XrPosef> Locator::headAt(XrTime time) const
{
	const HeadMotion then = poses_.at(time);
	return then.found == Found::none ? std::nullopt : std::optional(headInOrigin(views_, then));
}

Placed placedIn(const Space &space, const XrPosef &pose)
{
	if (space.kind == Space::Kind::action) throw Error(XR_ERROR_VALIDATION_FAILURE, "the space is an action's, not a reference space");
	return {space.kind, space.offset * requirePose(pose, "the pose")};
}

XrResult enumerateReferenceSpaces(Session &session, OutputArray<XrReferenceSpaceType> types)
{
	std::vector<XrReferenceSpaceType> there;
	for (const ReferenceSpace &space : referenceSpaces)
		if (isThere(session.instance, space)) there.push_back(space.type);
	return types.assign(there);
}

void createReferenceSpace(Session &session, const XrReferenceSpaceCreateInfo &info, XrSpace &space)
{
	const Space::Kind kind = requireReferenceSpace(session, info.referenceSpaceType);
	const XrPosef pose = requirePose(info.poseInReferenceSpace, "poseInReferenceSpace");
	space = handles.insert(std::make_unique<Space>(session, kind, pose), &session);
}

XrResult getReferenceSpaceBoundsRect(Session &session, XrReferenceSpaceType type, XrExtent2Df &bounds)
{
	bounds = {0, 0};
	if (requireReferenceSpace(session, type) != Space::Kind::stage) return XR_SPACE_BOUNDS_UNAVAILABLE;
	const auto size = session.instance.service.views().stageBounds;
	if (!(size[0] > 0 && size[1] > 0)) return XR_SPACE_BOUNDS_UNAVAILABLE;
	bounds = {size[0], size[1]};
	return XR_SUCCESS;
}

void createActionSpace(Session &session, const XrActionSpaceCreateInfo &info, XrSpace &space)
{
	const Action &action = handles.at<Action>(info.action);
	action.requireType(XR_ACTION_TYPE_POSE_INPUT);
	action.requireSubaction(info.subactionPath);
	const XrPosef pose = requirePose(info.poseInActionSpace, "poseInActionSpace");
	space = handles.insert(std::make_unique<Space>(session, action.core, info.subactionPath, pose), &session);
}

void locateSpace(Space &space, EvenIfLost<Space> base, XrTime time, XrSpaceLocation &location)
{
	requireTime(time);
	requireSameSession(space.session, *base, "baseSpace");
	const Locator locator(space.session, time);
	if (auto *velocity = findInChain<XrSpaceVelocity>(location.next)) {
		const auto located = locate<FrameMotion>(locator, space, *base);
		location.locationFlags = located.flags;
		location.pose = located.frame.pose;
		writeVelocity(located, *velocity);
	} else {
		const auto located = locate<XrPosef>(locator, space, *base);
		location.locationFlags = located.flags;
		location.pose = located.frame;
	}
}

void locateSpaces(Session &session, const XrSpacesLocateInfo &info, XrSpaceLocations &locations)
{
	requireTime(info.time);
	auto *velocities = findInChain<XrSpaceVelocities>(locations.next);
	if (info.spaceCount == 0 || !info.spaces) throw Error(XR_ERROR_VALIDATION_FAILURE, "there are no spaces to locate");
	if (locations.locationCount != info.spaceCount || !locations.locations)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "locationCount is {}, not {}", locations.locationCount, info.spaceCount);
	if (velocities && (velocities->velocityCount != info.spaceCount || !velocities->velocities))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "velocityCount is {}, not {}", velocities->velocityCount, info.spaceCount);
	const Space &base = requireSpace(session, info.baseSpace, "baseSpace");
	for (uint32_t i = 0; i < info.spaceCount; ++i) requireSpace(session, info.spaces[i], "a space to locate");
	const Locator locator(session, info.time);
	for (uint32_t i = 0; i < info.spaceCount; ++i) {
		const auto located = locate<FrameMotion>(locator, handles.at<Space>(info.spaces[i]), base);
		locations.locations[i] = {located.flags, located.frame.pose};
		if (velocities) writeVelocity(located, velocities->velocities[i]);
	}
}

void locateSpacesOf1_1(Session &session, const XrSpacesLocateInfo &info, XrSpaceLocations &locations)
{
	if (!session.instance.is1_1()) throw Error(XR_ERROR_FUNCTION_UNSUPPORTED, "xrLocateSpaces is of OpenXR 1.1, the instance of 1.0");
	locateSpaces(session, info, locations);
}

void destroySpace(EvenIfLost<Space> space) { handles.destroy(*space); }

XrResult locateViews(Session &session, const XrViewLocateInfo &info, XrViewState &state, OutputArray<XrView> views)
{
	requireStereo(info.viewConfigurationType);
	requireTime(info.displayTime);
	const Space &space = requireSpace(session, info.space, "space");
	state.viewStateFlags = 0;
	if (views.capacity == 0) return views.fill(2, [](uint32_t, XrView &) {});
	const Locator locator(session, info.displayTime);
	const ipc::ViewTable &table = locator.views();
	const auto base = locator.inOrigin<XrPosef>(space);
	const bool located = base && locator.head().found != Found::none;
	const XrPosef head = located ? relativeTo(*base, headInOrigin(table, locator.head())) : identityPose;
	const ipc::TimingTable timing = session.instance.service.timing();
	// At the exposure of the camera image that will be shown; both cameras' often is the same.
	XrTime thenTime = info.displayTime;
	XrPosef then = head;
	const XrResult result = views.fill(2, [&](uint32_t eye, XrView &view) {
		view.fov = table.fov[eye];
		view.pose = identityPose;
		if (!located) return;
		const XrTime exposure = exposureShownAt(timing.cameras[eye], info.displayTime, timing.latchBeforeDisplay);
		if (table.viewOffset > 0 && exposure != thenTime) {
			const auto headThen = locator.headAt(exposure);
			then = headThen ? relativeTo(*base, *headThen) : head;
			thenTime = exposure;
		}
		view.pose = viewInOrigin(table, eye, head, then);
	});
	static_assert(XR_VIEW_STATE_ORIENTATION_VALID_BIT == oriented);
	// Bit for bit the same as XrSpaceLocationFlags.
	if (located && XR_SUCCEEDED(result)) state.viewStateFlags = flagsOf(locator.head());
	return result;
}

} // namespace arift::openxr
