// Making actions and suggesting bindings: everything that happens before a session has them.
#include "runtime/openxr/action.h"
#include "runtime/openxr/ext/khr_binding_modification.h"
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
		if (!isTopLevelUserPath(text, instance.features())) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no top level user path", text);
		if (!paths.insert(path).second) throw Error(XR_ERROR_PATH_UNSUPPORTED, "the subaction path {} is given twice", text);
	}
	return paths;
}

std::shared_ptr<ActionSetCore> makeCore(const XrActionSetCreateInfo &info)
{
	auto core = std::make_shared<ActionSetCore>();
	core->name = requireName(info.actionSetName);
	core->localizedName = requireLocalizedName(info.localizedActionSetName);
	core->priority = info.priority;
	return core;
}

std::shared_ptr<const ActionCore> makeCore(const ActionSet &owner, const XrActionCreateInfo &info)
{
	return std::make_shared<const ActionCore>(ActionCore{owner.core, requireActionType(info.actionType), requireName(info.actionName),
														 requireLocalizedName(info.localizedActionName),
														 requireSubactionPaths(owner.instance, info)});
}

/// /user/hand/left/input/trackpad of /user/hand/left/input/trackpad/x
std::string_view identifierOf(std::string_view path, std::string_view user)
{
	const size_t name = path.find('/', user.size() + 1);
	return path.substr(0, path.find('/', name + 1));
}

SourcePart partOf(const Component &component, const std::vector<Component> &all)
{
	if (dpadRegionNamed(std::string_view(component.path).substr(component.path.rfind('/') + 1))) return SourcePart::dpad;
	const std::string_view path = component.path, parent = path.substr(0, path.rfind('/'));
	const bool isOfVector = std::ranges::any_of(
		all, [&](const Component &other) { return other.path == parent && other.type == XR_ACTION_TYPE_VECTOR2F_INPUT; });
	if (isOfVector && path.ends_with("/x")) return SourcePart::x;
	if (isOfVector && path.ends_with("/y")) return SourcePart::y;
	return SourcePart::whole;
}

/// A trackpad is pressed by force where it feels force, else by its click, else by a touch; a thumbstick is not pressed.
XrPath pressOf(Instance &instance, const std::string &pad, std::string_view user, const std::vector<Component> &all)
{
	if (!pad.ends_with("trackpad")) return XR_NULL_PATH;
	for (const char *ending : {"/force", "/click", "/touch"})
		for (const Component &component : all)
			if (pad + ending == std::string(user) + component.path) return instance.paths.atom(pad + ending);
	return XR_NULL_PATH;
}

Binding makeBinding(Instance &instance, const InteractionProfile &profile, const XrActionSuggestedBinding &suggested,
					const std::vector<DpadModification> &modifications)
{
	const Action &action = handles.at<Action>(suggested.action);
	requireUnattached(*action.core->set);
	const std::string &path = instance.paths.text(suggested.binding);
	const Features features = instance.features();
	const auto component = resolveSource(profile, path, action.core->type, features);
	if (!component) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} has no {} to bind action \"{}\" to", profile.title, path, action.core->name);
	const std::string user(splitSource(profile, path)->user), source = user + component->path, pad(identifierOf(source, user));
	const std::vector<Component> all = componentsOf(profile, user, features);
	Binding binding{.action = action.core,
					.user = instance.paths.atom(user),
					.identifier = instance.paths.atom(pad),
					.source = instance.paths.atom(source),
					.type = component->type,
					.part = partOf(*component, all)};
	if (binding.part != SourcePart::dpad) return binding;
	binding.direction = dpadRegionNamed(std::string_view(source).substr(source.rfind('/') + 1));
	binding.press = pressOf(instance, pad, user, all);
	for (const DpadModification &modification : modifications)
		if (modification.pad == binding.identifier && modification.set == action.core->set.get()) binding.dpad = modification.settings;
	return binding;
}

} // namespace

ActionSet::ActionSet(Instance &owner, const XrActionSetCreateInfo &info) : instance(owner), core(makeCore(info))
{
	instance.actionSetNames.lock()->take(core->name, core->localizedName);
}

ActionSet::~ActionSet() { instance.actionSetNames.lock()->giveBack(core->name, core->localizedName); }

Action::Action(ActionSet &owner, const XrActionCreateInfo &info) : instance(owner.instance), core(makeCore(owner, info))
{
	core->set->actionNames.lock()->take(core->name, core->localizedName);
	core->set->subactionPaths.lock()->insert(core->subactionPaths.begin(), core->subactionPaths.end());
}

Action::~Action() { core->set->actionNames.lock()->giveBack(core->name, core->localizedName); }

void Action::requireSubaction(XrPath path) const
{
	if (path == XR_NULL_PATH) return;
	const std::string &text = instance.paths.text(path);
	if (!core->subactionPaths.contains(path))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "action \"{}\" was not made with the subaction path {}", core->name, text);
}

void Action::requireType(XrActionType wanted) const
{
	if (core->type != wanted)
		throw Error(XR_ERROR_ACTION_TYPE_MISMATCH, "action \"{}\" is of XrActionType {}, not {}", core->name, int(core->type), int(wanted));
}

void createActionSet(Instance &instance, const XrActionSetCreateInfo &info, XrActionSet &set)
{
	set = handles.insert(std::make_unique<ActionSet>(instance, info), &instance);
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
	const InteractionProfile *profile = findInteractionProfile(profileName, instance.features());
	if (!profile) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no interaction profile of this runtime", profileName);
	const std::vector<DpadModification> modifications = modificationsIn(instance, *profile, info.next);
	std::vector<Binding> bindings;
	for (const XrActionSuggestedBinding &suggested : std::span(info.suggestedBindings, info.countSuggestedBindings)) {
		bindings.push_back(makeBinding(instance, *profile, suggested, modifications));
		bindings.back().profile = info.interactionProfile;
	}
	instance.suggestions.lock()->insert_or_assign(info.interactionProfile, std::move(bindings));
}

} // namespace arift::openxr
