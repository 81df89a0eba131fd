// The one exported symbol: what the OpenXR loader asks a runtime for. Loader design document, "Loader/runtime negotiation".
#include "runtime/openxr/functions.h"
#include "runtime/openxr/instance.h"

extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const XrNegotiateLoaderInfo *loaderInfo, XrNegotiateRuntimeRequest *runtimeRequest)
{
	const auto isValid = [](const auto *structure, XrLoaderInterfaceStructs type) {
		return structure && structure->structType == type && structure->structVersion == 1 && structure->structSize == sizeof(*structure);
	};
	if (!isValid(loaderInfo, XR_LOADER_INTERFACE_STRUCT_LOADER_INFO) ||
		!isValid(runtimeRequest, XR_LOADER_INTERFACE_STRUCT_RUNTIME_REQUEST))
		return XR_ERROR_INITIALIZATION_FAILED;
	constexpr uint32_t interfaceVersion = XR_CURRENT_LOADER_RUNTIME_VERSION;
	const bool speaksInterface = loaderInfo->minInterfaceVersion <= interfaceVersion && loaderInfo->maxInterfaceVersion >= interfaceVersion;
	const bool speaksApi =
		loaderInfo->minApiVersion <= arift::openxr::newestApiVersion && loaderInfo->maxApiVersion >= XR_MAKE_VERSION(1, 0, 0);
	if (!speaksInterface || !speaksApi) return XR_ERROR_INITIALIZATION_FAILED;
	runtimeRequest->runtimeInterfaceVersion = interfaceVersion;
	runtimeRequest->runtimeApiVersion = arift::openxr::newestApiVersion;
	runtimeRequest->getInstanceProcAddr = arift::openxr::getInstanceProcAddr;
	return XR_SUCCESS;
}
