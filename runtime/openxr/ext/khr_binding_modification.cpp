#include "runtime/openxr/ext/khr_binding_modification.h"
#include "runtime/openxr/action.h"
#include "runtime/openxr/interaction_profiles.h"

namespace arift::openxr
{
namespace
{

DpadModification dpadModification(const Instance &instance, const InteractionProfile &profile,
								  const XrInteractionProfileDpadBindingEXT &modification)
{
	const std::string &pad = instance.paths.text(modification.binding);
	const auto component = resolveSource(profile, pad, XR_ACTION_TYPE_VECTOR2F_INPUT, instance.features());
	const bool isPad = component && component->type == XR_ACTION_TYPE_VECTOR2F_INPUT && pad.ends_with(component->path);
	if (!isPad) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no thumbstick or trackpad of {}", pad, profile.title);
	return {modification.binding, handles.at<ActionSet>(modification.actionSet).core.get(), settingsOf(modification)};
}

void addDpad(std::vector<DpadModification> &all, const DpadModification &added)
{
	for (const DpadModification &other : all)
		if (other.pad == added.pad && other.set == added.set)
			throw Error(XR_ERROR_VALIDATION_FAILURE, "a directional pad is modified twice for the action set \"{}\"", added.set->name);
	all.push_back(added);
}

} // namespace

std::vector<DpadModification> modificationsIn(const Instance &instance, const InteractionProfile &profile, const void *next)
{
	std::vector<DpadModification> found;
	if (!instance.has(Extension::KHR_binding_modification)) return found;
	const auto *modifications = findInChain<XrBindingModificationsKHR>(next);
	if (!modifications || modifications->bindingModificationCount == 0) return found;
	if (!modifications->bindingModifications) throw Error(XR_ERROR_VALIDATION_FAILURE, "bindingModifications is null");
	for (const auto *header : std::span(modifications->bindingModifications, modifications->bindingModificationCount)) {
		if (!header) throw Error(XR_ERROR_VALIDATION_FAILURE, "a binding modification is null");
		if (header->type != XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT || !instance.has(Extension::EXT_dpad_binding)) continue;
		addDpad(found, dpadModification(instance, profile, *reinterpret_cast<const XrInteractionProfileDpadBindingEXT *>(header)));
	}
	return found;
}

} // namespace arift::openxr
