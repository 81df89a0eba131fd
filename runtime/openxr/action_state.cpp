// What a session says about its actions: no device is there, so nothing is active and nothing is bound.
#include "runtime/openxr/action.h"
#include "runtime/openxr/interaction_profiles.h"

namespace arift::openxr
{
namespace
{

/// The action of a request, after every check that has nothing to do with devices.
const Action &requireAttachedAction(Session &session, XrAction handle, XrPath subactionPath)
{
	const Action &action = handles.at<Action>(handle);
	session.actions.requireAttached(*action.set);
	action.requireSubaction(subactionPath);
	return action;
}

void requireInput(Session &session, const XrActionStateGetInfo &info, XrActionType type)
{
	const Action &action = handles.at<Action>(info.action);
	action.requireType(type);
	requireAttachedAction(session, info.action, info.subactionPath);
}

/// An inactive state of whatever type; keeps `type` and `next`.
template <typename State> void setInactive(State &state)
{
	state.currentState = {};
	state.changedSinceLastSync = XR_FALSE;
	state.lastChangeTime = 0;
	state.isActive = XR_FALSE;
}

XrResult focusResult(const Session &session) { return session.isFocused() ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED; }

} // namespace

void attachSessionActionSets(Session &session, const XrSessionActionSetsAttachInfo &info)
{
	if (info.countActionSets == 0 || !info.actionSets) throw Error(XR_ERROR_VALIDATION_FAILURE, "no action sets are given");
	std::vector<std::shared_ptr<ActionSetCore>> sets;
	for (const XrActionSet handle : std::span(info.actionSets, info.countActionSets)) {
		const ActionSet &set = handles.at<ActionSet>(handle);
		if (&set.instance != &session.instance) throw Error(XR_ERROR_VALIDATION_FAILURE, "an action set belongs to another instance");
		sets.push_back(set.core);
	}
	session.actions.attach(std::move(sets));
}

void getCurrentInteractionProfile(Session &session, XrPath topLevelUserPath, XrInteractionProfileState &state)
{
	const std::string &text = session.instance.paths.text(topLevelUserPath);
	if (!isTopLevelUserPath(text)) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no top level user path", text);
	if (!session.actions.hasAny()) throw Error(XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action sets are attached to the session");
	state.interactionProfile = XR_NULL_PATH;
}

void getActionStateBoolean(Session &session, const XrActionStateGetInfo &info, XrActionStateBoolean &state)
{
	requireInput(session, info, XR_ACTION_TYPE_BOOLEAN_INPUT);
	setInactive(state);
}

void getActionStateFloat(Session &session, const XrActionStateGetInfo &info, XrActionStateFloat &state)
{
	requireInput(session, info, XR_ACTION_TYPE_FLOAT_INPUT);
	setInactive(state);
}

void getActionStateVector2f(Session &session, const XrActionStateGetInfo &info, XrActionStateVector2f &state)
{
	requireInput(session, info, XR_ACTION_TYPE_VECTOR2F_INPUT);
	setInactive(state);
}

void getActionStatePose(Session &session, const XrActionStateGetInfo &info, XrActionStatePose &state)
{
	requireInput(session, info, XR_ACTION_TYPE_POSE_INPUT);
	state.isActive = XR_FALSE;
}

XrResult syncActions(Session &session, const XrActionsSyncInfo &info)
{
	if (info.countActiveActionSets > 0 && !info.activeActionSets) throw Error(XR_ERROR_VALIDATION_FAILURE, "activeActionSets is null");
	for (const XrActiveActionSet &active : std::span(info.activeActionSets, info.countActiveActionSets)) {
		const ActionSet &set = handles.at<ActionSet>(active.actionSet);
		session.actions.requireAttached(*set.core);
		if (active.subactionPath == XR_NULL_PATH) continue;
		const std::string &text = session.instance.paths.text(active.subactionPath);
		if (!set.core->subactionPaths.lock()->contains(active.subactionPath))
			throw Error(XR_ERROR_PATH_UNSUPPORTED, "no action of \"{}\" was made with the subaction path {}", set.core->name, text);
	}
	session.takeNews();
	return focusResult(session);
}

XrResult enumerateBoundSourcesForAction(Session &session, const XrBoundSourcesForActionEnumerateInfo &info, OutputArray<XrPath> sources)
{
	requireAttachedAction(session, info.action, XR_NULL_PATH);
	return sources.assign({});
}

XrResult getInputSourceLocalizedName(Session &session, const XrInputSourceLocalizedNameGetInfo &info, OutputArray<char> buffer)
{
	constexpr XrInputSourceLocalizedNameFlags known = XR_INPUT_SOURCE_LOCALIZED_NAME_USER_PATH_BIT |
													  XR_INPUT_SOURCE_LOCALIZED_NAME_INTERACTION_PROFILE_BIT |
													  XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT;
	const std::string &path = session.instance.paths.text(info.sourcePath);
	if (info.whichComponents == 0 || (info.whichComponents & ~known))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "whichComponents is {:#x}", info.whichComponents);
	if (!session.actions.hasAny()) throw Error(XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action sets are attached to the session");
	// Nothing is ever bound, so no source has a better name than its path.
	return assignText(buffer, path);
}

XrResult applyHapticFeedback(Session &session, const XrHapticActionInfo &info, const XrHapticBaseHeader *haptic)
{
	if (!haptic) throw Error(XR_ERROR_VALIDATION_FAILURE, "hapticFeedback is null");
	if (haptic->type != XR_TYPE_HAPTIC_VIBRATION)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "XrStructureType {} is no haptic feedback of this runtime", int(haptic->type));
	return stopHapticFeedback(session, info);
}

XrResult stopHapticFeedback(Session &session, const XrHapticActionInfo &info)
{
	handles.at<Action>(info.action).requireType(XR_ACTION_TYPE_VIBRATION_OUTPUT);
	requireAttachedAction(session, info.action, info.subactionPath);
	return focusResult(session);
}

} // namespace arift::openxr
