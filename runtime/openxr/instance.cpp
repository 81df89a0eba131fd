#include "runtime/openxr/instance.h"
#include "runtime/openxr/ext/ext_debug_utils.h"
#include "runtime/openxr/session.h"
#include <unistd.h>

namespace arift::openxr
{
namespace
{

ipc::Hello helloOf(const InstanceOptions &options)
{
	ipc::Hello hello;
	ipc::copyText(hello.build, __DATE__ " " __TIME__);
	hello.role = ipc::Role::application;
	hello.pid = uint32_t(::getpid());
	hello.apiVersion = options.apiVersion;
	ipc::copyText(hello.applicationName, options.applicationName);
	ipc::copyText(hello.engineName, options.engineName);
	return hello;
}

/// A name that the structure guarantees to be terminated, but who knows.
template <size_t size> std::string textIn(const char (&field)[size], const char *what)
{
	if (::strnlen(field, size) == size) throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is not terminated within {} bytes", what, size);
	return field;
}

void requireVersion(XrVersion version)
{
	if (XR_VERSION_MAJOR(version) != 1 || XR_VERSION_MINOR(version) > XR_VERSION_MINOR(newestApiVersion))
		throw Error(XR_ERROR_API_VERSION_UNSUPPORTED, "the application asks for OpenXR {}.{}.{}; this runtime has 1.0 and 1.1",
					XR_VERSION_MAJOR(version), XR_VERSION_MINOR(version), XR_VERSION_PATCH(version));
}

ExtensionSet enabledExtensions(uint32_t count, const char *const *names)
{
	ExtensionSet extensions;
	if (count > 0 && !names) throw Error(XR_ERROR_VALIDATION_FAILURE, "enabledExtensionNames is null");
	for (uint32_t i = 0; i < count; ++i) {
		if (!names[i]) throw Error(XR_ERROR_VALIDATION_FAILURE, "enabledExtensionNames[{}] is null", i);
		const auto extension = extensionNamed(names[i]);
		if (!extension) throw Error(XR_ERROR_EXTENSION_NOT_PRESENT, "{} is not an extension of this runtime", names[i]);
		extensions.enable(*extension);
	}
	return extensions;
}

std::string nameForPeople(XrStructureType type)
{
	const char *name = nameOf(type);
	return name ? name : fmt::format("XR_UNKNOWN_STRUCTURE_TYPE_{}", int(type));
}

/// A text in the fixed buffers of xrResultToString and xrStructureTypeToString.
template <size_t size> void writeText(char *buffer, const std::string &text)
{
	if (!buffer) throw Error(XR_ERROR_VALIDATION_FAILURE, "the buffer is null");
	const size_t length = std::min(text.size(), size - 1);
	std::memcpy(buffer, text.data(), length);
	buffer[length] = '\0';
}

} // namespace

Instance::Instance(InstanceOptions wanted) : options(std::move(wanted)), service(helloOf(options)) {}

void Instance::requireSystem(XrSystemId system) const
{
	if (system != theSystem || !hasSystem) throw Error(XR_ERROR_SYSTEM_INVALID, "{} is no system that xrGetSystem returned", system);
}

bool Instance::takeEvent(XrEventDataBuffer &event)
{
	const std::shared_ptr<SessionLife> session = *session_.lock();
	const bool lost = service.isLost();
	if (session && lost) session->lose();
	if (session && session->takeEvent(event)) return true;
	if (!lost || lossTold_.exchange(true)) return false;
	const XrEventDataInstanceLossPending loss{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr, realTime()};
	std::memcpy(static_cast<void *>(&event), &loss, sizeof(loss));
	return true;
}

XrResult enumerateApiLayers(OutputArray<XrApiLayerProperties> layers) { return layers.assign({}); }

XrResult enumerateInstanceExtensions(const char *layerName, OutputArray<XrExtensionProperties> extensions)
{
	if (layerName) throw Error(XR_ERROR_API_LAYER_NOT_PRESENT, "this runtime contains no API layer \"{}\"", layerName);
	return extensions.fill(uint32_t(extensionInfos.size()), [](uint32_t i, XrExtensionProperties &properties) {
		ipc::copyText(properties.extensionName, extensionInfos[i].name);
		properties.extensionVersion = extensionInfos[i].specVersion;
	});
}

void createInstance(const XrInstanceCreateInfo &info, XrInstance &instance)
{
	log::setDefault(log::Level::warning);
	requireVersion(info.applicationInfo.apiVersion);
	if (info.createFlags != 0) throw Error(XR_ERROR_VALIDATION_FAILURE, "createFlags is {:#x}, not 0", info.createFlags);
	if (info.enabledApiLayerCount > 0 && !info.enabledApiLayerNames)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "enabledApiLayerNames is null");
	InstanceOptions options;
	options.apiVersion = info.applicationInfo.apiVersion;
	options.extensions = enabledExtensions(info.enabledExtensionCount, info.enabledExtensionNames);
	options.applicationName = textIn(info.applicationInfo.applicationName, "applicationName");
	options.engineName = textIn(info.applicationInfo.engineName, "engineName");
	if (options.applicationName.empty()) throw Error(XR_ERROR_NAME_INVALID, "applicationName is empty");
	const bool debugging = options.extensions.has(Extension::EXT_debug_utils);
	auto made = std::make_unique<Instance>(std::move(options));
	Instance &object = *made;
	instance = handles.insert(std::move(made), nullptr);
	if (const auto *messenger = findInChain<XrDebugUtilsMessengerCreateInfoEXT>(info.next); messenger && debugging) {
		XrDebugUtilsMessengerEXT lives = XR_NULL_HANDLE; // as long as the instance
		try {
			createDebugUtilsMessenger(object, *messenger, lives);
		} catch (...) {
			handles.destroy(object);
			throw;
		}
	}
}

