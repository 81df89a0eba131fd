#include "runtime/openxr/error.h"

namespace arift::openxr
{
namespace
{

template <typename Enum> struct Name {
	Enum value;
	const char *text;
};

#define ARIFT_NAME(name, value) {name, #name},
constexpr Name<XrResult> results[] = {XR_LIST_ENUM_XrResult(ARIFT_NAME)};
constexpr Name<XrStructureType> structures[] = {XR_LIST_ENUM_XrStructureType(ARIFT_NAME)};
#ifdef ARIFT_SUPPLIES_XR_VERSION_1_1
constexpr Name<XrResult> newerResults[] = {
	{XR_ERROR_PERMISSION_INSUFFICIENT, "XR_ERROR_PERMISSION_INSUFFICIENT"},
	{XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED, "XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED"},
};
constexpr Name<XrStructureType> newerStructures[] = {
	{XR_TYPE_SPACES_LOCATE_INFO, "XR_TYPE_SPACES_LOCATE_INFO"},
	{XR_TYPE_SPACE_LOCATIONS, "XR_TYPE_SPACE_LOCATIONS"},
	{XR_TYPE_SPACE_VELOCITIES, "XR_TYPE_SPACE_VELOCITIES"},
	{XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT, "XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT"},
	{XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT, "XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT"},
	{XR_TYPE_ACTIVE_ACTION_SET_PRIORITIES_EXT, "XR_TYPE_ACTIVE_ACTION_SET_PRIORITIES_EXT"},
	{XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT, "XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT"},
	{XR_TYPE_PERFORMANCE_METRICS_STATE_META, "XR_TYPE_PERFORMANCE_METRICS_STATE_META"},
	{XR_TYPE_PERFORMANCE_METRICS_COUNTER_META, "XR_TYPE_PERFORMANCE_METRICS_COUNTER_META"},
	{XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META, "XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META"},
	{XR_TYPE_COMPOSITION_LAYER_SETTINGS_FB, "XR_TYPE_COMPOSITION_LAYER_SETTINGS_FB"},
	{XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES2_FB, "XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES2_FB"},
	{XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB, "XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB"},
};
#else
constexpr Name<XrResult> newerResults[] = {{XR_SUCCESS, "XR_SUCCESS"}};
constexpr Name<XrStructureType> newerStructures[] = {{XR_TYPE_UNKNOWN, "XR_TYPE_UNKNOWN"}};
#endif

template <typename Enum, size_t size> const char *find(const Name<Enum> (&names)[size], Enum value)
{
	for (const Name<Enum> &name : names)
		if (name.value == value) return name.text;
	return nullptr;
}

} // namespace

const char *nameOf(XrResult result)
{
	const char *name = find(results, result);
	return name ? name : find(newerResults, result);
}

const char *nameOf(XrStructureType type)
{
	const char *name = find(structures, type);
	return name ? name : find(newerStructures, type);
}

} // namespace arift::openxr
