#include "runtime/openxr/error.h"
#include "runtime/openxr/instance.h"
#include <atomic>
#include <new>

namespace arift::openxr
{
namespace
{

/// An application may fail every frame, for ever: the log says so a limited number of times.
void say(const char *function, uint64_t handle, XrResult result, const char *text)
{
	constexpr int most = 100;
	static std::atomic<int> said{0};
	const int before = said.load(std::memory_order_relaxed) > most ? most + 1 : said.fetch_add(1, std::memory_order_relaxed);
	if (before < most) log::warning("{}: {}: {}", function, nameOf(result), text);
	if (before == most) log::warning("{} calls have failed; further ones are not logged", most);
	XrDebugUtilsMessengerCallbackDataEXT data{XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT};
	data.messageId = nameOf(result);
	data.functionName = function;
	data.message = text;
	XrDebugUtilsObjectNameInfoEXT object{XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, handles.typeOf(handle), handle, nullptr};
	data.objectCount = object.objectType == XR_OBJECT_TYPE_UNKNOWN ? 0 : 1;
	data.objects = &object;
	if (Instance *instance = handles.rootOf<Instance>(handle))
		instance->messengers.send(XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
								  result == XR_ERROR_RUNTIME_FAILURE ? XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT
																	 : XR_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
								  data);
}

} // namespace

XrResult report(const char *function, uint64_t handle) noexcept
{
	try {
		throw;
	} catch (const Error &error) {
		say(function, handle, error.result, error.what());
		return error.result;
	} catch (const std::bad_alloc &) {
		return XR_ERROR_OUT_OF_MEMORY;
	} catch (const std::exception &error) {
		log::error("{}: {}", function, error.what());
		return XR_ERROR_RUNTIME_FAILURE;
	} catch (...) {
		return XR_ERROR_RUNTIME_FAILURE;
	}
}

} // namespace arift::openxr
