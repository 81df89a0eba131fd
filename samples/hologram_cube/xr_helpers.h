// Small things every OpenXR program needs: errors, handles that destroy themselves, extension functions, lists.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
#include <vulkan/vulkan.h>
#define XR_USE_GRAPHICS_API_VULKAN
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

/// Every OpenXR call answers with a result; negative ones are errors.
inline void check(XrResult result, const char *call)
{
	if (XR_SUCCEEDED(result)) return;
	const char *hint = result == XR_ERROR_RUNTIME_UNAVAILABLE       ? ": no OpenXR runtime is active (is XR_RUNTIME_JSON set?)"
					   : result == XR_ERROR_FORM_FACTOR_UNAVAILABLE ? ": the headset is not ready"
					   : result == XR_ERROR_EXTENSION_NOT_PRESENT   ? ": the runtime has no XR_KHR_vulkan_enable2"
					   : result == XR_ERROR_SESSION_LOST            ? ": the runtime has ended the session"
					   : result == XR_ERROR_INSTANCE_LOST           ? ": the runtime has gone"
																	: "";
	throw std::runtime_error(std::string(call) + " failed with XrResult " + std::to_string(result) + hint);
}

/// Owns one OpenXR handle. Members are destroyed in reverse order, children before parents, as OpenXR asks.
template <typename T, XrResult(XRAPI_PTR *destroy)(T)> struct Handle {
	T value = XR_NULL_HANDLE;
	Handle() = default;
	Handle(Handle &&other) noexcept : value(std::exchange(other.value, T(XR_NULL_HANDLE))) {}
	~Handle()
	{
		if (value != XR_NULL_HANDLE) destroy(value);
	}
	operator T() const { return value; }
};
using Instance = Handle<XrInstance, xrDestroyInstance>;
using Session = Handle<XrSession, xrDestroySession>;
using Space = Handle<XrSpace, xrDestroySpace>;
using Swapchain = Handle<XrSwapchain, xrDestroySwapchain>;

template <typename Function> Function load(XrInstance instance, const char *name)
{
	PFN_xrVoidFunction function = nullptr;
	check(xrGetInstanceProcAddr(instance, name, &function), name);
	return reinterpret_cast<Function>(function);
}

/// The two-call idiom: ask how many, then ask for them.
template <typename T, typename Call> std::vector<T> enumerate(const char *name, const T &empty, Call call)
{
	uint32_t count = 0;
	check(call(0, &count, nullptr), name);
	std::vector<T> values(count, empty);
	check(call(count, &count, values.data()), name);
	values.resize(count);
	return values;
}
