// Every function of the API by the version or extension it belongs to: what xrGetInstanceProcAddr answers, and when.
#include "runtime/openxr/functions.h"
#include "runtime/openxr/action.h"
#include "runtime/openxr/ext/ext_conformance_automation.h"
#include "runtime/openxr/ext/ext_debug_utils.h"
#include "runtime/openxr/ext/ext_hand_tracking.h"
#include "runtime/openxr/ext/ext_performance_settings.h"
#include "runtime/openxr/ext/fb_color_space.h"
#include "runtime/openxr/ext/fb_display_refresh_rate.h"
#include "runtime/openxr/ext/fb_passthrough.h"
#include "runtime/openxr/ext/khr_convert_timespec_time.h"
#include "runtime/openxr/ext/khr_opengl_enable.h"
#include "runtime/openxr/ext/khr_visibility_mask.h"
#include "runtime/openxr/ext/khr_vulkan_enable.h"
#include "runtime/openxr/ext/khr_vulkan_enable2.h"
#include "runtime/openxr/ext/meta_performance_metrics.h"
#include "runtime/openxr/ext/msft_controller_model.h"
#include "runtime/openxr/instance.h"
#include "runtime/openxr/session.h"
#include "runtime/openxr/space.h"
#include "runtime/openxr/swapchain.h"
#include <cstring>

