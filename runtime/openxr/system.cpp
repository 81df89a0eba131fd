// The one system: a head-mounted display with two views. Everything about it was told by the service when this process connected.
#include "runtime/openxr/ext/ext_hand_tracking.h"
#include "runtime/openxr/ext/ext_user_presence.h"
#include "runtime/openxr/ext/fb_color_space.h"
#include "runtime/openxr/ext/fb_passthrough.h"
#include "runtime/openxr/ext/meta_headset_id.h"
#include "runtime/openxr/instance.h"

namespace arift::openxr
{
namespace
{

/// Fills the structure that an extension adds to XrSystemProperties, where it is enabled and asked for.
template <typename Properties>
void describe(const Instance &instance, Extension extension, void *next, void (*fill)(Properties &properties))
{
	if (!instance.has(extension)) return;
	if (auto *properties = findInChain<Properties>(next)) fill(*properties);
}

} // namespace

void requireStereo(XrViewConfigurationType type)
{
	if (type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
		throw Error(XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED, "view configuration {} is not PRIMARY_STEREO", int(type));
}

void getSystem(Instance &instance, const XrSystemGetInfo &info, XrSystemId &system)
{
	if (info.formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY)
		throw Error(XR_ERROR_FORM_FACTOR_UNSUPPORTED, "form factor {} is not HEAD_MOUNTED_DISPLAY", int(info.formFactor));
	if (const ipc::HeadsetState headset = instance.service.headset(); headset.isMissing)
		throw Error(XR_ERROR_FORM_FACTOR_UNAVAILABLE, "{}", ipc::textOf(headset.problem));
	instance.hasSystem = true;
	system = theSystem;
}

void getSystemProperties(Instance &instance, XrSystemId system, XrSystemProperties &properties)
{
	instance.requireSystem(system);
	const ipc::Welcome &welcome = instance.service.welcome();
	properties.systemId = system;
	properties.vendorId = 0x2833; // Oculus VR's USB vendor id
	ipc::copyText(properties.systemName, ipc::textOf(welcome.systemName));
	properties.graphicsProperties = {welcome.maxHeight, welcome.maxWidth, welcome.maxLayers};
	properties.trackingProperties = {welcome.orientationTracking != 0, welcome.positionTracking != 0};
	describe(instance, Extension::EXT_hand_tracking, properties.next, describeHandTracking);
	describe(instance, Extension::EXT_user_presence, properties.next, describeUserPresence);
	describe(instance, Extension::FB_color_space, properties.next, describeColorSpace);
	describe(instance, Extension::FB_passthrough, properties.next, describePassthrough);
	describe(instance, Extension::FB_passthrough, properties.next, describePassthrough2);
	describe(instance, Extension::META_headset_id, properties.next, describeHeadsetId);
}

XrResult enumerateEnvironmentBlendModes(Instance &instance, XrSystemId system, XrViewConfigurationType type,
										OutputArray<XrEnvironmentBlendMode> modes)
{
	instance.requireSystem(system);
	requireStereo(type);
	const ipc::Welcome &welcome = instance.service.welcome();
	return modes.fill(welcome.blendModeCount,
					  [&](uint32_t i, XrEnvironmentBlendMode &mode) { mode = XrEnvironmentBlendMode(welcome.blendModes[i]); });
}

XrResult enumerateViewConfigurations(Instance &instance, XrSystemId system, OutputArray<XrViewConfigurationType> types)
{
	instance.requireSystem(system);
	return types.assign(std::array{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO});
}

void getViewConfigurationProperties(Instance &instance, XrSystemId system, XrViewConfigurationType type,
									XrViewConfigurationProperties &properties)
{
	instance.requireSystem(system);
	requireStereo(type);
	properties.viewConfigurationType = type;
	properties.fovMutable = XR_TRUE; // whatever field of view a layer was drawn with, it is shown there
}

XrResult enumerateViewConfigurationViews(Instance &instance, XrSystemId system, XrViewConfigurationType type,
										 OutputArray<XrViewConfigurationView> views)
{
	instance.requireSystem(system);
	requireStereo(type);
	const ipc::Welcome &welcome = instance.service.welcome();
	return views.fill(2, [&](uint32_t, XrViewConfigurationView &view) {
		view.recommendedImageRectWidth = welcome.recommendedWidth;
		view.maxImageRectWidth = welcome.maxWidth;
		view.recommendedImageRectHeight = welcome.recommendedHeight;
		view.maxImageRectHeight = welcome.maxHeight;
		view.recommendedSwapchainSampleCount = 1;
		view.maxSwapchainSampleCount = 1;
	});
}

} // namespace arift::openxr
