// OpenXR with the platform structures this library knows, and what the installed headers lack.
#pragma once
#include "runtime/base/xr.h"
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>
#ifndef EGL_NO_X11
#define EGL_NO_X11 // its types only, not X11's macros
#endif
#include <EGL/egl.h>
#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_GRAPHICS_API_OPENGL_ES
#define XR_USE_PLATFORM_EGL
#include "runtime/openxr/supplement_extensions.h"
#include <openxr/openxr_platform.h>
#include <openxr/openxr_reflection.h>

namespace arift::openxr
{

/// The XrStructureType of a structure; XR_TYPE_UNKNOWN for one without `type` and `next`.
template <typename T> constexpr XrStructureType structureType = XR_TYPE_UNKNOWN;
#define ARIFT_STRUCTURE(Struct, TYPE) template <> inline constexpr XrStructureType structureType<Struct> = TYPE;
XR_LIST_STRUCTURE_TYPES(ARIFT_STRUCTURE)
#ifdef ARIFT_SUPPLIES_XR_VERSION_1_1
ARIFT_STRUCTURE(XrSpacesLocateInfo, XR_TYPE_SPACES_LOCATE_INFO)
ARIFT_STRUCTURE(XrSpaceLocations, XR_TYPE_SPACE_LOCATIONS)
ARIFT_STRUCTURE(XrSpaceVelocities, XR_TYPE_SPACE_VELOCITIES)
#endif
#ifdef ARIFT_SUPPLIES_XR_EXT_user_presence
ARIFT_STRUCTURE(XrSystemUserPresencePropertiesEXT, XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT)
#endif
#ifdef ARIFT_SUPPLIES_XR_EXT_active_action_set_priority
ARIFT_STRUCTURE(XrActiveActionSetPrioritiesEXT, XR_TYPE_ACTIVE_ACTION_SET_PRIORITIES_EXT)
#endif
#ifdef ARIFT_SUPPLIES_XR_EXT_dpad_binding
ARIFT_STRUCTURE(XrInteractionProfileDpadBindingEXT, XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT)
#endif
#ifdef ARIFT_SUPPLIES_XR_META_performance_metrics
ARIFT_STRUCTURE(XrPerformanceMetricsStateMETA, XR_TYPE_PERFORMANCE_METRICS_STATE_META)
ARIFT_STRUCTURE(XrPerformanceMetricsCounterMETA, XR_TYPE_PERFORMANCE_METRICS_COUNTER_META)
#endif
#ifdef ARIFT_SUPPLIES_XR_META_headset_id
ARIFT_STRUCTURE(XrSystemHeadsetIdPropertiesMETA, XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META)
#endif
#ifdef ARIFT_SUPPLIES_XR_FB_composition_layer_settings
ARIFT_STRUCTURE(XrCompositionLayerSettingsFB, XR_TYPE_COMPOSITION_LAYER_SETTINGS_FB)
#endif
#ifdef ARIFT_SUPPLIES_XR_FB_composition_layer_depth_test
ARIFT_STRUCTURE(XrCompositionLayerDepthTestFB, XR_TYPE_COMPOSITION_LAYER_DEPTH_TEST_FB)
#endif
#ifdef ARIFT_SUPPLIES_XR_FB_passthrough_3
ARIFT_STRUCTURE(XrSystemPassthroughProperties2FB, XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES2_FB)
ARIFT_STRUCTURE(XrPassthroughBrightnessContrastSaturationFB, XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB)
#endif
#undef ARIFT_STRUCTURE

/// The first T in a chain of structures, or null.
template <typename T> const T *findInChain(const void *next)
{
	for (auto *structure = static_cast<const XrBaseInStructure *>(next); structure; structure = structure->next)
		if (structure->type == structureType<T>) return reinterpret_cast<const T *>(structure);
	return nullptr;
}
template <typename T> T *findInChain(void *next) { return const_cast<T *>(findInChain<T>(static_cast<const void *>(next))); }

} // namespace arift::openxr
