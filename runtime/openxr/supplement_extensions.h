// Extensions newer than Debian 12's OpenXR 1.0.20 headers. Names and values are the specification's. Every group gives way to the newer
// headers through the macro that they define.
#pragma once
#include "runtime/openxr/supplement.h"

// ---- extensions that bring nothing to be declared: interaction profiles, poses, spaces

#ifndef XR_EXT_local_floor
#define XR_EXT_local_floor 1
#define XR_EXT_local_floor_SPEC_VERSION 1
#endif
#ifndef XR_EXT_uuid
#define XR_EXT_uuid 1
#define XR_EXT_uuid_SPEC_VERSION 1
#endif
#ifndef XR_EXT_palm_pose
#define XR_EXT_palm_pose 1
#define XR_EXT_palm_pose_SPEC_VERSION 3
#endif
#ifndef XR_EXT_hand_interaction
#define XR_EXT_hand_interaction 1
#define XR_EXT_hand_interaction_SPEC_VERSION 1
#endif
#ifndef XR_KHR_maintenance1
#define XR_KHR_maintenance1 1
#define XR_KHR_maintenance1_SPEC_VERSION 1
#endif
#ifndef XR_HTC_vive_focus3_controller_interaction
#define XR_HTC_vive_focus3_controller_interaction 1
#define XR_HTC_vive_focus3_controller_interaction_SPEC_VERSION 2
#endif
#ifndef XR_HTC_hand_interaction
#define XR_HTC_hand_interaction 1
#define XR_HTC_hand_interaction_SPEC_VERSION 1
#endif
#ifndef XR_ML_ml2_controller_interaction
#define XR_ML_ml2_controller_interaction 1
#define XR_ML_ml2_controller_interaction_SPEC_VERSION 1
#endif
#ifndef XR_BD_controller_interaction
#define XR_BD_controller_interaction 1
#define XR_BD_controller_interaction_SPEC_VERSION 2
#endif
#ifndef XR_FB_touch_controller_pro
#define XR_FB_touch_controller_pro 1
#define XR_FB_touch_controller_pro_SPEC_VERSION 1
#endif
#ifndef XR_META_touch_controller_plus
#define XR_META_touch_controller_plus 1
#define XR_META_touch_controller_plus_SPEC_VERSION 1
#endif
#ifndef XR_FB_touch_controller_proximity
#define XR_FB_touch_controller_proximity 1
#define XR_FB_touch_controller_proximity_SPEC_VERSION 1
#endif
#ifndef XR_OPPO_controller_interaction
#define XR_OPPO_controller_interaction 1
#define XR_OPPO_controller_interaction_SPEC_VERSION 1
#endif
#ifndef XR_YVR_controller_interaction
#define XR_YVR_controller_interaction 1
#define XR_YVR_controller_interaction_SPEC_VERSION 1
#endif

// ---- XR_KHR_locate_spaces: the names of OpenXR 1.1 with a suffix
#ifndef XR_KHR_locate_spaces
#define XR_KHR_locate_spaces 1
#define XR_KHR_locate_spaces_SPEC_VERSION 1
typedef PFN_xrLocateSpaces PFN_xrLocateSpacesKHR;
#endif

// ---- XR_KHR_extended_struct_name_lengths
#ifndef XR_KHR_extended_struct_name_lengths
#define XR_KHR_extended_struct_name_lengths 1
#define XR_KHR_extended_struct_name_lengths_SPEC_VERSION 1
#define XR_MAX_STRUCTURE_NAME_SIZE_EXTENDED_KHR 256
typedef XrResult(XRAPI_PTR *PFN_xrStructureTypeToString2KHR)(XrInstance instance, XrStructureType value,
															 char buffer[XR_MAX_STRUCTURE_NAME_SIZE_EXTENDED_KHR]);
#endif

// ---- XR_EXT_user_presence
#ifndef XR_EXT_user_presence
#define XR_EXT_user_presence 1
#define XR_EXT_user_presence_SPEC_VERSION 1
constexpr XrStructureType XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT = XrStructureType(1000470000);
constexpr XrStructureType XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT = XrStructureType(1000470001);
typedef struct XrSystemUserPresencePropertiesEXT {
	XrStructureType type;
	void *XR_MAY_ALIAS next;
	XrBool32 supportsUserPresence;
} XrSystemUserPresencePropertiesEXT;
#define ARIFT_SUPPLIES_XR_EXT_user_presence 1
#endif

