#include "tests/fuzz/entry_points/structures.h"
#include "tests/fuzz/entry_points/texts.h"
#include <cmath>

namespace arift::fuzz
{
namespace
{

using Make = void *(*)(Making &);

/// What may hang in a chain: first what the library looks for, in an order that the corpus knows (new ones belong at the end of these),
/// then all there is, so that it meets what it must pass over.
constexpr Make structures[] = {makeHeaded<XrSpaceVelocity>,
							   makeHeaded<XrSpaceVelocities>,
							   makeHeaded<XrCompositionLayerDepthInfoKHR>,
							   makeHeaded<XrCompositionLayerColorScaleBiasKHR>,
							   makeHeaded<XrCompositionLayerAlphaBlendFB>,
							   makeHeaded<XrCompositionLayerDepthTestFB>,
							   makeHeaded<XrCompositionLayerDepthTestVARJO>,
							   makeHeaded<XrCompositionLayerSettingsFB>,
							   makeHeaded<XrSystemHandTrackingPropertiesEXT>,
							   makeHeaded<XrSystemUserPresencePropertiesEXT>,
							   makeHeaded<XrSystemColorSpacePropertiesFB>,
							   makeHeaded<XrSystemPassthroughPropertiesFB>,
							   makeHeaded<XrSystemPassthroughProperties2FB>,
							   makeHeaded<XrSystemHeadsetIdPropertiesMETA>,
							   makeHeaded<XrSessionCreateInfoOverlayEXTX>,
							   makeHeaded<XrDebugUtilsMessengerCreateInfoEXT>,
							   makeHeaded<XrVulkanSwapchainFormatListCreateInfoKHR>,
							   makeHeaded<XrBindingModificationsKHR>,
							   makeHeaded<XrActiveActionSetPrioritiesEXT>,
							   makeHeaded<XrPassthroughColorMapMonoToRgbaFB>,
							   makeHeaded<XrPassthroughColorMapMonoToMonoFB>,
							   makeHeaded<XrPassthroughBrightnessContrastSaturationFB>,
							   makeHeaded<XrInteractionProfileDpadBindingEXT>,
							   makeHeaded<XrHandJointsMotionRangeInfoEXT>,
							   makeHeaded<XrHandJointVelocitiesEXT>,
#define ARIFT_MAKE(Struct, ...) makeHeaded<Struct>,
							   XR_LIST_STRUCTURE_TYPES_CORE(ARIFT_MAKE) ARIFT_NEWER_STRUCTURES(ARIFT_MAKE)
#undef ARIFT_MAKE
};
static_assert(std::size(structures) < 250, "one byte says which");

/// Of a type that nobody knows: only its head can be looked at.
void *makeUnknown(Making &making)
{
	constexpr std::array types{0, 999'999, 1'000'999'000, INT32_MAX - 1};
	auto &structure = *making.memory.make<XrBaseOutStructure>(1);
	structure.type = XrStructureType(types[making.choices.byte() % types.size()]);
	structure.next = static_cast<XrBaseOutStructure *>(chooseChain(making));
	making.memory.watch(&structure);
	return &structure;
}

void *makeAny(Making &making, uint8_t choice) { return choice < std::size(structures) ? structures[choice](making) : makeUnknown(making); }

/// `usual`: those that belong behind the header.
void *chooseAmong(Making &making, std::span<const Make> usual)
{
	const uint8_t choice = making.choices.byte();
	if (choice < usual.size()) return usual[choice](making);
	if (choice == 255) return nullptr;
	return makeAny(making, making.choices.byte());
}

} // namespace

void *chooseChain(Making &making)
{
	if (!making.mayGrow()) return nullptr;
	const uint8_t choice = making.choices.byte();
	return choice == 0 ? nullptr : makeAny(making, choice - 1);
}

template <> const XrCompositionLayerBaseHeader *chooseHeaded(Making &making)
{
	constexpr Make layers[] = {makeHeaded<XrCompositionLayerProjection>,   makeHeaded<XrCompositionLayerQuad>,
							   makeHeaded<XrCompositionLayerCylinderKHR>,  makeHeaded<XrCompositionLayerEquirectKHR>,
							   makeHeaded<XrCompositionLayerEquirect2KHR>, makeHeaded<XrCompositionLayerCubeKHR>,
							   makeHeaded<XrCompositionLayerPassthroughFB>};
	return static_cast<const XrCompositionLayerBaseHeader *>(chooseAmong(making, layers));
}

template <> const XrHapticBaseHeader *chooseHeaded(Making &making)
{
	constexpr Make haptics[] = {makeHeaded<XrHapticVibration>};
	return static_cast<const XrHapticBaseHeader *>(chooseAmong(making, haptics));
}

template <> const XrBindingModificationBaseHeaderKHR *chooseHeaded(Making &making)
{
	constexpr Make modifications[] = {makeHeaded<XrInteractionProfileDpadBindingEXT>, makeHeaded<XrInteractionProfileAnalogThresholdVALVE>};
	return static_cast<const XrBindingModificationBaseHeaderKHR *>(chooseAmong(making, modifications));
}

const char *chooseTextPointer(Making &making, std::string_view name)
{
	const bool isUsual = making.choices.byte() % 2 == 0;
	if (isUsual == (name == "layerName")) return nullptr; // of an API layer, where a text says which
	const std::string text = chooseText(making.choices, name, making.state.texts);
	char *copy = making.memory.make<char>(text.size() + 1);
	std::ranges::copy(text, copy);
	return copy;
}

void chooseTextField(Making &making, std::string_view name, std::span<char> field)
{
	std::string text = chooseText(making.choices, name, making.state.texts);
	if (text.starts_with("/aaa")) text.resize(field.size(), 'a'); // without an end
	text.resize(std::min(text.size(), field.size()));
	std::ranges::copy(text, field.begin());
}

XrQuaternionf chooseOrientation(Making &making)
{
	constexpr float half = 0.70710678f;
	constexpr std::array usual{XrQuaternionf{0, 0, 0, 1},     XrQuaternionf{0, half, 0, half}, XrQuaternionf{half, 0, 0, half},
							   XrQuaternionf{0, 0, 0, -1},    XrQuaternionf{0, 0, 0, 0},       XrQuaternionf{2, 0, 0, 0},
							   XrQuaternionf{0, 0, 0, 1.004f}};
	const uint8_t choice = making.choices.byte();
	if (choice < usual.size()) return usual[choice];
	XrQuaternionf orientation{chooseFloat(making, "x"), chooseFloat(making, "y"), chooseFloat(making, "z"), chooseFloat(making, "w")};
	const float length = std::hypot(std::hypot(orientation.x, orientation.y), std::hypot(orientation.z, orientation.w));
	if (choice < 200 && length > 0)
		for (float *part : {&orientation.x, &orientation.y, &orientation.z, &orientation.w}) *part /= length;
	return orientation;
}

uint32_t usualCount(std::string_view name)
{
	if (name == "views") return 2;
	if (name == "enabledExtensionNames") return uint32_t(openxr::extensionInfos.size());
	return name == "enabledApiLayerNames" ? 0 : 1;
}

XrBool32 XRAPI_CALL hearMessage(XrDebugUtilsMessageSeverityFlagsEXT, XrDebugUtilsMessageTypeFlagsEXT,
								const XrDebugUtilsMessengerCallbackDataEXT *data, void *)
{
	[[maybe_unused]] static volatile size_t length = 0;
	const auto read = [](const char *text) { length = text ? std::strlen(text) : 0; };
	require(data && data->type == XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT, "a message has its data");
	read(data->messageId);
	read(data->functionName);
	read(data->message);
	for (uint32_t i = 0; i < data->objectCount; ++i) read(data->objects[i].objectName);
	for (uint32_t i = 0; i < data->sessionLabelCount; ++i) read(data->sessionLabels[i].labelName);
	return XR_FALSE;
}

} // namespace arift::fuzz
