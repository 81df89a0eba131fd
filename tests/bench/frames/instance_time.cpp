#include "tests/bench/frames/instance_time.h"
#include <chrono>
#include <cstring>
#include <openxr/openxr.h>
#include <stdexcept>
#include <string>

double instanceMilliseconds()
{
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
	std::strcpy(info.applicationInfo.applicationName, "bench_frames");
	info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
	XrInstance instance = XR_NULL_HANDLE;
	const auto begin = std::chrono::steady_clock::now();
	const XrResult result = xrCreateInstance(&info, &instance);
	const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
	if (XR_FAILED(result)) throw std::runtime_error("xrCreateInstance failed with XrResult " + std::to_string(result));
	xrDestroyInstance(instance);
	return passed.count();
}
