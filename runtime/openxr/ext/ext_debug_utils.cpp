#include "runtime/openxr/ext/ext_debug_utils.h"

namespace arift::openxr
{
namespace
{

/// Messengers of all instances: an error may come up before it is known which instance it is about.
constexpr size_t mostMessengers = 64;
constinit std::array<std::atomic<const DebugMessenger *>, mostMessengers> messengers{};

void requireLabel(const XrDebugUtilsLabelEXT &label)
{
	if (!label.labelName) throw Error(XR_ERROR_VALIDATION_FAILURE, "labelName is null");
}

void broadcast(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
			   const XrDebugUtilsMessengerCallbackDataEXT &data)
{
	for (const auto &slot : messengers)
		if (const DebugMessenger *messenger = slot.load()) messenger->send(severity, types, data);
}

} // namespace

DebugMessenger::DebugMessenger(const XrDebugUtilsMessengerCreateInfoEXT &info) : info_(info)
{
	if (!info.userCallback) throw Error(XR_ERROR_VALIDATION_FAILURE, "userCallback is null");
	if (info.messageSeverities == 0 || info.messageTypes == 0)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "messageSeverities and messageTypes are {:#x} and {:#x}", info.messageSeverities,
					info.messageTypes);
	for (auto &slot : messengers)
		if (const DebugMessenger *expected = nullptr; slot.compare_exchange_strong(expected, this)) return;
	throw Error(XR_ERROR_LIMIT_REACHED, "{} debug messengers exist already", mostMessengers);
}

DebugMessenger::~DebugMessenger()
{
	for (auto &slot : messengers) {
		const DebugMessenger *expected = this;
		slot.compare_exchange_strong(expected, nullptr);
	}
}

void DebugMessenger::send(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
						  const XrDebugUtilsMessengerCallbackDataEXT &data) const
{
	if ((info_.messageSeverities & severity) && (info_.messageTypes & types)) info_.userCallback(severity, types, &data, info_.userData);
}

void sendToMessengers(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types, const char *id,
					  const char *function, const char *text) noexcept
{
	XrDebugUtilsMessengerCallbackDataEXT data{XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT};
	data.messageId = id;
	data.functionName = function;
	data.message = text;
	broadcast(severity, types, data);
}

void createDebugUtilsMessenger(Instance &instance, const XrDebugUtilsMessengerCreateInfoEXT &info, XrDebugUtilsMessengerEXT &messenger)
{
	messenger = handles.insert(std::make_unique<DebugMessenger>(info), &instance);
}

void destroyDebugUtilsMessenger(EvenIfLost<DebugMessenger> messenger) { handles.destroy(*messenger); }

void submitDebugUtilsMessage(Instance &, XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
							 const XrDebugUtilsMessengerCallbackDataEXT &data)
{
	broadcast(severity, types, data);
}

void setDebugUtilsObjectName(Instance &, const XrDebugUtilsObjectNameInfoEXT &info)
{
	if (info.objectHandle == 0) throw Error(XR_ERROR_HANDLE_INVALID, "objectHandle is XR_NULL_HANDLE");
}

void sessionBeginDebugUtilsLabelRegion(Session &, const XrDebugUtilsLabelEXT &label) { requireLabel(label); }
void sessionEndDebugUtilsLabelRegion(Session &) {}
void sessionInsertDebugUtilsLabel(Session &, const XrDebugUtilsLabelEXT &label) { requireLabel(label); }

} // namespace arift::openxr
