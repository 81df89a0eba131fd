// The members of OpenXR's structures, one after another. What the installed headers have, their reflection header tells; what
// runtime/openxr/supplement*.h supplies is told here, and gives way to newer headers by the same macros.
#pragma once
#include "runtime/openxr/api.h"

#ifdef ARIFT_SUPPLIES_XR_VERSION_1_1
#define XR_LIST_STRUCT_XrUuid(_) _(data)
#define XR_LIST_STRUCT_XrSpacesLocateInfo(_) _(type) _(next) _(baseSpace) _(time) _(spaceCount) _(spaces)
#define XR_LIST_STRUCT_XrSpaceLocationData(_) _(locationFlags) _(pose)
#define XR_LIST_STRUCT_XrSpaceLocations(_) _(type) _(next) _(locationCount) _(locations)
#define XR_LIST_STRUCT_XrSpaceVelocityData(_) _(velocityFlags) _(linearVelocity) _(angularVelocity)
#define XR_LIST_STRUCT_XrSpaceVelocities(_) _(type) _(next) _(velocityCount) _(velocities)
#endif
#ifdef ARIFT_SUPPLIES_XR_EXT_user_presence
#define XR_LIST_STRUCT_XrSystemUserPresencePropertiesEXT(_) _(type) _(next) _(supportsUserPresence)
#endif
#ifdef ARIFT_SUPPLIES_XR_EXT_active_action_set_priority
#define XR_LIST_STRUCT_XrActiveActionSetPriorityEXT(_) _(actionSet) _(priorityOverride)
#define XR_LIST_STRUCT_XrActiveActionSetPrioritiesEXT(_) _(type) _(next) _(actionSetPriorityCount) _(actionSetPriorities)
#endif
#ifdef ARIFT_SUPPLIES_XR_EXT_dpad_binding
#define XR_LIST_STRUCT_XrInteractionProfileDpadBindingEXT(_)                                                                               \
	_(type)                                                                                                                                \
	_(next)                                                                                                                                \
	_(binding) _(actionSet) _(forceThreshold) _(forceThresholdReleased) _(centerRegion) _(wedgeAngle) _(isSticky) _(onHaptic) _(offHaptic)
#endif
#ifdef ARIFT_SUPPLIES_XR_META_performance_metrics
#define XR_LIST_STRUCT_XrPerformanceMetricsStateMETA(_) _(type) _(next) _(enabled)
#define XR_LIST_STRUCT_XrPerformanceMetricsCounterMETA(_) _(type) _(next) _(counterFlags) _(counterUnit) _(uintValue) _(floatValue)
#endif
#ifdef ARIFT_SUPPLIES_XR_META_headset_id
#define XR_LIST_STRUCT_XrSystemHeadsetIdPropertiesMETA(_) _(type) _(next) _(id)
#endif
#ifdef ARIFT_SUPPLIES_XR_FB_composition_layer_settings
#define XR_LIST_STRUCT_XrCompositionLayerSettingsFB(_) _(type) _(next) _(layerFlags)
#endif
#ifdef ARIFT_SUPPLIES_XR_FB_composition_layer_depth_test
#define XR_LIST_STRUCT_XrCompositionLayerDepthTestFB(_) _(type) _(next) _(depthMask) _(compareOp)
#endif
#ifdef ARIFT_SUPPLIES_XR_FB_passthrough_3
#define XR_LIST_STRUCT_XrSystemPassthroughProperties2FB(_) _(type) _(next) _(capabilities)
#define XR_LIST_STRUCT_XrPassthroughBrightnessContrastSaturationFB(_) _(type) _(next) _(brightness) _(contrast) _(saturation)
#endif

/// Newer than the installed headers, with `type` and `next`.
#define ARIFT_NEWER_STRUCTURES(X)                                                                                                          \
	X(XrSpacesLocateInfo)                                                                                                                  \
	X(XrSpaceLocations)                                                                                                                    \
	X(XrSpaceVelocities)                                                                                                                   \
	X(XrSystemUserPresencePropertiesEXT)                                                                                                   \
	X(XrActiveActionSetPrioritiesEXT)                                                                                                      \
	X(XrInteractionProfileDpadBindingEXT)                                                                                                  \
	X(XrPerformanceMetricsStateMETA)                                                                                                       \
	X(XrPerformanceMetricsCounterMETA)                                                                                                     \
	X(XrSystemHeadsetIdPropertiesMETA)                                                                                                     \
	X(XrCompositionLayerSettingsFB)                                                                                                        \
	X(XrCompositionLayerDepthTestFB)                                                                                                       \
	X(XrSystemPassthroughProperties2FB)                                                                                                    \
	X(XrPassthroughBrightnessContrastSaturationFB)

