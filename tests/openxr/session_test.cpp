// Sessions without graphics: life cycle, spaces, views, actions, time.
#include "runtime/motion/spaces.h"
#include "runtime/motion/view_poses.h"
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"

namespace arift
{
namespace
{

constexpr auto idle = XR_SESSION_STATE_IDLE, ready = XR_SESSION_STATE_READY, synchronized = XR_SESSION_STATE_SYNCHRONIZED,
			   visible = XR_SESSION_STATE_VISIBLE, focused = XR_SESSION_STATE_FOCUSED, stopping = XR_SESSION_STATE_STOPPING,
			   exiting = XR_SESSION_STATE_EXITING;
using States = std::vector<XrSessionState>;

struct HeadlessSession : testing::Test {
	FakeService service;
	Application application{{"XR_MND_headless", "XR_KHR_convert_timespec_time"}};
	XrSession session = application.session();

	/// Head motion at a constant rate about the vertical: 1 rad/s, 0 at time 0.
	void turnHead(XrTime until)
	{
		for (XrTime time = until - second; time <= until; time += 2 * millisecond)
			service.poses().push({time, rotationAbout({0, 1, 0}, inSeconds(time % (3 * second))), {0, 1, 0}, {0, 0, 0}});
	}
	template <typename Pfn> Pfn get(const char *name) const { return application.get<Pfn>(name); }
	XrSpaceLocation locate(XrSpace space, XrSpace base, XrTime time, XrSpaceVelocity *velocity = nullptr) const
	{
		XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, velocity};
		EXPECT_EQ(get<PFN_xrLocateSpace>("xrLocateSpace")(space, base, time, &location), XR_SUCCESS);
		return location;
	}
};

void expectNear(const XrPosef &a, const XrPosef &b)
{
	EXPECT_LT(angleBetween(a.orientation, b.orientation), 1e-5);
	EXPECT_LT(length(a.position - b.position), 1e-5f);
}

TEST_F(HeadlessSession, LifeCycle)
{
	EXPECT_EQ(application.states(), (States{idle, ready}));
	EXPECT_EQ(get<PFN_xrEndSession>("xrEndSession")(session), XR_ERROR_SESSION_NOT_RUNNING);
	EXPECT_EQ(get<PFN_xrRequestExitSession>("xrRequestExitSession")(session), XR_ERROR_SESSION_NOT_RUNNING);
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	EXPECT_EQ(application.begin(session), XR_ERROR_SESSION_RUNNING);
	EXPECT_TRUE(service.record().running);
	EXPECT_EQ(application.states(), (States{synchronized, visible, focused}));
	EXPECT_EQ(get<PFN_xrEndSession>("xrEndSession")(session), XR_ERROR_SESSION_NOT_STOPPING);
	ASSERT_EQ(get<PFN_xrRequestExitSession>("xrRequestExitSession")(session), XR_SUCCESS);
	EXPECT_EQ(application.states(), (States{visible, synchronized, stopping}));
	ASSERT_EQ(get<PFN_xrEndSession>("xrEndSession")(session), XR_SUCCESS);
	EXPECT_EQ(application.states(), (States{idle, exiting}));
	EXPECT_FALSE(service.record().running);
	EXPECT_EQ(application.begin(session), XR_ERROR_SESSION_NOT_READY);
}

TEST_F(HeadlessSession, OneSessionAtATime)
{
	const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, application.system()};
	XrSession second = XR_NULL_HANDLE;
	const auto create = get<PFN_xrCreateSession>("xrCreateSession");
	EXPECT_EQ(create(application.instance, &info, &second), XR_ERROR_LIMIT_REACHED);
	ASSERT_EQ(get<PFN_xrDestroySession>("xrDestroySession")(session), XR_SUCCESS);
	EXPECT_EQ(create(application.instance, &info, &second), XR_SUCCESS);
	EXPECT_EQ(service.record().sessionsDestroyed, 1u);
}

