// XR_EXT_debug_utils: applications hear of their mistakes, by the names that they gave their objects and what they said they were doing.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

class DebugMessenger : public Object
{
public:
	DebugMessenger(Instance &instance, const XrDebugUtilsMessengerCreateInfoEXT &info);
	~DebugMessenger() override;
	void requireAlive() const override {}

private:
	Instance &instance_;
};

template <> struct HandleOf<DebugMessenger> {
	using type = XrDebugUtilsMessengerEXT;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_DEBUG_UTILS_MESSENGER_EXT;
};

void createDebugUtilsMessenger(Instance &instance, const XrDebugUtilsMessengerCreateInfoEXT &info, XrDebugUtilsMessengerEXT &messenger);
void destroyDebugUtilsMessenger(EvenIfLost<DebugMessenger> messenger);
void submitDebugUtilsMessage(Instance &instance, XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
							 const XrDebugUtilsMessengerCallbackDataEXT &data);
void setDebugUtilsObjectName(Instance &instance, const XrDebugUtilsObjectNameInfoEXT &info);
void sessionBeginDebugUtilsLabelRegion(Session &session, const XrDebugUtilsLabelEXT &label);
void sessionEndDebugUtilsLabelRegion(Session &session);
void sessionInsertDebugUtilsLabel(Session &session, const XrDebugUtilsLabelEXT &label);

} // namespace arift::openxr