void destroyInstance(EvenIfLost<Instance> instance)
{
	instance->isEnding = true;
	if (instance->service.isOfAnotherProcess())
		handles.forget(*instance);
	else
		handles.destroy(*instance);
}

void getInstanceProperties(EvenIfLost<Instance>, XrInstanceProperties &properties)
{
	properties.runtimeVersion = runtimeVersion;
	ipc::copyText(properties.runtimeName, "ARift");
}

XrResult pollEvent(EvenIfLost<Instance> instance, XrEventDataBuffer *event)
{
	if (!event) throw Error(XR_ERROR_VALIDATION_FAILURE, "the event buffer is null");
	if (instance->takeEvent(*event)) return XR_SUCCESS;
	if (instance->lossTold()) instance->requireAlive(); // a loss after that look is told by the next one
	return XR_EVENT_UNAVAILABLE;
}

void resultToString(EvenIfLost<Instance>, XrResult result, char *buffer)
{
	const char *name = nameOf(result);
	writeText<XR_MAX_RESULT_STRING_SIZE>(
		buffer, name ? name : fmt::format("XR_UNKNOWN_{}_{}", XR_SUCCEEDED(result) ? "SUCCESS" : "FAILURE", int(result)));
}

void structureTypeToString(EvenIfLost<Instance>, XrStructureType type, char *buffer)
{
	writeText<XR_MAX_STRUCTURE_NAME_SIZE>(buffer, nameForPeople(type));
}

void structureTypeToString2(EvenIfLost<Instance>, XrStructureType type, char *buffer)
{
	writeText<XR_MAX_STRUCTURE_NAME_SIZE_EXTENDED_KHR>(buffer, nameForPeople(type));
}

void stringToPath(Instance &instance, const char *text, XrPath &path)
{
	if (!text) throw Error(XR_ERROR_VALIDATION_FAILURE, "the path's text is null");
	path = instance.paths.atom(text);
}

XrResult pathToString(Instance &instance, XrPath path, OutputArray<char> buffer) { return assignText(buffer, instance.paths.text(path)); }

} // namespace arift::openxr