// ---- XR_EXT_active_action_set_priority
#ifndef XR_EXT_active_action_set_priority
#define XR_EXT_active_action_set_priority 1
#define XR_EXT_active_action_set_priority_SPEC_VERSION 1
constexpr XrStructureType XR_TYPE_ACTIVE_ACTION_SET_PRIORITIES_EXT = XrStructureType(1000373000);
typedef struct XrActiveActionSetPriorityEXT {
	XrActionSet actionSet;
	uint32_t priorityOverride;
} XrActiveActionSetPriorityEXT;
typedef struct XrActiveActionSetPrioritiesEXT {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	uint32_t actionSetPriorityCount;
	const XrActiveActionSetPriorityEXT *actionSetPriorities;
} XrActiveActionSetPrioritiesEXT;
#define ARIFT_SUPPLIES_XR_EXT_active_action_set_priority 1
#endif

// ---- XR_EXT_dpad_binding
#ifndef XR_EXT_dpad_binding
#define XR_EXT_dpad_binding 1
#define XR_EXT_dpad_binding_SPEC_VERSION 1
constexpr XrStructureType XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT = XrStructureType(1000078000);
typedef struct XrInteractionProfileDpadBindingEXT {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrPath binding;
	XrActionSet actionSet;
	float forceThreshold;
	float forceThresholdReleased;
	float centerRegion;
	float wedgeAngle;
	XrBool32 isSticky;
	const XrHapticBaseHeader *onHaptic;
	const XrHapticBaseHeader *offHaptic;
} XrInteractionProfileDpadBindingEXT;
#define ARIFT_SUPPLIES_XR_EXT_dpad_binding 1
#endif

// ---- XR_META_performance_metrics
#ifndef XR_META_performance_metrics
#define XR_META_performance_metrics 1
#define XR_META_performance_metrics_SPEC_VERSION 2
constexpr XrStructureType XR_TYPE_PERFORMANCE_METRICS_STATE_META = XrStructureType(1000232001);
constexpr XrStructureType XR_TYPE_PERFORMANCE_METRICS_COUNTER_META = XrStructureType(1000232002);
typedef enum XrPerformanceMetricsCounterUnitMETA {
	XR_PERFORMANCE_METRICS_COUNTER_UNIT_GENERIC_META = 0,
	XR_PERFORMANCE_METRICS_COUNTER_UNIT_PERCENTAGE_META = 1,
	XR_PERFORMANCE_METRICS_COUNTER_UNIT_MILLISECONDS_META = 2,
	XR_PERFORMANCE_METRICS_COUNTER_UNIT_BYTES_META = 3,
	XR_PERFORMANCE_METRICS_COUNTER_UNIT_HERTZ_META = 4,
	XR_PERFORMANCE_METRICS_COUNTER_UNIT_MAX_ENUM_META = 0x7FFFFFFF
} XrPerformanceMetricsCounterUnitMETA;
typedef XrFlags64 XrPerformanceMetricsCounterFlagsMETA;
constexpr XrPerformanceMetricsCounterFlagsMETA XR_PERFORMANCE_METRICS_COUNTER_ANY_VALUE_VALID_BIT_META = 1;
constexpr XrPerformanceMetricsCounterFlagsMETA XR_PERFORMANCE_METRICS_COUNTER_UINT_VALUE_VALID_BIT_META = 2;
constexpr XrPerformanceMetricsCounterFlagsMETA XR_PERFORMANCE_METRICS_COUNTER_FLOAT_VALUE_VALID_BIT_META = 4;
typedef struct XrPerformanceMetricsStateMETA {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrBool32 enabled;
} XrPerformanceMetricsStateMETA;
typedef struct XrPerformanceMetricsCounterMETA {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrPerformanceMetricsCounterFlagsMETA counterFlags;
	XrPerformanceMetricsCounterUnitMETA counterUnit;
	uint32_t uintValue;
	float floatValue;
} XrPerformanceMetricsCounterMETA;
typedef XrResult(XRAPI_PTR *PFN_xrEnumeratePerformanceMetricsCounterPathsMETA)(XrInstance instance, uint32_t counterPathCapacityInput,
																			   uint32_t *counterPathCountOutput, XrPath *counterPaths);
