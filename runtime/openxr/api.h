// OpenXR with the platform structures this library knows, and what the installed headers lack.
#pragma once
#include "runtime/base/xr.h"
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>
#define XR_USE_GRAPHICS_API_VULKAN
#include "runtime/openxr/supplement.h"
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
