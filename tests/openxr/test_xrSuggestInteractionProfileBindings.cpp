// XR_KHR_binding_modification and XR_EXT_dpad_binding, from the suggestion to the action's state.
#include "tests/openxr/headless_session.h"

namespace arift
{
namespace
{

struct DirectionalPad : testing::Test, HeadlessApplication {
	DirectionalPad() : HeadlessApplication({"XR_KHR_binding_modification", "XR_EXT_dpad_binding", "XR_EXT_conformance_automation"})
	{
		const XrActionSetCreateInfo setInfo{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "game", "Game", 0};
		EXPECT_EQ(get<PFN_xrCreateActionSet>("xrCreateActionSet")(application.instance, &setInfo, &set), XR_SUCCESS);
		const XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, "up", XR_ACTION_TYPE_BOOLEAN_INPUT, 0, nullptr, "Up"};
		EXPECT_EQ(get<PFN_xrCreateAction>("xrCreateAction")(set, &info, &up), XR_SUCCESS);
	}
	XrInteractionProfileDpadBindingEXT modification(const char *pad) const
	{
		XrInteractionProfileDpadBindingEXT wanted{XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT};
		wanted.binding = application.path(pad);
		wanted.actionSet = set;
		wanted.forceThreshold = wanted.forceThresholdReleased = 0.5f;
		wanted.centerRegion = 0.9f;
		wanted.wedgeAngle = 1.5f;
		return wanted;
	}
	XrResult suggest(const char *path, std::vector<XrInteractionProfileDpadBindingEXT> modifications) const
	{
		std::vector<const XrBindingModificationBaseHeaderKHR *> headers;
		for (const auto &wanted : modifications) headers.push_back(reinterpret_cast<const XrBindingModificationBaseHeaderKHR *>(&wanted));
		const XrBindingModificationsKHR all{XR_TYPE_BINDING_MODIFICATIONS_KHR, nullptr, uint32_t(headers.size()), headers.data()};
		const XrActionSuggestedBinding binding{up, application.path(path)};
		const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, &all, touch, 1, &binding};
		return get<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(application.instance, &info);
	}
	/// Whether `up` is true when the stick leans so far up.
	bool isUpAt(float y) const
	{
		const XrPath left = application.path("/user/hand/left"), pad = application.path(stick);
		const auto setVector = get<PFN_xrSetInputDeviceStateVector2fEXT>("xrSetInputDeviceStateVector2fEXT");
		EXPECT_EQ(setVector(session, left, pad, {0, y}), XR_SUCCESS);
		const XrActiveActionSet active{set, XR_NULL_PATH};
		const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
		EXPECT_EQ(get<PFN_xrSyncActions>("xrSyncActions")(session, &sync), XR_SUCCESS);
		const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, up, XR_NULL_PATH};
		XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
		EXPECT_EQ(get<PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean")(session, &info, &state), XR_SUCCESS);
		EXPECT_TRUE(state.isActive);
		return state.currentState;
	}
	void play() const
	{
		const XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
		ASSERT_EQ(get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(session, &info), XR_SUCCESS);
		const auto setActive = get<PFN_xrSetInputDeviceActiveEXT>("xrSetInputDeviceActiveEXT");
		ASSERT_EQ(setActive(session, touch, application.path("/user/hand/left"), XR_TRUE), XR_SUCCESS);
		ASSERT_EQ(application.begin(session), XR_SUCCESS);
	}

	static constexpr const char *stick = "/user/hand/left/input/thumbstick", *upOfStick = "/user/hand/left/input/thumbstick/dpad_up";
	const XrPath touch = application.path("/interaction_profiles/oculus/touch_controller");
	XrActionSet set = XR_NULL_HANDLE;
	XrAction up = XR_NULL_HANDLE;
};

TEST_F(DirectionalPad, ComesWithTheRuntimesSettings)
{
	ASSERT_EQ(suggest(upOfStick, {}), XR_SUCCESS);
	play();
	EXPECT_TRUE(isUpAt(0.8f));
	EXPECT_FALSE(isUpAt(0.2f));
	EXPECT_FALSE(isUpAt(-0.8f));
}

TEST_F(DirectionalPad, IsAsTheApplicationWantsIt)
{
	ASSERT_EQ(suggest(upOfStick, {modification(stick)}), XR_SUCCESS);
	play();
	EXPECT_FALSE(isUpAt(0.8f)) << "within the wide centre that was asked for";
	EXPECT_TRUE(isUpAt(0.95f));
}

TEST_F(DirectionalPad, ModificationsAreChecked)
{
	EXPECT_EQ(suggest(upOfStick, {modification(upOfStick)}), XR_ERROR_PATH_UNSUPPORTED);
	EXPECT_EQ(suggest(upOfStick, {modification("/user/hand/left/input/trackpad")}), XR_ERROR_PATH_UNSUPPORTED);
	EXPECT_EQ(suggest(upOfStick, {modification(stick), modification(stick)}), XR_ERROR_VALIDATION_FAILURE);
	auto wrong = modification(stick);
	wrong.centerRegion = 0;
	EXPECT_EQ(suggest(upOfStick, {wrong}), XR_ERROR_VALIDATION_FAILURE);
}

} // namespace
} // namespace arift
