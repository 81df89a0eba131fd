#include "tests/fuzz/entry_points/call.h"

namespace arift::fuzz
{
namespace
{

constexpr uint8_t none = 255;

} // namespace

std::string_view Call::takeName()
{
	const size_t end = std::min(parameters.find(' '), parameters.size());
	const std::string_view name = parameters.substr(0, end);
	parameters.remove_prefix(std::min(end + 1, parameters.size()));
	return name;
}

uint32_t makeCapacity(Call &call)
{
	constexpr uint32_t enough = 64;
	const uint8_t choice = call.making.choices.byte();
	return call.capacity = choice == 0 ? enough : choice - 1u;
}

uint32_t *makeCount(Call &call)
{
	if (call.making.choices.byte() == none) return nullptr;
	return call.count = call.making.memory.make<uint32_t>(1);
}

XrSwapchainImageBaseHeader *makeImages(Call &call)
{
	if (call.making.choices.byte() == none) return nullptr;
	auto *images = call.making.memory.make<XrSwapchainImageVulkanKHR>(call.capacity);
	const uint8_t wrong = call.making.choices.byte();
	for (uint32_t i = 0; i < call.capacity; ++i) {
		images[i].type = wrong == i + 1u ? XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR : XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR;
		images[i].next = chooseChain(call.making);
		call.making.memory.watch(&images[i]);
	}
	return reinterpret_cast<XrSwapchainImageBaseHeader *>(images);
}

char *makeTextBuffer(Call &call, std::string_view name)
{
	static_assert(XR_MAX_RESULT_STRING_SIZE == 64 && XR_MAX_STRUCTURE_NAME_SIZE == 64 && XR_MAX_STRUCTURE_NAME_SIZE_EXTENDED_KHR == 256);
	if (call.making.choices.byte() == none) return nullptr;
	const size_t size = name == "buffer256" ? 256 : 64;
	char *buffer = call.making.memory.make<char>(size);
	call.afterwards.push_back([=](XrResult result) {
		if (result == XR_SUCCESS)
			require(::strnlen(buffer, size) > 0 && ::strnlen(buffer, size) < size, "a name is written and terminated");
	});
	return buffer;
}

XrEventDataBuffer *makeEvent(Call &call)
{
	if (call.making.choices.byte() == none) return nullptr;
	auto *event = call.making.memory.make<XrEventDataBuffer>(1);
	event->type = XR_TYPE_EVENT_DATA_BUFFER;
	call.afterwards.push_back([event](XrResult result) {
		const bool isEvent = event->type != XR_TYPE_EVENT_DATA_BUFFER && openxr::nameOf(event->type) && !event->next;
		require((result == XR_SUCCESS) == isEvent, "an event is what it says");
	});
	return event;
}

} // namespace arift::fuzz
