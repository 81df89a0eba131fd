// What a session says about its actions.
#include "runtime/openxr/action.h"
#include "runtime/openxr/ext/ext_active_action_set_priority.h"
#include "runtime/openxr/interaction_profiles.h"

namespace arift::openxr
{
namespace
{

/// The action of a request, after every check that has nothing to do with devices.
const Action &requireAttachedAction(const Session &session, XrAction handle, XrPath subactionPath)
{
	const Action &action = handles.at<Action>(handle);
	session.input.requireAttached(*action.core->set);
	action.requireSubaction(subactionPath);
	return action;
}

ActionResult requireInput(const Session &session, const XrActionStateGetInfo &info, XrActionType type)
{
	handles.at<Action>(info.action).requireType(type);
	return session.input.result(*requireAttachedAction(session, info.action, info.subactionPath).core, info.subactionPath);
}

/// A state of whatever type but its value; keeps `type` and `next`.
template <typename State> void write(const ActionResult &result, State &state)
{
	state.changedSinceLastSync = result.changed ? XR_TRUE : XR_FALSE;
	state.lastChangeTime = result.lastChange;
	state.isActive = result.isActive ? XR_TRUE : XR_FALSE;
}

/// What an action's outputs are to do; those that nobody has do nothing.
XrResult vibrate(Session &session, const XrHapticActionInfo &info, ipc::Vibrate message)
{
	handles.at<Action>(info.action).requireType(XR_ACTION_TYPE_VIBRATION_OUTPUT);
	const Action &action = requireAttachedAction(session, info.action, info.subactionPath);
	if (!session.isFocused()) return XR_SESSION_NOT_FOCUSED;
	message.motors = session.serviceDevices.motorsOf(session.input.sourcesOf(*action.core, info.subactionPath));
	if (message.motors != 0) session.vibrate(message);
	return XR_SUCCESS;
}

/// Most applications have a handful of sets: no allocation.
class ActiveSets
{
public:
	void add(const ActiveSet &set)
	{
		if (count_ < few_.size())
			few_[count_++] = set;
		else
			many_.push_back(set);
	}
	std::span<const ActiveSet> all()
	{
		if (many_.empty()) return std::span(few_).first(count_);
		many_.insert(many_.end(), few_.begin(), few_.end());
		return many_;
	}

private:
	std::array<ActiveSet, 8> few_{};
	size_t count_ = 0;
	std::vector<ActiveSet> many_;
};

ActiveSet requireActiveSet(Session &session, const XrActiveActionSet &active, const void *next)
{
	const ActionSet &set = handles.at<ActionSet>(active.actionSet);
	session.input.requireAttached(*set.core);
	if (active.subactionPath != XR_NULL_PATH) {
		const std::string &text = session.instance.paths.text(active.subactionPath);
		if (!set.core->subactionPaths.lock()->contains(active.subactionPath))
			throw Error(XR_ERROR_PATH_UNSUPPORTED, "no action of \"{}\" was made with the subaction path {}", set.core->name, text);
	}
	const bool mayOverride = session.instance.has(Extension::EXT_active_action_set_priority);
	return {set.core.get(), active.subactionPath, mayOverride ? priorityOf(set, next) : set.core->priority};
}

/// "trackpad" and "x" become "Trackpad X".
std::string forPeople(std::string_view path)
{
	std::string text;
	bool begins = true;
	for (const char c : path) {
		const bool separates = c == '/' || c == '_';
		if (separates && !text.empty()) text += ' ';
		if (!separates) text += begins && c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
		begins = separates;
	}
	return text;
}

/// A source's name in three parts, each for people.
struct SourceName {
	std::string user, profile, component;
};
SourceName nameOfSource(const Session &session, std::string_view path)
{
	const Features features = session.instance.features();
	size_t end = path.size(); // of the user path
	while (end != path.npos && end != 0 && !isTopLevelUserPath(path.substr(0, end), features)) end = path.rfind('/', end - 1);
	if (end == path.npos || end == 0) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no source of input", path);
	const std::string_view user = path.substr(0, end);
	std::string_view hand = user.substr(user.find('/', 1) + 1);
	SourceName name{forPeople(hand), {}, {}};
	if (hand.starts_with("hand")) name.user = hand.ends_with("left") ? "Left Hand" : "Right Hand";
	if (const XrPath profile = session.input.profileOf(session.instance.paths.known(user)); profile != XR_NULL_PATH)
		name.profile = findInteractionProfile(session.instance.paths.text(profile), features)->title;
	if (const size_t component = path.find('/', end + 1); component != path.npos) name.component = forPeople(path.substr(component));
	return name;
}

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
	const Suggestions suggestions = *session.instance.suggestions.lock();
	session.input.attach(std::move(sets), suggestions);
}

void getCurrentInteractionProfile(Session &session, XrPath topLevelUserPath, XrInteractionProfileState &state)
{
	const std::string &text = session.instance.paths.text(topLevelUserPath);
	if (!isTopLevelUserPath(text, session.instance.features()))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no top level user path", text);
	if (!session.input.hasAttached()) throw Error(XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action sets are attached to the session");
	state.interactionProfile = session.input.profileOf(topLevelUserPath);
}

void getActionStateBoolean(Session &session, const XrActionStateGetInfo &info, XrActionStateBoolean &state)
{
	const ActionResult result = requireInput(session, info, XR_ACTION_TYPE_BOOLEAN_INPUT);
	write(result, state);
	state.currentState = result.value.x != 0 ? XR_TRUE : XR_FALSE;
}

void getActionStateFloat(Session &session, const XrActionStateGetInfo &info, XrActionStateFloat &state)
{
	const ActionResult result = requireInput(session, info, XR_ACTION_TYPE_FLOAT_INPUT);
	write(result, state);
	state.currentState = result.value.x;
}

void getActionStateVector2f(Session &session, const XrActionStateGetInfo &info, XrActionStateVector2f &state)
{
	const ActionResult result = requireInput(session, info, XR_ACTION_TYPE_VECTOR2F_INPUT);
	write(result, state);
	state.currentState = result.value;
}

void getActionStatePose(Session &session, const XrActionStateGetInfo &info, XrActionStatePose &state)
{
	state.isActive = requireInput(session, info, XR_ACTION_TYPE_POSE_INPUT).isActive ? XR_TRUE : XR_FALSE;
}

XrResult syncActions(Session &session, const XrActionsSyncInfo &info)
{
	if (info.countActiveActionSets > 0 && !info.activeActionSets) throw Error(XR_ERROR_VALIDATION_FAILURE, "activeActionSets is null");
	ActiveSets active;
	for (const XrActiveActionSet &set : std::span(info.activeActionSets, info.countActiveActionSets))
		active.add(requireActiveSet(session, set, info.next));
	session.takeNews();
	if (!session.isFocused()) {
		session.input.rest();
		return XR_SESSION_NOT_FOCUSED;
	}
	session.serviceDevices.update(session.input, session.instance.service.client().input);
	session.tellStops();
	if (session.input.synchronize(active.all(), session.instance.service.now()))
		session.tell(XrEventDataInteractionProfileChanged{XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED, nullptr, handleOf(session)});
	return XR_SUCCESS;
}

XrResult enumerateBoundSourcesForAction(Session &session, const XrBoundSourcesForActionEnumerateInfo &info, OutputArray<XrPath> sources)
{
	return sources.assign(session.input.sourcesOf(*requireAttachedAction(session, info.action, XR_NULL_PATH).core, XR_NULL_PATH));
}

XrResult getInputSourceLocalizedName(Session &session, const XrInputSourceLocalizedNameGetInfo &info, OutputArray<char> buffer)
{
	constexpr XrInputSourceLocalizedNameFlags known = XR_INPUT_SOURCE_LOCALIZED_NAME_USER_PATH_BIT |
													  XR_INPUT_SOURCE_LOCALIZED_NAME_INTERACTION_PROFILE_BIT |
													  XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT;
	const Instance &instance = session.instance;
	const std::string &path = instance.paths.text(info.sourcePath);
	if (info.whichComponents == 0 || (info.whichComponents & ~known))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "whichComponents is {:#x}", info.whichComponents);
	if (!session.input.hasAttached()) throw Error(XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action sets are attached to the session");
	const SourceName source = nameOfSource(session, path);
	std::string text;
	const auto add = [&](XrInputSourceLocalizedNameFlags flag, std::string_view part) {
		if ((info.whichComponents & flag) && !part.empty()) text.append(text.empty() ? "" : " ").append(part);
	};
	add(XR_INPUT_SOURCE_LOCALIZED_NAME_USER_PATH_BIT, source.user);
	add(XR_INPUT_SOURCE_LOCALIZED_NAME_INTERACTION_PROFILE_BIT, source.profile);
	add(XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT, source.component);
	return assignText(buffer, text);
}

XrResult applyHapticFeedback(Session &session, const XrHapticActionInfo &info, const XrHapticBaseHeader *haptic)
{
	if (!haptic) throw Error(XR_ERROR_VALIDATION_FAILURE, "hapticFeedback is null");
	if (haptic->type != XR_TYPE_HAPTIC_VIBRATION)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "XrStructureType {} is no haptic feedback of this runtime", int(haptic->type));
	const auto &vibration = reinterpret_cast<const XrHapticVibration &>(*haptic);
	const float amplitude = vibration.amplitude > 0 ? std::min(vibration.amplitude, 1.0f) : 0; // 0 for what is no number, too
	return vibrate(session, info, {.amplitude = amplitude, .duration = std::max<XrDuration>(vibration.duration, XR_MIN_HAPTIC_DURATION)});
}

XrResult stopHapticFeedback(Session &session, const XrHapticActionInfo &info)
{
	return vibrate(session, info, {.amplitude = 0, .duration = 0});
}

} // namespace arift::openxr
