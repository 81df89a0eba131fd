// XrInstance: the connection to the service and everything that belongs to one application. OpenXR 1.1, chapters "Instance" and "System".
#pragma once
#include "runtime/openxr/bindings.h"
#include "runtime/openxr/debug_messengers.h"
#include "runtime/openxr/entry_point.h"
#include "runtime/openxr/extensions.h"
#include "runtime/openxr/paths.h"
#include "runtime/openxr/service.h"
#include <string>

namespace arift::openxr
{

class SessionLife;

/// The newest version this library implements; it accepts every 1.0 and 1.1.
constexpr XrVersion newestApiVersion = XR_API_VERSION_1_1;
/// The runtime's own version.
constexpr XrVersion runtimeVersion = XR_MAKE_VERSION(0, 1, 0);

/// What the application asked xrCreateInstance for.
struct InstanceOptions {
	XrVersion apiVersion = XR_API_VERSION_1_0;
	ExtensionSet extensions;
	std::string applicationName;
	std::string engineName;
};

class Instance : public Object
{
public:
	explicit Instance(InstanceOptions options);
	void requireAlive() const override { service.requireAlive(); }

	bool is1_1() const { return options.apiVersion >= XR_MAKE_VERSION(1, 1, 0); }
	bool has(Extension extension) const { return options.extensions.has(extension); }
	Features features() const { return {is1_1(), options.extensions}; }
	bool hasLocalFloor() const { return is1_1() || has(Extension::EXT_local_floor); }
	/// Throws XR_ERROR_SYSTEM_INVALID for what xrGetSystem did not return.
	void requireSystem(XrSystemId system) const;

	/// Takes the oldest event for the application, if there is one; news from the service becomes events here.
	bool takeEvent(XrEventDataBuffer &event);
	/// Whether the last event of all, that the service is lost, was taken.
	bool lossTold() const { return lossTold_; }
	/// The one session's, or null; set by the session itself.
	void setSession(std::shared_ptr<SessionLife> life) { *session_.lock() = std::move(life); }

	const InstanceOptions options;
	Service service;
	PathTable paths;
	Guarded<Names> actionSetNames;
	Guarded<Suggestions> suggestions;
	DebugMessengers messengers;
	/// What the application told about its graphics API before it made a session.
	std::atomic<bool> vulkanRequirementsKnown{false}, openGlRequirementsKnown{false}, openGlEsRequirementsKnown{false};
	/// In xrDestroyInstance: GL contexts may not be used any more.
	std::atomic<bool> isEnding{false};
	std::atomic<PFN_vkGetInstanceProcAddr> vulkanLoader{nullptr};
	/// The VkInstance that xrCreateVulkanInstanceKHR made last, or that the application asked for its device.
	std::atomic<VkInstance> vulkanInstance{VK_NULL_HANDLE};
	std::atomic<bool> hasSystem{false};
	std::atomic<bool> hasSession{false};

private:
	Guarded<std::shared_ptr<SessionLife>> session_;
	std::atomic<bool> lossTold_{false};
};

template <> struct HandleOf<Instance> {
	using type = XrInstance;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_INSTANCE;
};

constexpr XrSystemId theSystem = 1;

// ---- entry points without an instance
XrResult enumerateApiLayers(OutputArray<XrApiLayerProperties> layers);
XrResult enumerateInstanceExtensions(const char *layerName, OutputArray<XrExtensionProperties> extensions);
void createInstance(const XrInstanceCreateInfo &info, XrInstance &instance);
// ---- with one
void destroyInstance(EvenIfLost<Instance> instance);
void getInstanceProperties(EvenIfLost<Instance> instance, XrInstanceProperties &properties);
/// `event` may still hold the event before: its type is not looked at.
XrResult pollEvent(EvenIfLost<Instance> instance, XrEventDataBuffer *event);
void resultToString(EvenIfLost<Instance> instance, XrResult result, char *buffer);
void structureTypeToString(EvenIfLost<Instance> instance, XrStructureType type, char *buffer);
/// XR_KHR_extended_struct_name_lengths: the same for names of any length.
void structureTypeToString2(EvenIfLost<Instance> instance, XrStructureType type, char *buffer);
void stringToPath(Instance &instance, const char *text, XrPath &path);
XrResult pathToString(Instance &instance, XrPath path, OutputArray<char> buffer);

// ---- system.cpp
void getSystem(Instance &instance, const XrSystemGetInfo &info, XrSystemId &system);
void getSystemProperties(Instance &instance, XrSystemId system, XrSystemProperties &properties);
XrResult enumerateEnvironmentBlendModes(Instance &instance, XrSystemId system, XrViewConfigurationType type,
										OutputArray<XrEnvironmentBlendMode> modes);
XrResult enumerateViewConfigurations(Instance &instance, XrSystemId system, OutputArray<XrViewConfigurationType> types);
void getViewConfigurationProperties(Instance &instance, XrSystemId system, XrViewConfigurationType type,
									XrViewConfigurationProperties &properties);
XrResult enumerateViewConfigurationViews(Instance &instance, XrSystemId system, XrViewConfigurationType type,
										 OutputArray<XrViewConfigurationView> views);
/// Throws XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED for all but PRIMARY_STEREO.
void requireStereo(XrViewConfigurationType type);

} // namespace arift::openxr
