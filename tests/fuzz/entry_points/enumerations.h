// What enumerations have, the usual value first.
#pragma once
#include "runtime/openxr/api.h"
#include <array>
#include <span>

namespace arift::fuzz
{

/// Those without a list of their own here are numbers from 0.
template <typename Enum> inline constexpr std::span<const int32_t> valuesOf{};

#define ARIFT_VALUE(name, value) value,
#define ARIFT_VALUES(Enum)                                                                                                                 \
	inline constexpr int32_t listOf##Enum[] = {XR_LIST_ENUM_##Enum(ARIFT_VALUE)};                                                          \
	template <> inline constexpr std::span<const int32_t> valuesOf<Enum>{listOf##Enum};
ARIFT_VALUES(XrResult)
ARIFT_VALUES(XrStructureType)
ARIFT_VALUES(XrFormFactor)
ARIFT_VALUES(XrEnvironmentBlendMode)
ARIFT_VALUES(XrActionType)
ARIFT_VALUES(XrEyeVisibility)
ARIFT_VALUES(XrObjectType)
ARIFT_VALUES(XrVisibilityMaskTypeKHR)
ARIFT_VALUES(XrPerfSettingsDomainEXT)
ARIFT_VALUES(XrPerfSettingsLevelEXT)
ARIFT_VALUES(XrBlendFactorFB)
ARIFT_VALUES(XrHandEXT)
ARIFT_VALUES(XrHandJointSetEXT)
ARIFT_VALUES(XrColorSpaceFB)
ARIFT_VALUES(XrPassthroughLayerPurposeFB)
#undef ARIFT_VALUES
#undef ARIFT_VALUE

inline constexpr std::array listOfViewConfigurations{
	int32_t(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO), int32_t(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO), 0,
	int32_t(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO), int32_t(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO_WITH_FOVEATED_INSET)};
template <> inline constexpr std::span<const int32_t> valuesOf<XrViewConfigurationType>{listOfViewConfigurations};

inline constexpr std::array listOfReferenceSpaces{int32_t(XR_REFERENCE_SPACE_TYPE_LOCAL), int32_t(XR_REFERENCE_SPACE_TYPE_VIEW),
												  int32_t(XR_REFERENCE_SPACE_TYPE_STAGE), int32_t(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR),
												  int32_t(XR_REFERENCE_SPACE_TYPE_UNBOUNDED_MSFT)};
template <> inline constexpr std::span<const int32_t> valuesOf<XrReferenceSpaceType>{listOfReferenceSpaces};

} // namespace arift::fuzz