/// Parts of others.
#define ARIFT_PLAIN_STRUCTURES(X)                                                                                                          \
	X(XrApplicationInfo)                                                                                                                   \
	X(XrSystemGraphicsProperties)                                                                                                          \
	X(XrSystemTrackingProperties)                                                                                                          \
	X(XrVector2f)                                                                                                                          \
	X(XrVector3f)                                                                                                                          \
	X(XrVector4f)                                                                                                                          \
	X(XrVector4sFB)                                                                                                                        \
	X(XrQuaternionf)                                                                                                                       \
	X(XrPosef)                                                                                                                             \
	X(XrOffset2Df)                                                                                                                         \
	X(XrExtent2Df)                                                                                                                         \
	X(XrRect2Df)                                                                                                                           \
	X(XrOffset2Di)                                                                                                                         \
	X(XrExtent2Di)                                                                                                                         \
	X(XrRect2Di)                                                                                                                           \
	X(XrFovf)                                                                                                                              \
	X(XrColor4f)                                                                                                                           \
	X(XrSwapchainSubImage)                                                                                                                 \
	X(XrActionSuggestedBinding)                                                                                                            \
	X(XrActiveActionSet)                                                                                                                   \
	X(XrHandJointLocationEXT)                                                                                                              \
	X(XrHandJointVelocityEXT)                                                                                                              \
	X(XrHandMeshIndexBufferMSFT)                                                                                                           \
	X(XrHandMeshVertexMSFT)                                                                                                                \
	X(XrHandMeshVertexBufferMSFT)                                                                                                          \
	X(XrUuidMSFT)                                                                                                                          \
	X(XrSceneSphereBoundMSFT)                                                                                                              \
	X(XrSceneOrientedBoxBoundMSFT)                                                                                                         \
	X(XrSceneFrustumBoundMSFT)                                                                                                             \
	X(XrSceneBoundsMSFT)                                                                                                                   \
	X(XrSceneComponentMSFT)                                                                                                                \
	X(XrSceneComponentLocationMSFT)                                                                                                        \
	X(XrSceneObjectMSFT)                                                                                                                   \
	X(XrScenePlaneMSFT)                                                                                                                    \
	X(XrSceneMeshMSFT)                                                                                                                     \
	X(XrDeserializeSceneFragmentMSFT)                                                                                                      \
	X(XrHandCapsuleFB)                                                                                                                     \
	X(XrSpatialAnchorPersistenceNameMSFT)                                                                                                  \
	X(XrUuid)                                                                                                                              \
	X(XrSpaceLocationData)                                                                                                                 \
	X(XrSpaceVelocityData)                                                                                                                 \
	X(XrActiveActionSetPriorityEXT)

namespace arift::fuzz
{

/// Members<XrPosef>::visit(pose, f) calls f("orientation", pose.orientation), f("position", pose.position).
template <typename T> struct Members;
#define ARIFT_MEMBER(member) f(#member, structure.member);
#define ARIFT_MEMBERS(Struct, ...)                                                                                                         \
	template <> struct Members<Struct> {                                                                                                   \
		template <typename F> static void visit(Struct &structure, F f) { XR_LIST_STRUCT_##Struct(ARIFT_MEMBER) }                          \
	};
XR_LIST_STRUCTURE_TYPES_CORE(ARIFT_MEMBERS)
ARIFT_NEWER_STRUCTURES(ARIFT_MEMBERS)
ARIFT_PLAIN_STRUCTURES(ARIFT_MEMBERS)
// Of the structures of graphics APIs those without an object of theirs.
ARIFT_MEMBERS(XrVulkanSwapchainFormatListCreateInfoKHR)
ARIFT_MEMBERS(XrGraphicsRequirementsVulkanKHR)
ARIFT_MEMBERS(XrGraphicsRequirementsOpenGLKHR)
ARIFT_MEMBERS(XrGraphicsRequirementsOpenGLESKHR)
#undef ARIFT_MEMBERS
#undef ARIFT_MEMBER

} // namespace arift::fuzz
