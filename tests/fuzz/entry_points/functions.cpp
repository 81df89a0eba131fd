#include "tests/fuzz/entry_points/functions.h"

namespace arift::fuzz
{
namespace
{

/// XR_ERROR_HANDLE_INVALID as HANDLE_INVALID.
std::string_view shortNameOf(XrResult result)
{
	const char *name = openxr::nameOf(result);
	if (!name) return {};
	std::string_view rest = name;
	for (const std::string_view prefix : {"XR_", "ERROR_"})
		if (rest.starts_with(prefix)) rest.remove_prefix(prefix.size());
	return rest;
}

bool isAmong(std::string_view words, std::string_view word)
{
	for (size_t at = words.find(word); at != words.npos; at = words.find(word, at + 1)) {
		const size_t end = at + word.size();
		if ((at == 0 || words[at - 1] == ' ') && (end == words.size() || words[end] == ' ')) return true;
	}
	return false;
}

// clang-format off
#define ARIFT_ENTRY(name, parameters, results) \
	EntryPoint{#name, parameters, results, Caller<PFN_##name>::call, Caller<PFN_##name>::belongingOf(#name)}

/// New ones belong at the end. XR_ERROR_OUT_OF_MEMORY is among no results: nothing here needs much.
constexpr EntryPoint all[] = {
	ARIFT_ENTRY(xrGetInstanceProcAddr, "instance name function", "FUNCTION_UNSUPPORTED"),
	ARIFT_ENTRY(xrEnumerateApiLayerProperties, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrEnumerateInstanceExtensionProperties, "layerName capacity count properties",
		"API_LAYER_NOT_PRESENT RUNTIME_UNAVAILABLE SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrCreateInstance, "",
		"API_LAYER_NOT_PRESENT API_VERSION_UNSUPPORTED EXTENSION_NOT_PRESENT INITIALIZATION_FAILED LIMIT_REACHED NAME_INVALID "
		"RUNTIME_UNAVAILABLE"),
	ARIFT_ENTRY(xrDestroyInstance, "", ""),
	ARIFT_ENTRY(xrGetInstanceProperties, "", ""),
	ARIFT_ENTRY(xrPollEvent, "", "EVENT_UNAVAILABLE"),
	ARIFT_ENTRY(xrResultToString, "instance value buffer64", ""),
	ARIFT_ENTRY(xrStructureTypeToString, "instance value buffer64", ""),
	ARIFT_ENTRY(xrGetSystem, "", "FORM_FACTOR_UNAVAILABLE FORM_FACTOR_UNSUPPORTED"),
	ARIFT_ENTRY(xrGetSystemProperties, "instance systemId properties", "SYSTEM_INVALID"),
	ARIFT_ENTRY(xrEnumerateEnvironmentBlendModes, "instance systemId type capacity count modes",
		"SIZE_INSUFFICIENT SYSTEM_INVALID VIEW_CONFIGURATION_TYPE_UNSUPPORTED"),
	ARIFT_ENTRY(xrCreateSession, "",
		"GRAPHICS_DEVICE_INVALID GRAPHICS_REQUIREMENTS_CALL_MISSING INITIALIZATION_FAILED LIMIT_REACHED SYSTEM_INVALID"),
	ARIFT_ENTRY(xrDestroySession, "", ""),
	ARIFT_ENTRY(xrEnumerateReferenceSpaces, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrCreateReferenceSpace, "", "LIMIT_REACHED POSE_INVALID REFERENCE_SPACE_UNSUPPORTED"),
	ARIFT_ENTRY(xrGetReferenceSpaceBoundsRect, "", "SPACE_BOUNDS_UNAVAILABLE REFERENCE_SPACE_UNSUPPORTED"),
	ARIFT_ENTRY(xrCreateActionSpace, "", "ACTION_TYPE_MISMATCH LIMIT_REACHED PATH_INVALID PATH_UNSUPPORTED POSE_INVALID"),
	ARIFT_ENTRY(xrLocateSpace, "space baseSpace time location", "TIME_INVALID"),
	ARIFT_ENTRY(xrDestroySpace, "", ""),
	ARIFT_ENTRY(xrEnumerateViewConfigurations, "instance systemId capacity count types", "SIZE_INSUFFICIENT SYSTEM_INVALID"),
	ARIFT_ENTRY(xrGetViewConfigurationProperties, "instance systemId type properties",
		"SYSTEM_INVALID VIEW_CONFIGURATION_TYPE_UNSUPPORTED"),
	ARIFT_ENTRY(xrEnumerateViewConfigurationViews, "instance systemId type capacity count views",
		"SIZE_INSUFFICIENT SYSTEM_INVALID VIEW_CONFIGURATION_TYPE_UNSUPPORTED"),
	ARIFT_ENTRY(xrEnumerateSwapchainFormats, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrCreateSwapchain, "", "FEATURE_UNSUPPORTED LIMIT_REACHED SWAPCHAIN_FORMAT_UNSUPPORTED"),
	ARIFT_ENTRY(xrDestroySwapchain, "", ""),
	ARIFT_ENTRY(xrEnumerateSwapchainImages, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrAcquireSwapchainImage, "", "CALL_ORDER_INVALID"),
	ARIFT_ENTRY(xrWaitSwapchainImage, "", "TIMEOUT_EXPIRED CALL_ORDER_INVALID"),
	ARIFT_ENTRY(xrReleaseSwapchainImage, "", "CALL_ORDER_INVALID"),
	ARIFT_ENTRY(xrBeginSession, "", "SESSION_NOT_READY SESSION_RUNNING VIEW_CONFIGURATION_TYPE_UNSUPPORTED"),
	ARIFT_ENTRY(xrEndSession, "", "SESSION_NOT_RUNNING SESSION_NOT_STOPPING"),
	ARIFT_ENTRY(xrRequestExitSession, "", "SESSION_NOT_RUNNING"),
	ARIFT_ENTRY(xrWaitFrame, "", "SESSION_NOT_RUNNING"),
	ARIFT_ENTRY(xrBeginFrame, "", "FRAME_DISCARDED  CALL_ORDER_INVALID SESSION_NOT_RUNNING"),
	ARIFT_ENTRY(xrEndFrame, "",
		"CALL_ORDER_INVALID ENVIRONMENT_BLEND_MODE_UNSUPPORTED LAYER_INVALID LAYER_LIMIT_EXCEEDED POSE_INVALID "
		"SESSION_NOT_RUNNING SWAPCHAIN_RECT_INVALID TIME_INVALID"),
	ARIFT_ENTRY(xrLocateViews, "", "SIZE_INSUFFICIENT TIME_INVALID VIEW_CONFIGURATION_TYPE_UNSUPPORTED"),
	ARIFT_ENTRY(xrStringToPath, "instance pathString path", "PATH_COUNT_EXCEEDED PATH_FORMAT_INVALID"),
	ARIFT_ENTRY(xrPathToString, "instance path capacity count buffer", "PATH_INVALID SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrCreateActionSet, "",
		"LIMIT_REACHED LOCALIZED_NAME_DUPLICATED LOCALIZED_NAME_INVALID NAME_DUPLICATED NAME_INVALID PATH_FORMAT_INVALID"),
	ARIFT_ENTRY(xrDestroyActionSet, "", ""),
	ARIFT_ENTRY(xrCreateAction, "",
		"ACTIONSETS_ALREADY_ATTACHED LIMIT_REACHED LOCALIZED_NAME_DUPLICATED LOCALIZED_NAME_INVALID NAME_DUPLICATED NAME_INVALID "
		"PATH_FORMAT_INVALID PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrDestroyAction, "", ""),
	ARIFT_ENTRY(xrSuggestInteractionProfileBindings, "", "ACTIONSETS_ALREADY_ATTACHED PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrAttachSessionActionSets, "", "ACTIONSETS_ALREADY_ATTACHED"),
	ARIFT_ENTRY(xrGetCurrentInteractionProfile, "session topLevelUserPath state", "ACTIONSET_NOT_ATTACHED PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrGetActionStateBoolean, "", "ACTIONSET_NOT_ATTACHED ACTION_TYPE_MISMATCH PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrGetActionStateFloat, "", "ACTIONSET_NOT_ATTACHED ACTION_TYPE_MISMATCH PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrGetActionStateVector2f, "", "ACTIONSET_NOT_ATTACHED ACTION_TYPE_MISMATCH PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrGetActionStatePose, "", "ACTIONSET_NOT_ATTACHED ACTION_TYPE_MISMATCH PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrSyncActions, "", "SESSION_NOT_FOCUSED ACTIONSET_NOT_ATTACHED PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrEnumerateBoundSourcesForAction, "", "ACTIONSET_NOT_ATTACHED PATH_INVALID SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrGetInputSourceLocalizedName, "", "ACTIONSET_NOT_ATTACHED PATH_INVALID PATH_UNSUPPORTED SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrApplyHapticFeedback, "",
		"SESSION_NOT_FOCUSED ACTIONSET_NOT_ATTACHED ACTION_TYPE_MISMATCH PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrStopHapticFeedback, "",
		"SESSION_NOT_FOCUSED ACTIONSET_NOT_ATTACHED ACTION_TYPE_MISMATCH PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrLocateSpaces, "", "FUNCTION_UNSUPPORTED TIME_INVALID"),
	ARIFT_ENTRY(xrLocateSpacesKHR, "", "TIME_INVALID"),
	ARIFT_ENTRY(xrGetVulkanGraphicsRequirementsKHR, "instance systemId requirements", "SYSTEM_INVALID"),
	ARIFT_ENTRY(xrGetVulkanGraphicsRequirements2KHR, "instance systemId requirements", "SYSTEM_INVALID"),
	ARIFT_ENTRY(xrConvertTimespecTimeToTimeKHR, "", "TIME_INVALID"),
	ARIFT_ENTRY(xrConvertTimeToTimespecTimeKHR, "instance time timespecTime", "TIME_INVALID"),
	ARIFT_ENTRY(xrSetDebugUtilsObjectNameEXT, "", ""),
	ARIFT_ENTRY(xrCreateDebugUtilsMessengerEXT, "", "LIMIT_REACHED"),
	ARIFT_ENTRY(xrDestroyDebugUtilsMessengerEXT, "", ""),
	ARIFT_ENTRY(xrSubmitDebugUtilsMessageEXT, "instance messageSeverity messageTypes data", ""),
	ARIFT_ENTRY(xrSessionBeginDebugUtilsLabelRegionEXT, "", ""),
	ARIFT_ENTRY(xrSessionEndDebugUtilsLabelRegionEXT, "", ""),
	ARIFT_ENTRY(xrSessionInsertDebugUtilsLabelEXT, "", ""),
	ARIFT_ENTRY(xrStructureTypeToString2KHR, "instance value buffer256", ""),
	ARIFT_ENTRY(xrGetOpenGLGraphicsRequirementsKHR, "instance systemId requirements", "SYSTEM_INVALID"),
	ARIFT_ENTRY(xrGetOpenGLESGraphicsRequirementsKHR, "instance systemId requirements", "SYSTEM_INVALID"),
	ARIFT_ENTRY(xrGetVisibilityMaskKHR, "session type viewIndex maskType mask", "SIZE_INSUFFICIENT VIEW_CONFIGURATION_TYPE_UNSUPPORTED"),
	ARIFT_ENTRY(xrSetInputDeviceActiveEXT, "session interactionProfile topLevelPath isActive", "PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrSetInputDeviceStateBoolEXT, "session topLevelPath inputSourcePath state", "PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrSetInputDeviceStateFloatEXT, "session topLevelPath inputSourcePath state", "PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrSetInputDeviceStateVector2fEXT, "session topLevelPath inputSourcePath state", "PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrSetInputDeviceLocationEXT, "session topLevelPath inputSourcePath space pose",
		"PATH_INVALID PATH_UNSUPPORTED POSE_INVALID"),
	ARIFT_ENTRY(xrCreateHandTrackerEXT, "", "FEATURE_UNSUPPORTED LIMIT_REACHED"),
	ARIFT_ENTRY(xrDestroyHandTrackerEXT, "", ""),
	ARIFT_ENTRY(xrLocateHandJointsEXT, "", "TIME_INVALID"),
	ARIFT_ENTRY(xrPerfSettingsSetPerformanceLevelEXT, "", ""),
	ARIFT_ENTRY(xrGetControllerModelKeyMSFT, "session topLevelUserPath state",
		"CONTROLLER_MODEL_KEY_INVALID_MSFT PATH_INVALID PATH_UNSUPPORTED"),
	ARIFT_ENTRY(xrLoadControllerModelMSFT, "session modelKey capacity count buffer",
		"CONTROLLER_MODEL_KEY_INVALID_MSFT SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrGetControllerModelPropertiesMSFT, "session modelKey properties", "CONTROLLER_MODEL_KEY_INVALID_MSFT SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrGetControllerModelStateMSFT, "session modelKey state", "CONTROLLER_MODEL_KEY_INVALID_MSFT"),
	ARIFT_ENTRY(xrEnumerateColorSpacesFB, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrSetColorSpaceFB, "", "COLOR_SPACE_UNSUPPORTED_FB FEATURE_UNSUPPORTED"),
	ARIFT_ENTRY(xrEnumerateDisplayRefreshRatesFB, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrGetDisplayRefreshRateFB, "", ""),
	ARIFT_ENTRY(xrRequestDisplayRefreshRateFB, "session displayRefreshRate", "DISPLAY_REFRESH_RATE_UNSUPPORTED_FB FEATURE_UNSUPPORTED"),
	ARIFT_ENTRY(xrCreatePassthroughFB, "",
		"FEATURE_ALREADY_CREATED_PASSTHROUGH_FB FEATURE_UNSUPPORTED LIMIT_REACHED NOT_PERMITTED_PASSTHROUGH_FB UNKNOWN_PASSTHROUGH_FB"),
	ARIFT_ENTRY(xrDestroyPassthroughFB, "", "FEATURE_UNSUPPORTED"),
	ARIFT_ENTRY(xrPassthroughStartFB, "", "FEATURE_UNSUPPORTED UNEXPECTED_STATE_PASSTHROUGH_FB"),
	ARIFT_ENTRY(xrPassthroughPauseFB, "", "FEATURE_UNSUPPORTED UNEXPECTED_STATE_PASSTHROUGH_FB"),
	ARIFT_ENTRY(xrCreatePassthroughLayerFB, "",
		"FEATURE_REQUIRED_PASSTHROUGH_FB FEATURE_UNSUPPORTED INSUFFICIENT_RESOURCES_PASSTHROUGH_FB LIMIT_REACHED UNKNOWN_PASSTHROUGH_FB"),
	ARIFT_ENTRY(xrDestroyPassthroughLayerFB, "", "FEATURE_UNSUPPORTED"),
	ARIFT_ENTRY(xrPassthroughLayerPauseFB, "", "FEATURE_UNSUPPORTED UNEXPECTED_STATE_PASSTHROUGH_FB"),
	ARIFT_ENTRY(xrPassthroughLayerResumeFB, "", "FEATURE_UNSUPPORTED UNEXPECTED_STATE_PASSTHROUGH_FB"),
	ARIFT_ENTRY(xrPassthroughLayerSetStyleFB, "", "FEATURE_UNSUPPORTED"),
	ARIFT_ENTRY(xrCreateGeometryInstanceFB, "", "FEATURE_UNSUPPORTED INSUFFICIENT_RESOURCES_PASSTHROUGH_FB LIMIT_REACHED POSE_INVALID"),
	ARIFT_ENTRY(xrDestroyGeometryInstanceFB, "", "FEATURE_UNSUPPORTED"),
	ARIFT_ENTRY(xrGeometryInstanceSetTransformFB, "", "FEATURE_UNSUPPORTED POSE_INVALID TIME_INVALID"),
	ARIFT_ENTRY(xrEnumeratePerformanceMetricsCounterPathsMETA, "", "SIZE_INSUFFICIENT"),
	ARIFT_ENTRY(xrSetPerformanceMetricsStateMETA, "", ""),
	ARIFT_ENTRY(xrGetPerformanceMetricsStateMETA, "", ""),
	ARIFT_ENTRY(xrQueryPerformanceMetricsCounterMETA, "session counterPath counter", "PATH_INVALID PATH_UNSUPPORTED"),
};
// clang-format on
#undef ARIFT_ENTRY

constexpr const char *left[] = {"xrGetVulkanInstanceExtensionsKHR", "xrGetVulkanDeviceExtensionsKHR", "xrGetVulkanGraphicsDeviceKHR",
								"xrGetVulkanGraphicsDevice2KHR",    "xrCreateVulkanInstanceKHR",      "xrCreateVulkanDeviceKHR"};

} // namespace

std::span<const EntryPoint> entryPoints() { return all; }
std::span<const char *const> leftOut() { return left; }

bool EntryPoint::mayReturn(XrResult result) const
{
	const std::string_view word = shortNameOf(result);
	if (result == XR_SUCCESS) return true;
	if (word.empty()) return false;
	if (isAmong(results, word)) return true;
	switch (belonging) {
	case Belonging::none: return word == "VALIDATION_FAILURE";
	case Belonging::ends: return word == "HANDLE_INVALID";
	case Belonging::session:
		if (word == "SESSION_LOST") return true;
		[[fallthrough]];
	default: return isAmong("VALIDATION_FAILURE HANDLE_INVALID INSTANCE_LOST", word);
	}
}

} // namespace arift::fuzz