namespace arift::openxr
{
namespace
{

XrResult XRAPI_CALL getInstanceProcAddrEntry(XrInstance instance, const char *name, PFN_xrVoidFunction *function)
{
	return getInstanceProcAddr(instance, name, function);
}

// X(name in the API, function of this library)
#define ARIFT_WITHOUT_INSTANCE(X)                                                                                                          \
	X(xrEnumerateApiLayerProperties, enumerateApiLayers)                                                                                   \
	X(xrEnumerateInstanceExtensionProperties, enumerateInstanceExtensions)                                                                 \
	X(xrCreateInstance, createInstance)
#define ARIFT_CORE_1_0(X)                                                                                                                  \
	X(xrDestroyInstance, destroyInstance)                                                                                                  \
	X(xrGetInstanceProperties, getInstanceProperties)                                                                                      \
	X(xrPollEvent, pollEvent)                                                                                                              \
	X(xrResultToString, resultToString)                                                                                                    \
	X(xrStructureTypeToString, structureTypeToString)                                                                                      \
	X(xrGetSystem, getSystem)                                                                                                              \
	X(xrGetSystemProperties, getSystemProperties)                                                                                          \
	X(xrEnumerateEnvironmentBlendModes, enumerateEnvironmentBlendModes)                                                                    \
	X(xrCreateSession, createSession)                                                                                                      \
	X(xrDestroySession, destroySession)                                                                                                    \
	X(xrEnumerateReferenceSpaces, enumerateReferenceSpaces)                                                                                \
	X(xrCreateReferenceSpace, createReferenceSpace)                                                                                        \
	X(xrGetReferenceSpaceBoundsRect, getReferenceSpaceBoundsRect)                                                                          \
	X(xrCreateActionSpace, createActionSpace)                                                                                              \
	X(xrLocateSpace, locateSpace)                                                                                                          \
	X(xrDestroySpace, destroySpace)                                                                                                        \
	X(xrEnumerateViewConfigurations, enumerateViewConfigurations)                                                                          \
	X(xrGetViewConfigurationProperties, getViewConfigurationProperties)                                                                    \
	X(xrEnumerateViewConfigurationViews, enumerateViewConfigurationViews)                                                                  \
	X(xrEnumerateSwapchainFormats, enumerateSwapchainFormats)                                                                              \
	X(xrCreateSwapchain, createSwapchain)                                                                                                  \
	X(xrDestroySwapchain, destroySwapchain)                                                                                                \
	X(xrEnumerateSwapchainImages, enumerateSwapchainImages)                                                                                \
	X(xrAcquireSwapchainImage, acquireSwapchainImage)                                                                                      \
	X(xrWaitSwapchainImage, waitSwapchainImage)                                                                                            \
	X(xrReleaseSwapchainImage, releaseSwapchainImage)                                                                                      \
	X(xrBeginSession, beginSession)                                                                                                        \
	X(xrEndSession, endSession)                                                                                                            \
	X(xrRequestExitSession, requestExitSession)                                                                                            \
	X(xrWaitFrame, waitFrame)                                                                                                              \
	X(xrBeginFrame, beginFrame)                                                                                                            \
	X(xrEndFrame, endFrame)                                                                                                                \
	X(xrLocateViews, locateViews)                                                                                                          \
	X(xrStringToPath, stringToPath)                                                                                                        \
	X(xrPathToString, pathToString)                                                                                                        \
	X(xrCreateActionSet, createActionSet)                                                                                                  \
	X(xrDestroyActionSet, destroyActionSet)                                                                                                \
	X(xrCreateAction, createAction)                                                                                                        \
	X(xrDestroyAction, destroyAction)                                                                                                      \
	X(xrSuggestInteractionProfileBindings, suggestInteractionProfileBindings)                                                              \
	X(xrAttachSessionActionSets, attachSessionActionSets)                                                                                  \
	X(xrGetCurrentInteractionProfile, getCurrentInteractionProfile)                                                                        \
	X(xrGetActionStateBoolean, getActionStateBoolean)                                                                                      \
	X(xrGetActionStateFloat, getActionStateFloat)                                                                                          \
	X(xrGetActionStateVector2f, getActionStateVector2f)                                                                                    \
	X(xrGetActionStatePose, getActionStatePose)                                                                                            \
	X(xrSyncActions, syncActions)                                                                                                          \
	X(xrEnumerateBoundSourcesForAction, enumerateBoundSourcesForAction)                                                                    \
	X(xrGetInputSourceLocalizedName, getInputSourceLocalizedName)                                                                          \
	X(xrApplyHapticFeedback, applyHapticFeedback)                                                                                          \
	X(xrStopHapticFeedback, stopHapticFeedback)
#define ARIFT_CORE_1_1(X) X(xrLocateSpaces, locateSpacesOf1_1)
#define ARIFT_KHR_vulkan_enable(X)                                                                                                         \
	X(xrGetVulkanInstanceExtensionsKHR, getVulkanInstanceExtensions)                                                                       \
	X(xrGetVulkanDeviceExtensionsKHR, getVulkanDeviceExtensions)                                                                           \
	X(xrGetVulkanGraphicsDeviceKHR, getVulkanGraphicsDevice)                                                                               \
	X(xrGetVulkanGraphicsRequirementsKHR, getVulkanGraphicsRequirements)
#define ARIFT_KHR_vulkan_enable2(X)                                                                                                        \
	X(xrCreateVulkanInstanceKHR, createVulkanInstance)                                                                                     \
	X(xrCreateVulkanDeviceKHR, createVulkanDevice)                                                                                         \
	X(xrGetVulkanGraphicsDevice2KHR, getVulkanGraphicsDevice2)                                                                             \
	X(xrGetVulkanGraphicsRequirements2KHR, getVulkanGraphicsRequirements)
#define ARIFT_KHR_convert_timespec_time(X)                                                                                                 \
	X(xrConvertTimespecTimeToTimeKHR, convertTimespecTimeToTime)                                                                           \
	X(xrConvertTimeToTimespecTimeKHR, convertTimeToTimespecTime)
#define ARIFT_EXT_debug_utils(X)                                                                                                           \
	X(xrSetDebugUtilsObjectNameEXT, setDebugUtilsObjectName)                                                                               \
	X(xrCreateDebugUtilsMessengerEXT, createDebugUtilsMessenger)                                                                           \
	X(xrDestroyDebugUtilsMessengerEXT, destroyDebugUtilsMessenger)                                                                         \
	X(xrSubmitDebugUtilsMessageEXT, submitDebugUtilsMessage)                                                                               \
	X(xrSessionBeginDebugUtilsLabelRegionEXT, sessionBeginDebugUtilsLabelRegion)                                                           \
	X(xrSessionEndDebugUtilsLabelRegionEXT, sessionEndDebugUtilsLabelRegion)                                                               \
	X(xrSessionInsertDebugUtilsLabelEXT, sessionInsertDebugUtilsLabel)

/// What must hold for a function to be there. Those of OpenXR 1.1 say themselves that an instance of 1.0 has them not: loaders hand out
/// their own entry points for the core, whatever the instance's version, and call what they find here.
enum class Needs { nothing, instance, extension };

struct Function {
	const char *name;
	PFN_xrVoidFunction entry;
	Needs needs;
	Extension extension = Extension::count;
};

#define ARIFT_ENTRY(name, function) reinterpret_cast<PFN_xrVoidFunction>(&EntryPoint<#name, PFN_##name, function>::call)
#define ARIFT_FREE(name, function) {#name, ARIFT_ENTRY(name, function), Needs::nothing},
#define ARIFT_BASIC(name, function) {#name, ARIFT_ENTRY(name, function), Needs::instance},
#define ARIFT_OF(name, function, owner) {#name, ARIFT_ENTRY(name, function), Needs::extension, Extension::owner},
#define ARIFT_OF_vulkan_enable(name, function) ARIFT_OF(name, function, KHR_vulkan_enable)
#define ARIFT_OF_vulkan_enable2(name, function) ARIFT_OF(name, function, KHR_vulkan_enable2)
#define ARIFT_OF_convert_timespec_time(name, function) ARIFT_OF(name, function, KHR_convert_timespec_time)
#define ARIFT_OF_debug_utils(name, function) ARIFT_OF(name, function, EXT_debug_utils)

const Function functions[] = {
	// clang-format off
	{"xrGetInstanceProcAddr", reinterpret_cast<PFN_xrVoidFunction>(&getInstanceProcAddrEntry), Needs::nothing},
	ARIFT_WITHOUT_INSTANCE(ARIFT_FREE)
	ARIFT_CORE_1_0(ARIFT_BASIC)
	ARIFT_CORE_1_1(ARIFT_BASIC)
	ARIFT_KHR_vulkan_enable(ARIFT_OF_vulkan_enable)
	ARIFT_KHR_vulkan_enable2(ARIFT_OF_vulkan_enable2)
	ARIFT_KHR_convert_timespec_time(ARIFT_OF_convert_timespec_time)
	ARIFT_EXT_debug_utils(ARIFT_OF_debug_utils)
	ARIFT_OF(xrStructureTypeToString2KHR, structureTypeToString2, KHR_extended_struct_name_lengths)
	ARIFT_OF(xrGetOpenGLGraphicsRequirementsKHR, getOpenGLGraphicsRequirements, KHR_opengl_enable)
	ARIFT_OF(xrGetOpenGLESGraphicsRequirementsKHR, getOpenGLESGraphicsRequirements, KHR_opengl_es_enable)
	ARIFT_OF(xrLocateSpacesKHR, locateSpaces, KHR_locate_spaces)
	ARIFT_OF(xrGetVisibilityMaskKHR, getVisibilityMask, KHR_visibility_mask)
	ARIFT_OF(xrSetInputDeviceActiveEXT, setInputDeviceActive, EXT_conformance_automation)
	ARIFT_OF(xrSetInputDeviceStateBoolEXT, setInputDeviceStateBool, EXT_conformance_automation)
	ARIFT_OF(xrSetInputDeviceStateFloatEXT, setInputDeviceStateFloat, EXT_conformance_automation)
	ARIFT_OF(xrSetInputDeviceStateVector2fEXT, setInputDeviceStateVector2f, EXT_conformance_automation)
	ARIFT_OF(xrSetInputDeviceLocationEXT, setInputDeviceLocation, EXT_conformance_automation)
	ARIFT_OF(xrCreateHandTrackerEXT, createHandTracker, EXT_hand_tracking)
	ARIFT_OF(xrDestroyHandTrackerEXT, destroyHandTracker, EXT_hand_tracking)
	ARIFT_OF(xrLocateHandJointsEXT, locateHandJoints, EXT_hand_tracking)
	ARIFT_OF(xrPerfSettingsSetPerformanceLevelEXT, setPerformanceLevel, EXT_performance_settings)
	ARIFT_OF(xrGetControllerModelKeyMSFT, getControllerModelKey, MSFT_controller_model)
	ARIFT_OF(xrLoadControllerModelMSFT, loadControllerModel, MSFT_controller_model)
	ARIFT_OF(xrGetControllerModelPropertiesMSFT, getControllerModelProperties, MSFT_controller_model)
	ARIFT_OF(xrGetControllerModelStateMSFT, getControllerModelState, MSFT_controller_model)
	ARIFT_OF(xrEnumerateColorSpacesFB, enumerateColorSpaces, FB_color_space)
	ARIFT_OF(xrSetColorSpaceFB, setColorSpace, FB_color_space)
	ARIFT_OF(xrEnumerateDisplayRefreshRatesFB, enumerateDisplayRefreshRates, FB_display_refresh_rate)
	ARIFT_OF(xrGetDisplayRefreshRateFB, getDisplayRefreshRate, FB_display_refresh_rate)
	ARIFT_OF(xrRequestDisplayRefreshRateFB, requestDisplayRefreshRate, FB_display_refresh_rate)
	ARIFT_OF(xrCreatePassthroughFB, createPassthrough, FB_passthrough)
	ARIFT_OF(xrDestroyPassthroughFB, destroyPassthrough, FB_passthrough)
	ARIFT_OF(xrPassthroughStartFB, startPassthrough, FB_passthrough)
	ARIFT_OF(xrPassthroughPauseFB, pausePassthrough, FB_passthrough)
	ARIFT_OF(xrCreatePassthroughLayerFB, createPassthroughLayer, FB_passthrough)
	ARIFT_OF(xrDestroyPassthroughLayerFB, destroyPassthroughLayer, FB_passthrough)
	ARIFT_OF(xrPassthroughLayerPauseFB, pausePassthroughLayer, FB_passthrough)
	ARIFT_OF(xrPassthroughLayerResumeFB, resumePassthroughLayer, FB_passthrough)
	ARIFT_OF(xrPassthroughLayerSetStyleFB, setPassthroughLayerStyle, FB_passthrough)
	ARIFT_OF(xrCreateGeometryInstanceFB, createGeometryInstance, FB_passthrough)
	ARIFT_OF(xrDestroyGeometryInstanceFB, destroyGeometryInstance, FB_passthrough)
	ARIFT_OF(xrGeometryInstanceSetTransformFB, setGeometryInstanceTransform, FB_passthrough)
	ARIFT_OF(xrEnumeratePerformanceMetricsCounterPathsMETA, enumeratePerformanceMetricsCounterPaths, META_performance_metrics)
	ARIFT_OF(xrSetPerformanceMetricsStateMETA, setPerformanceMetricsState, META_performance_metrics)
	ARIFT_OF(xrGetPerformanceMetricsStateMETA, getPerformanceMetricsState, META_performance_metrics)
	ARIFT_OF(xrQueryPerformanceMetricsCounterMETA, queryPerformanceMetricsCounter, META_performance_metrics)
	// clang-format on
};

bool isThere(const Function &function, const Instance *instance)
{
	if (function.needs == Needs::nothing) return true;
	if (!instance) return false;
	return function.needs == Needs::instance || instance->has(function.extension);
}

const Instance *instanceOrNull(XrInstance handle) { return handle ? &handles.at<Instance>(handle) : nullptr; }

} // namespace

XrResult getInstanceProcAddr(XrInstance handle, const char *name, PFN_xrVoidFunction *function) noexcept
{
	try {
		if (!function || !name) throw Error(XR_ERROR_VALIDATION_FAILURE, "the name or the pointer to the function is null");
		*function = nullptr;
		const Instance *instance = instanceOrNull(handle);
		for (const Function &candidate : functions)
			if (std::strcmp(candidate.name, name) == 0 && isThere(candidate, instance)) {
				*function = candidate.entry;
				return XR_SUCCESS;
			}
		// Without an instance most names are unknown as yet; with one, asking for what is not there is how applications find out.
		return instance ? XR_ERROR_FUNCTION_UNSUPPORTED : XR_ERROR_HANDLE_INVALID;
	} catch (...) {
		return report("xrGetInstanceProcAddr", reinterpret_cast<uint64_t>(handle));
	}
}

std::vector<const char *> functionNames()
{
	std::vector<const char *> names;
	for (const Function &function : functions) names.push_back(function.name);
	return names;
}

} // namespace arift::openxr
