#include "runtime/openxr/ext/ext_debug_utils.h"

namespace arift::openxr
{
namespace
{

const char *nameIn(const XrDebugUtilsLabelEXT &label)
{
	if (!label.labelName) throw Error(XR_ERROR_VALIDATION_FAILURE, "labelName is null");
	return label.labelName;
}

} // namespace

DebugMessenger::DebugMessenger(Instance &instance, const XrDebugUtilsMessengerCreateInfoEXT &info) : instance_(instance)
{
	if (!info.userCallback) throw Error(XR_ERROR_VALIDATION_FAILURE, "userCallback is null");
	if (info.messageSeverities == 0 || info.messageTypes == 0)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "messageSeverities and messageTypes are {:#x} and {:#x}", info.messageSeverities,
					info.messageTypes);
	instance_.messengers.add(this, info);
}

DebugMessenger::~DebugMessenger() { instance_.messengers.remove(this); }

void createDebugUtilsMessenger(Instance &instance, const XrDebugUtilsMessengerCreateInfoEXT &info, XrDebugUtilsMessengerEXT &messenger)
{
	messenger = handles.insert(std::make_unique<DebugMessenger>(instance, info), &instance);
}

void destroyDebugUtilsMessenger(EvenIfLost<DebugMessenger> messenger) { handles.destroy(*messenger); }

void submitDebugUtilsMessage(Instance &instance, XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
							 const XrDebugUtilsMessengerCallbackDataEXT &data)
{
	instance.messengers.send(severity, types, data);
}

void setDebugUtilsObjectName(Instance &, const XrDebugUtilsObjectNameInfoEXT &info)
{
	Object *object = handles.find(info.objectHandle, info.objectType);
	if (!object) throw Error(XR_ERROR_HANDLE_INVALID, "{:#x} is no handle of XrObjectType {}", info.objectHandle, int(info.objectType));
	*object->debugName.lock() = info.objectName ? info.objectName : "";
}

void sessionBeginDebugUtilsLabelRegion(Session &session, const XrDebugUtilsLabelEXT &label) { session.labels.begin(nameIn(label)); }
void sessionEndDebugUtilsLabelRegion(Session &session) { session.labels.end(); }
void sessionInsertDebugUtilsLabel(Session &session, const XrDebugUtilsLabelEXT &label) { session.labels.insert(nameIn(label)); }

} // namespace arift::openxr
