// Making actions and suggesting bindings: everything that happens before a session has them.
#include "runtime/openxr/action.h"
#include "runtime/openxr/interaction_profiles.h"

namespace arift::openxr
{
namespace
{

/// The name and the localized name of an action or action set, each in its fixed field.
template <size_t size> std::string requireName(const char (&field)[size])
{
	const std::string name(field, ::strnlen(field, size));
	if (name.empty()) throw Error(XR_ERROR_NAME_INVALID, "the name is empty");
	if (name.size() == size) throw Error(XR_ERROR_NAME_INVALID, "the name is not terminated");
	if (!isWellFormedName(name)) throw Error(XR_ERROR_PATH_FORMAT_INVALID, "\"{}\" is not a well-formed name", name);
	return name;
}

template <size_t size> std::string requireLocalizedName(const char (&field)[size])
{
	const std::string name(field, ::strnlen(field, size));
	if (name.empty() || name.size() == size) throw Error(XR_ERROR_LOCALIZED_NAME_INVALID, "the localized name is empty or not terminated");
	return name;
}

void requireUnattached(const ActionSetCore &set)
{
	if (set.attached) throw Error(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "action set \"{}\" is attached to a session already", set.name);
}

XrActionType requireActionType(XrActionType type)
{
	switch (type) {
	case XR_ACTION_TYPE_BOOLEAN_INPUT:
	case XR_ACTION_TYPE_FLOAT_INPUT:
	case XR_ACTION_TYPE_VECTOR2F_INPUT:
	case XR_ACTION_TYPE_POSE_INPUT:
	case XR_ACTION_TYPE_VIBRATION_OUTPUT: return type;
	default: throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrActionType", int(type));
	}
}

std::set<XrPath> requireSubactionPaths(const Instance &instance, const XrActionCreateInfo &info)
{
	if (info.countSubactionPaths > 0 && !info.subactionPaths) throw Error(XR_ERROR_VALIDATION_FAILURE, "subactionPaths is null");
	std::set<XrPath> paths;
	for (const XrPath path : std::span(info.subactionPaths, info.countSubactionPaths)) {
		const std::string &text = instance.paths.text(path);
		if (!isTopLevelUserPath(text)) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no top level user path", text);
		if (!paths.insert(path).second) throw Error(XR_ERROR_PATH_UNSUPPORTED, "the subaction path {} is given twice", text);
	}
	return paths;
}

std::shared_ptr<ActionSetCore> makeCore(std::string name, std::string localizedName)
{
	auto core = std::make_shared<ActionSetCore>();
	core->name = std::move(name);
	core->localizedName = std::move(localizedName);
	return core;
}

} // namespace

ActionSet::ActionSet(Instance &owner, std::string name, std::string localizedName)
	: instance(owner), core(makeCore(std::move(name), std::move(localizedName)))
{
	instance.actionSetNames.lock()->take(core->name, core->localizedName);
}

ActionSet::~ActionSet() { instance.actionSetNames.lock()->giveBack(core->name, core->localizedName); }

Action::Action(ActionSet &owner, const XrActionCreateInfo &info)
	: instance(owner.instance),
	  set(owner.core),
	  type(requireActionType(info.actionType)),
	  name(requireName(info.actionName)),
	  localizedName(requireLocalizedName(info.localizedActionName)),
	  subactionPaths(requireSubactionPaths(instance, info))
{
	set->actionNames.lock()->take(name, localizedName);
	set->subactionPaths.lock()->insert(subactionPaths.begin(), subactionPaths.end());
}

Action::~Action() { set->actionNames.lock()->giveBack(name, localizedName); }

void Action::requireSubaction(XrPath path) const
{
	if (path == XR_NULL_PATH) return;
	const std::string &text = instance.paths.text(path);
	if (!subactionPaths.contains(path))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "action \"{}\" was not made with the subaction path {}", name, text);
}

void Action::requireType(XrActionType wanted) const
{
	if (type != wanted)
		throw Error(XR_ERROR_ACTION_TYPE_MISMATCH, "action \"{}\" is of XrActionType {}, not {}", name, int(type), int(wanted));
}

void createActionSet(Instance &instance, const XrActionSetCreateInfo &info, XrActionSet &set)
{
	auto made = std::make_unique<ActionSet>(instance, requireName(info.actionSetName), requireLocalizedName(info.localizedActionSetName));
	set = handles.insert(std::move(made), &instance);
}

void destroyActionSet(EvenIfLost<ActionSet> set) { handles.destroy(*set); }

void createAction(ActionSet &set, const XrActionCreateInfo &info, XrAction &action)
{
	requireUnattached(*set.core);
	action = handles.insert(std::make_unique<Action>(set, info), &set);
}

void destroyAction(EvenIfLost<Action> action) { handles.destroy(*action); }

void suggestInteractionProfileBindings(Instance &instance, const XrInteractionProfileSuggestedBinding &info)
{
	const std::string &profileName = instance.paths.text(info.interactionProfile);
	if (info.countSuggestedBindings == 0 || !info.suggestedBindings)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "no bindings are suggested for {}", profileName);
	const InteractionProfile *profile = findInteractionProfile(profileName, instance.is1_1());
	if (!profile) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no interaction profile of this runtime", profileName);
	for (const XrActionSuggestedBinding &suggested : std::span(info.suggestedBindings, info.countSuggestedBindings)) {
		const Action &action = handles.at<Action>(suggested.action);
		requireUnattached(*action.set);
		const std::string &path = instance.paths.text(suggested.binding);
		if (!profile->has(path, instance.is1_1()))
			throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} has no {} to bind action \"{}\" to", profileName, path, action.name);
	}
}

} // namespace arift::openxr