TEST_F(HeadlessSession, ExitAndLossByTheService)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	application.states();
	service.send({.type = ipc::EventType::exitRequested, .session = 99});
	EXPECT_EQ(application.states(), States{}) << "another session's news";
	service.send({.type = ipc::EventType::exitRequested, .session = 1});
	EXPECT_EQ(application.states(), (States{visible, synchronized, stopping}));
	service.send({.type = ipc::EventType::lossPending, .session = 1});
	EXPECT_EQ(application.states(), (States{XR_SESSION_STATE_LOSS_PENDING}));
	EXPECT_EQ(application.begin(session), XR_ERROR_SESSION_LOST);
}

TEST_F(HeadlessSession, RecenteringIsTold)
{
	application.states();
	service.send({.type = ipc::EventType::recentered, .session = 0, .time = 1234, .pose = {identityOrientation, {1, 2, 3}}});
	XrEventDataBuffer event;
	std::vector<XrReferenceSpaceType> types;
	while (application.poll(event) == XR_SUCCESS) {
		ASSERT_EQ(event.type, XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING);
		const auto &change = reinterpret_cast<XrEventDataReferenceSpaceChangePending &>(event);
		types.push_back(change.referenceSpaceType);
		EXPECT_EQ(change.changeTime, 1234);
		EXPECT_EQ(change.poseInPreviousSpace.position.z, 3);
	}
	EXPECT_EQ(types, (std::vector{XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR}));
}

TEST_F(HeadlessSession, FramesInOrder)
{
	XrFrameState state;
	EXPECT_EQ(application.wait(session, state), XR_ERROR_SESSION_NOT_RUNNING);
	EXPECT_EQ(application.beginFrame(session), XR_ERROR_SESSION_NOT_RUNNING);
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	EXPECT_EQ(application.beginFrame(session), XR_ERROR_CALL_ORDER_INVALID);
	ASSERT_EQ(application.wait(session, state), XR_SUCCESS);
	EXPECT_GT(state.predictedDisplayTime, realTime());
	EXPECT_EQ(state.predictedDisplayPeriod, 16'690'000);
	EXPECT_FALSE(state.shouldRender) << "a headless session has nothing to draw";
	EXPECT_EQ(application.endFrame(session, state.predictedDisplayTime), XR_ERROR_CALL_ORDER_INVALID);
	ASSERT_EQ(application.beginFrame(session), XR_SUCCESS);
	EXPECT_EQ(application.endFrame(session, 0), XR_ERROR_TIME_INVALID);
	EXPECT_EQ(application.endFrame(session, state.predictedDisplayTime, {}, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE),
			  XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
	EXPECT_EQ(application.endFrame(session, state.predictedDisplayTime, {}, XrEnvironmentBlendMode(9)), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(application.endFrame(session, state.predictedDisplayTime), XR_SUCCESS);
	ASSERT_EQ(application.wait(session, state), XR_SUCCESS);
	ASSERT_EQ(application.beginFrame(session), XR_SUCCESS);
	ASSERT_EQ(application.wait(session, state), XR_SUCCESS);
	EXPECT_EQ(application.beginFrame(session), XR_FRAME_DISCARDED);
}

TEST_F(HeadlessSession, ReferenceSpaces)
{
	const XrTime now = realTime();
	turnHead(now);
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL),
				  stage = application.space(session, XR_REFERENCE_SPACE_TYPE_STAGE);
	const XrSpace floor = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR),
				  view = application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW);
	constexpr XrSpaceLocationFlags allTracked = 0xf;
	XrSpaceLocation location = locate(local, stage, now);
	EXPECT_EQ(location.locationFlags, allTracked);
	expectNear(location.pose, {identityOrientation, {0, 1.6f, 0}});
	expectNear(locate(floor, local, now).pose, {identityOrientation, {0, -1.6f, 0}});

	const XrTime time = now - 5 * millisecond;
	const HeadMotion head{Found::exact, {time, rotationAbout({0, 1, 0}, inSeconds(time % (3 * second))), {0, 1, 0}}};
	XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
	location = locate(view, local, time, &velocity);
	expectNear(location.pose, NeckModel{}.head(head.at.headInOrigin));
	EXPECT_TRUE(location.locationFlags & XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT);
	EXPECT_FALSE(location.locationFlags & XR_SPACE_LOCATION_POSITION_TRACKED_BIT) << "the neck model's guess";
	EXPECT_NEAR(velocity.angularVelocity.y, 1, 1e-4);
	const XrVector3f expected = rotate(head.at.headInOrigin, cross({0, 1, 0}, NeckModel{}.pivotInHead * -1.0f));
	EXPECT_LT(length(velocity.linearVelocity - expected), 1e-4f);

	location = locate(view, local, now - 2 * second);
	EXPECT_EQ(location.locationFlags, 0u) << "before the oldest sample";
	const XrSpace ahead = application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW, {{0, 0, 0, 1}, {0, 0, -1}});
	expectNear(locate(ahead, view, now - 2 * second).pose, {identityOrientation, {0, 0, -1}});
	XrSpaceLocation unused{XR_TYPE_SPACE_LOCATION};
	EXPECT_EQ(get<PFN_xrLocateSpace>("xrLocateSpace")(view, local, 0, &unused), XR_ERROR_TIME_INVALID);
	const XrReferenceSpaceCreateInfo bad{
		XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_LOCAL, {{0, 0, 0, 0.9f}, {}}};
	XrSpace none = XR_NULL_HANDLE;
	EXPECT_EQ(get<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(session, &bad, &none), XR_ERROR_POSE_INVALID);
	XrExtent2Df bounds{};
	const auto getBounds = get<PFN_xrGetReferenceSpaceBoundsRect>("xrGetReferenceSpaceBoundsRect");
	EXPECT_EQ(getBounds(session, XR_REFERENCE_SPACE_TYPE_STAGE, &bounds), XR_SUCCESS);
	EXPECT_EQ(bounds.height, 3);
	EXPECT_EQ(getBounds(session, XR_REFERENCE_SPACE_TYPE_LOCAL, &bounds), XR_SPACE_BOUNDS_UNAVAILABLE);
}

