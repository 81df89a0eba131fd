// What Debian 12's OpenXR 1.0.20 headers lack: OpenXR 1.1's core and the negotiation between loader and runtime. Names and values are the
// specification's. Every group gives way to the newer headers through the macro that they define.
#pragma once
#include <openxr/openxr.h>

#ifndef XR_API_VERSION_1_0
#define XR_API_VERSION_1_0 XR_MAKE_VERSION(1, 0, XR_VERSION_PATCH(XR_CURRENT_API_VERSION))
#endif

// ---- OpenXR 1.1, appendix "Core Versions": XR_VERSION_1_1
#ifndef XR_VERSION_1_1
#define XR_VERSION_1_1 1
#define XR_API_VERSION_1_1 XR_MAKE_VERSION(1, 1, 47)
#define XR_UUID_SIZE 16

constexpr XrResult XR_ERROR_PERMISSION_INSUFFICIENT = XrResult(-1000710000);
constexpr XrResult XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED = XrResult(-1000710001);
constexpr XrStructureType XR_TYPE_SPACES_LOCATE_INFO = XrStructureType(1000471000);
constexpr XrStructureType XR_TYPE_SPACE_LOCATIONS = XrStructureType(1000471001);
constexpr XrStructureType XR_TYPE_SPACE_VELOCITIES = XrStructureType(1000471002);
constexpr XrReferenceSpaceType XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR = XrReferenceSpaceType(1000426000);
constexpr XrViewConfigurationType XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO_WITH_FOVEATED_INSET = XrViewConfigurationType(1000037000);

typedef struct XrColor3f {
	float r, g, b;
} XrColor3f;
typedef struct XrExtent3Df {
	float width, height, depth;
} XrExtent3Df;
typedef struct XrSpheref {
	XrPosef center;
	float radius;
} XrSpheref;
typedef struct XrBoxf {
	XrPosef center;
	XrExtent3Df extents;
} XrBoxf;
typedef struct XrFrustumf {
	XrPosef pose;
	XrFovf fov;
	float nearZ, farZ;
} XrFrustumf;
typedef struct XrUuid {
	uint8_t data[XR_UUID_SIZE];
} XrUuid;

typedef struct XrSpacesLocateInfo {
	XrStructureType type;
	const void *XR_MAY_ALIAS next;
	XrSpace baseSpace;
	XrTime time;
	uint32_t spaceCount;
	const XrSpace *spaces;
} XrSpacesLocateInfo;
typedef struct XrSpaceLocationData {
	XrSpaceLocationFlags locationFlags;
	XrPosef pose;
} XrSpaceLocationData;
typedef struct XrSpaceLocations {
	XrStructureType type;
	void *XR_MAY_ALIAS next;
	uint32_t locationCount;
	XrSpaceLocationData *locations;
} XrSpaceLocations;
typedef struct XrSpaceVelocityData {
	XrSpaceVelocityFlags velocityFlags;
	XrVector3f linearVelocity;
	XrVector3f angularVelocity;
} XrSpaceVelocityData;
typedef struct XrSpaceVelocities {
	XrStructureType type;
	void *XR_MAY_ALIAS next;
	uint32_t velocityCount;
	XrSpaceVelocityData *velocities;
} XrSpaceVelocities;
typedef XrResult(XRAPI_PTR *PFN_xrLocateSpaces)(XrSession session, const XrSpacesLocateInfo *locateInfo, XrSpaceLocations *spaceLocations);
#define ARIFT_SUPPLIES_XR_VERSION_1_1 1
#endif

// ---- Loader design document, "Loader/runtime negotiation"; openxr_loader_negotiation.h
#ifndef XR_LOADER_VERSION_1_0
#define XR_LOADER_VERSION_1_0 1
#define XR_CURRENT_LOADER_RUNTIME_VERSION 1
#define XR_LOADER_INFO_STRUCT_VERSION 1
#define XR_RUNTIME_INFO_STRUCT_VERSION 1

typedef enum XrLoaderInterfaceStructs {
	XR_LOADER_INTERFACE_STRUCT_UNINTIALIZED = 0,
	XR_LOADER_INTERFACE_STRUCT_LOADER_INFO = 1,
	XR_LOADER_INTERFACE_STRUCT_API_LAYER_REQUEST = 2,
	XR_LOADER_INTERFACE_STRUCT_RUNTIME_REQUEST = 3,
	XR_LOADER_INTERFACE_STRUCT_API_LAYER_CREATE_INFO = 4,
	XR_LOADER_INTERFACE_STRUCT_API_LAYER_NEXT_INFO = 5,
	XR_LOADER_INTERFACE_STRUCTS_MAX_ENUM = 0x7FFFFFFF
} XrLoaderInterfaceStructs;

typedef struct XrNegotiateLoaderInfo {
	XrLoaderInterfaceStructs structType;
	uint32_t structVersion;
	size_t structSize;
	uint32_t minInterfaceVersion;
	uint32_t maxInterfaceVersion;
	XrVersion minApiVersion;
	XrVersion maxApiVersion;
} XrNegotiateLoaderInfo;
typedef struct XrNegotiateRuntimeRequest {
	XrLoaderInterfaceStructs structType;
	uint32_t structVersion;
	size_t structSize;
	uint32_t runtimeInterfaceVersion;
	XrVersion runtimeApiVersion;
	PFN_xrGetInstanceProcAddr getInstanceProcAddr;
} XrNegotiateRuntimeRequest;
#endif