typedef XrResult(XRAPI_PTR *PFN_xrSetPerformanceMetricsStateMETA)(XrSession session, const XrPerformanceMetricsStateMETA *state);
typedef XrResult(XRAPI_PTR *PFN_xrGetPerformanceMetricsStateMETA)(XrSession session, XrPerformanceMetricsStateMETA *state);
typedef XrResult(XRAPI_PTR *PFN_xrQueryPerformanceMetricsCounterMETA)(XrSession session, XrPath counterPath,
																	  XrPerformanceMetricsCounterMETA *counter);
#define ARIFT_SUPPLIES_XR_META_performance_metrics 1
#endif

// ---- XR_META_headset_id
#ifndef XR_META_headset_id
#define XR_META_headset_id 1
#define XR_META_headset_id_SPEC_VERSION 2
constexpr XrStructureType XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META = XrStructureType(1000245000);
typedef struct XrSystemHeadsetIdPropertiesMETA {
	XrStructureType type;
	void *XR_MAY_ALIAS next;
	XrUuid id;
} XrSystemHeadsetIdPropertiesMETA;
#define ARIFT_SUPPLIES_XR_META_headset_id 1
#endif

// ---- XR_FB_composition_layer_settings
#ifndef XR_FB_composition_layer_settings
#define XR_FB_composition_layer_settings 1
#define XR_FB_composition_layer_settings_SPEC_VERSION 1
constexpr XrStructureType XR_TYPE_COMPOSITION_LAYER_SETTINGS_FB = XrStructureType(1000204000);
typedef XrFlags64 XrCompositionLayerSettingsFlagsFB;
typedef struct XrCompositionLayerSettingsFB {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrCompositionLayerSettingsFlagsFB layerFlags;
} XrCompositionLayerSettingsFB;
#define ARIFT_SUPPLIES_XR_FB_composition_layer_settings 1
#endif

// ---- XR_FB_composition_layer_depth_test
#ifndef XR_FB_composition_layer_depth_test
#define XR_FB_composition_layer_depth_test 1
#define XR_FB_composition_layer_depth_test_SPEC_VERSION 1
constexpr XrStructureType XR_TYPE_COMPOSITION_LAYER_DEPTH_TEST_FB = XrStructureType(1000212000);
typedef enum XrCompareOpFB {
	XR_COMPARE_OP_NEVER_FB = 0,
	XR_COMPARE_OP_LESS_FB = 1,
	XR_COMPARE_OP_EQUAL_FB = 2,
	XR_COMPARE_OP_LESS_OR_EQUAL_FB = 3,
	XR_COMPARE_OP_GREATER_FB = 4,
	XR_COMPARE_OP_NOT_EQUAL_FB = 5,
	XR_COMPARE_OP_GREATER_OR_EQUAL_FB = 6,
	XR_COMPARE_OP_ALWAYS_FB = 7,
	XR_COMPARE_OP_MAX_ENUM_FB = 0x7FFFFFFF
} XrCompareOpFB;
typedef struct XrCompositionLayerDepthTestFB {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrBool32 depthMask;
	XrCompareOpFB compareOp;
} XrCompositionLayerDepthTestFB;
#define ARIFT_SUPPLIES_XR_FB_composition_layer_depth_test 1
#endif

// ---- XR_FB_passthrough: what its revisions 2 and 3 brought
#if XR_FB_passthrough_SPEC_VERSION < 3
#undef XR_FB_passthrough_SPEC_VERSION
#define XR_FB_passthrough_SPEC_VERSION 3
constexpr XrStructureType XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES2_FB = XrStructureType(1000118006);
constexpr XrStructureType XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB = XrStructureType(1000118023);
typedef XrFlags64 XrPassthroughCapabilityFlagsFB;
constexpr XrPassthroughCapabilityFlagsFB XR_PASSTHROUGH_CAPABILITY_BIT_FB = 1;
constexpr XrPassthroughCapabilityFlagsFB XR_PASSTHROUGH_CAPABILITY_COLOR_BIT_FB = 2;
constexpr XrPassthroughFlagsFB XR_PASSTHROUGH_LAYER_DEPTH_BIT_FB = 2;
typedef struct XrSystemPassthroughProperties2FB {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrPassthroughCapabilityFlagsFB capabilities;
} XrSystemPassthroughProperties2FB;
typedef struct XrPassthroughBrightnessContrastSaturationFB {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	float brightness;
	float contrast;
	float saturation;
} XrPassthroughBrightnessContrastSaturationFB;
#define ARIFT_SUPPLIES_XR_FB_passthrough_3 1
#endif
