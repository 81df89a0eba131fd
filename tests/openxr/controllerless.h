// An application with actions, whose devices are those that the service reads: what an application's page says of a hand and a gamepad.
#pragma once
#include "tests/openxr/headless_session.h"

namespace arift
{

struct Controllerless : testing::Test, HeadlessApplication {
	explicit Controllerless(std::vector<const char *> extensions = {}) : HeadlessApplication(std::move(extensions))
	{
		EXPECT_EQ(application.begin(session), XR_SUCCESS);
		application.states();
		XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "game", "Game", 0};
		EXPECT_EQ(get<PFN_xrCreateActionSet>("xrCreateActionSet")(application.instance, &info, &set), XR_SUCCESS);
	}
	XrAction action(const char *name, XrActionType type, const std::vector<XrPath> &users = {}) const
	{
		XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, "", type, uint32_t(users.size()), users.data(), ""};
		std::snprintf(info.actionName, sizeof info.actionName, "%s", name);
		std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "%s", name);
		XrAction made = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateAction>("xrCreateAction")(set, &info, &made), XR_SUCCESS) << name;
		return made;
	}
	struct Suggested {
		XrAction action;
		const char *source;
	};
	void suggest(const char *profile, const std::vector<Suggested> &suggested) const
	{
		std::vector<XrActionSuggestedBinding> bindings;
		for (const auto &[bound, source] : suggested) bindings.push_back({bound, application.path(source)});
		const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, application.path(profile),
														uint32_t(bindings.size()), bindings.data()};
		EXPECT_EQ(get<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(application.instance, &info),
				  XR_SUCCESS);
	}
	void attach() const
	{
		const XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
		EXPECT_EQ(get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(session, &info), XR_SUCCESS);
	}
	void say(const ipc::InputTable &table) { service.client().input.write(table); }
	XrResult sync() const
	{
		const XrActiveActionSet active{set, XR_NULL_PATH};
		const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
		return get<PFN_xrSyncActions>("xrSyncActions")(session, &info);
	}
	template <typename State, typename Get> State stateOf(const char *function, XrStructureType type, XrAction action) const
	{
		const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, XR_NULL_PATH};
		State state{type};
		EXPECT_EQ(get<Get>(function)(session, &info, &state), XR_SUCCESS);
		return state;
	}
	XrActionStateBoolean boolean(XrAction action) const
	{
		return stateOf<XrActionStateBoolean, PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean", XR_TYPE_ACTION_STATE_BOOLEAN, action);
	}
	XrActionStateFloat number(XrAction action) const
	{
		return stateOf<XrActionStateFloat, PFN_xrGetActionStateFloat>("xrGetActionStateFloat", XR_TYPE_ACTION_STATE_FLOAT, action);
	}
	XrActionStateVector2f vector(XrAction action) const
	{
		return stateOf<XrActionStateVector2f, PFN_xrGetActionStateVector2f>("xrGetActionStateVector2f", XR_TYPE_ACTION_STATE_VECTOR2F,
																			action);
	}
	bool isPoseActive(XrAction action) const
	{
		return stateOf<XrActionStatePose, PFN_xrGetActionStatePose>("xrGetActionStatePose", XR_TYPE_ACTION_STATE_POSE, action).isActive;
	}
	XrPath profileOf(const char *user) const
	{
		XrInteractionProfileState state{XR_TYPE_INTERACTION_PROFILE_STATE};
		EXPECT_EQ(get<PFN_xrGetCurrentInteractionProfile>("xrGetCurrentInteractionProfile")(session, application.path(user), &state),
				  XR_SUCCESS);
		return state.interactionProfile;
	}
	/// Whether the next event tells that an interaction profile has changed.
	bool hearsOfProfiles() const
	{
		XrEventDataBuffer event;
		return application.poll(event) == XR_SUCCESS && event.type == XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
	}

	XrActionSet set = XR_NULL_HANDLE;
	static constexpr const char *simple = "/interaction_profiles/khr/simple_controller";
	static constexpr const char *xbox = "/interaction_profiles/microsoft/xbox_controller";
};

inline ipc::InputTable tableWithRightHand()
{
	ipc::InputTable table;
	table.hands[1].isThere = 1;
	return table;
}
inline ipc::InputTable tableWithGamepad()
{
	ipc::InputTable table;
	table.hasGamepad = 1;
	return table;
}

} // namespace arift