TEST_F(HeadlessSession, SeveralSpacesAtOnceAreLocatedAsOneByOne)
{
	const XrTime now = realTime();
	turnHead(now);
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const XrSpace spaces[] = {application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW),
							  application.space(session, XR_REFERENCE_SPACE_TYPE_STAGE)};
	XrSpaceVelocityData velocityData[2]{};
	XrSpaceVelocities velocities{XR_TYPE_SPACE_VELOCITIES, nullptr, 2, velocityData};
	XrSpaceLocationData data[2]{};
	XrSpaceLocations locations{XR_TYPE_SPACE_LOCATIONS, &velocities, 2, data};
	const XrSpacesLocateInfo info{XR_TYPE_SPACES_LOCATE_INFO, nullptr, local, now, 2, spaces};
	const auto locateSpaces = get<PFN_xrLocateSpaces>("xrLocateSpaces");
	ASSERT_EQ(locateSpaces(session, &info, &locations), XR_SUCCESS);
	for (int i = 0; i < 2; ++i) {
		XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
		const XrSpaceLocation one = locate(spaces[i], local, now, &velocity);
		expectNear(data[i].pose, one.pose);
		EXPECT_EQ(data[i].locationFlags, one.locationFlags);
		EXPECT_EQ(velocityData[i].angularVelocity.y, velocity.angularVelocity.y);
	}
	locations.locationCount = 1;
	EXPECT_EQ(locateSpaces(session, &info, &locations), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(HeadlessSession, ViewsFollowTheViewRule)
{
	const XrTime now = realTime();
	turnHead(now);
	ipc::ViewTable table = *service.system().views.read();
	table.viewOffset = 0.5f;
	service.system().views.write(table);
	ipc::TimingTable timing{};
	timing.displayPeriod = 16'690'000;
	timing.latchBeforeDisplay = 20 * millisecond;
	timing.cameras = {ipc::CameraTiming{now - 300 * millisecond, 16 * millisecond, 10 * millisecond},
					  {now - 307 * millisecond, 16 * millisecond, 10 * millisecond}};
	service.system().timing.write(timing);
	const XrTime display = now - 10 * millisecond;
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, display, local};
	XrViewState state{XR_TYPE_VIEW_STATE};
	std::vector<XrView> views(2, {XR_TYPE_VIEW});
	uint32_t count = 0;
	const auto locateViews = get<PFN_xrLocateViews>("xrLocateViews");
	ASSERT_EQ(locateViews(session, &info, &state, 2, &count, views.data()), XR_SUCCESS);
	EXPECT_TRUE(state.viewStateFlags & XR_VIEW_STATE_POSITION_VALID_BIT);
	const auto headAt = [&](XrTime time) {
		return headInOrigin(table, {Found::exact, {time, rotationAbout({0, 1, 0}, inSeconds(time % (3 * second))), {0, 1, 0}}});
	};
	for (uint32_t eye = 0; eye < 2; ++eye) {
		const XrTime exposure = exposureShownAt(timing.cameras[eye], display, timing.latchBeforeDisplay);
		expectNear(views[eye].pose, viewInOrigin(table, eye, headAt(display), headAt(exposure)));
		EXPECT_EQ(views[eye].fov.angleLeft, table.fov[eye].angleLeft);
	}
	EXPECT_EQ(locateViews(session, &info, &state, 0, &count, nullptr), XR_SUCCESS);
	EXPECT_EQ(count, 2u);
	XrViewLocateInfo mono = info;
	mono.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO;
	EXPECT_EQ(locateViews(session, &mono, &state, 2, &count, views.data()), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
}

TEST_F(HeadlessSession, TimesConvertBothWaysOnAScaledClock)
{
	service.system().clock.write({5 * second, 100 * second, 0.25});
	const timespec real{.tv_sec = 9, .tv_nsec = 0};
	XrTime time = 0;
	ASSERT_EQ(get<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR")(application.instance, &real, &time), XR_SUCCESS);
	EXPECT_EQ(time, 101 * second);
	timespec back{};
	ASSERT_EQ(get<PFN_xrConvertTimeToTimespecTimeKHR>("xrConvertTimeToTimespecTimeKHR")(application.instance, time, &back), XR_SUCCESS);
	EXPECT_EQ(back.tv_sec, 9);
	EXPECT_EQ(back.tv_nsec, 0);
	EXPECT_EQ(get<PFN_xrConvertTimeToTimespecTimeKHR>("xrConvertTimeToTimespecTimeKHR")(application.instance, -5, &back),
			  XR_ERROR_TIME_INVALID);
}

/// xrConvertTimespecTimeToTimeKHR, xrConvertTimeToTimespecTimeKHR: whatever the clocks' anchors and rate, no number overflows.
TEST_F(HeadlessSession, TimesBeyondTheOtherClocksLastAreInvalid)
{
	const auto toTimespec = get<PFN_xrConvertTimeToTimespecTimeKHR>("xrConvertTimeToTimespecTimeKHR");
	const auto toTime = get<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR");
	const timespec latest{.tv_sec = INT64_MAX / second - 1, .tv_nsec = 0};
	timespec real{};
	XrTime time = 0;
	for (const double rate : {1.0, 0.25}) {
		service.system().clock.write({5 * second, second, rate});
		EXPECT_EQ(toTimespec(application.instance, INT64_MAX, &real), XR_ERROR_TIME_INVALID) << rate;
	}
	for (const double rate : {1.0, 4.0}) {
		service.system().clock.write({second, 5 * second, rate});
		EXPECT_EQ(toTime(application.instance, &latest, &time), XR_ERROR_TIME_INVALID) << rate;
	}
	service.system().clock.write({});
	ASSERT_EQ(toTime(application.instance, &latest, &time), XR_SUCCESS);
	EXPECT_EQ(time, latest.tv_sec * second);
}

TEST_F(HeadlessSession, ActionsWithoutControllers)
{
	XrActionSetCreateInfo setInfo{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "game", "Game", 0};
	XrActionSet set = XR_NULL_HANDLE, twin = XR_NULL_HANDLE;
	const auto createSet = get<PFN_xrCreateActionSet>("xrCreateActionSet");
	ASSERT_EQ(createSet(application.instance, &setInfo, &set), XR_SUCCESS);
	EXPECT_EQ(createSet(application.instance, &setInfo, &twin), XR_ERROR_NAME_DUPLICATED);
	const XrPath left = application.path("/user/hand/left"), right = application.path("/user/hand/right");
	XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, "grab", XR_ACTION_TYPE_BOOLEAN_INPUT, 1, &left, "Grab"};
	XrAction grab = XR_NULL_HANDLE, pose = XR_NULL_HANDLE;
	const auto createAction = get<PFN_xrCreateAction>("xrCreateAction");
	ASSERT_EQ(createAction(set, &info, &grab), XR_SUCCESS);
	std::snprintf(info.actionName, sizeof info.actionName, "Grab");
	EXPECT_EQ(createAction(set, &info, &pose), XR_ERROR_PATH_FORMAT_INVALID);
	std::snprintf(info.actionName, sizeof info.actionName, "hand");
	EXPECT_EQ(createAction(set, &info, &pose), XR_ERROR_LOCALIZED_NAME_DUPLICATED);
	std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "Hand");
	info.actionType = XR_ACTION_TYPE_POSE_INPUT;
	ASSERT_EQ(createAction(set, &info, &pose), XR_SUCCESS);

	const XrActionSuggestedBinding bindings[] = {{grab, application.path("/user/hand/left/input/select/click")},
												 {pose, application.path("/user/hand/left/input/grip/pose")}};
	const auto suggest = get<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings");
	XrInteractionProfileSuggestedBinding suggestion{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
													application.path("/interaction_profiles/khr/simple_controller"), 2, bindings};
	EXPECT_EQ(suggest(application.instance, &suggestion), XR_SUCCESS);
	const XrActionSuggestedBinding wrong{grab, application.path("/user/hand/left/input/trigger/value")};
	XrInteractionProfileSuggestedBinding wrongSuggestion = suggestion;
	wrongSuggestion.countSuggestedBindings = 1;
	wrongSuggestion.suggestedBindings = &wrong;
	EXPECT_EQ(suggest(application.instance, &wrongSuggestion), XR_ERROR_PATH_UNSUPPORTED);

	XrActionStateGetInfo getInfo{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, grab, XR_NULL_PATH};
	XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
	const auto getBoolean = get<PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean");
	EXPECT_EQ(getBoolean(session, &getInfo, &state), XR_ERROR_ACTIONSET_NOT_ATTACHED);
	const XrSessionActionSetsAttachInfo attachInfo{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
	const auto attach = get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets");
	ASSERT_EQ(attach(session, &attachInfo), XR_SUCCESS);
	EXPECT_EQ(attach(session, &attachInfo), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
	EXPECT_EQ(suggest(application.instance, &suggestion), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
	state.isActive = XR_TRUE;
	EXPECT_EQ(getBoolean(session, &getInfo, &state), XR_SUCCESS);
	EXPECT_FALSE(state.isActive);
	getInfo.subactionPath = right;
	EXPECT_EQ(getBoolean(session, &getInfo, &state), XR_ERROR_PATH_UNSUPPORTED);
	getInfo = {XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pose, left};
	EXPECT_EQ(getBoolean(session, &getInfo, &state), XR_ERROR_ACTION_TYPE_MISMATCH);

	const XrActiveActionSet active{set, XR_NULL_PATH};
	const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
	const auto syncActions = get<PFN_xrSyncActions>("xrSyncActions");
	EXPECT_EQ(syncActions(session, &sync), XR_SESSION_NOT_FOCUSED);
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	EXPECT_EQ(syncActions(session, &sync), XR_SUCCESS);
	XrInteractionProfileState profile{XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, 77};
	EXPECT_EQ(get<PFN_xrGetCurrentInteractionProfile>("xrGetCurrentInteractionProfile")(session, left, &profile), XR_SUCCESS);
	EXPECT_EQ(profile.interactionProfile, XrPath(XR_NULL_PATH));

	const XrActionSpaceCreateInfo spaceInfo{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, pose, left, {{0, 0, 0, 1}, {0, 0, 0}}};
	XrSpace hand = XR_NULL_HANDLE;
	ASSERT_EQ(get<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, &spaceInfo, &hand), XR_SUCCESS);
	EXPECT_EQ(locate(hand, application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL), realTime()).locationFlags, 0u);
}

} // namespace
} // namespace arift
