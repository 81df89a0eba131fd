// An OpenXR application that does nothing but clear, with the number of its frame in the middle:
//    clearing_application CONTENT QUADS [KIND [SCALE]]
// CONTENT: transparent (transparent black), translucent or opaque. QUADS: quad layers more, 0.2 m wide, 1 m ahead; KIND: shown, hidden
// (behind the head) or empty (transparent black). SCALE: of the image's edges.
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include "tests/bench/frames/frame_code.h"
#include <cstdlib>
#include <string_view>

namespace
{

using namespace arift::bench;
using namespace arift::e2e;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

constexpr uint32_t eyes = 2, quadSize = 256;

struct Options {
	std::string_view content = "transparent";
	uint32_t quads = 0;
	std::string_view kind = "shown";
	double scale = 1;
};

/// Linear, premultiplied.
std::array<float, 4> colourOf(std::string_view content)
{
	if (content == "transparent") return {0, 0, 0, 0};
	if (content == "translucent") return {0.05f, 0.1f, 0.2f, 0.5f};
	if (content == "opaque") return {0.05f, 0.1f, 0.2f, 1};
	throw std::runtime_error("content must be transparent, translucent or opaque, not " + std::string(content));
}

/// Host memory with the picture of every frame's code, one after another: nothing is painted while frames are counted.
struct CodePictures {
	static constexpr vk::DeviceSize each = vk::DeviceSize(codeWidth) * codeHeight * 4;
	explicit CodePictures(const Vulkan &vulkan)
		: buffer(vulkan.device, {.size = each << codeBits, .usage = vk::BufferUsageFlagBits::eTransferSrc}), memory(allocate(vulkan))
	{
		buffer.bindMemory(*memory, 0);
		auto *texel = static_cast<uint32_t *>(memory.mapMemory(0, VK_WHOLE_SIZE));
		for (uint32_t number = 0; number < 1u << codeBits; ++number)
			for (uint32_t y = 0; y < codeHeight; ++y)
				for (uint32_t x = 0; x < codeWidth; ++x) *texel++ = codeCellIsWhite(x / codeCell, number) ? 0xFFFFFFFF : 0xFF000000;
		memory.unmapMemory();
	}
	vk::raii::Buffer buffer;
	vk::raii::DeviceMemory memory;

private:
	vk::raii::DeviceMemory allocate(const Vulkan &vulkan) const
	{
		const auto needs = buffer.getMemoryRequirements();
		const auto properties = vulkan.physicalDevice.getMemoryProperties();
		constexpr auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
		for (uint32_t type = 0; type < properties.memoryTypeCount; ++type)
			if (needs.memoryTypeBits >> type & 1 && (properties.memoryTypes[type].propertyFlags & wanted) == wanted)
				return {vulkan.device, {.allocationSize = needs.size, .memoryTypeIndex = type}};
		throw std::runtime_error("the device has no memory that the CPU can write");
	}
};

class ClearingApplication final : public DrawingApplication
{
public:
	explicit ClearingApplication(const Options &options)
		: DrawingApplication("clearing_application"),
		  options_(options),
		  space_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  head_(createSpace(XR_REFERENCE_SPACE_TYPE_VIEW)),
		  views_(session_, {uint32_t(1122 * options.scale), uint32_t(1553 * options.scale)}, eyes),
		  quadImages_(session_, {quadSize, quadSize}, 1),
		  colour_(colourOf(options.content)),
		  quadColour_(options.kind == "empty" ? std::array{0.0f, 0.0f, 0.0f, 0.0f} : std::array{0.3f, 0.1f, 0.05f, 0.7f}),
		  codes_(vulkan_),
		  pool_(vulkan_.device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = 4}),
		  fences_{vk::raii::Fence(vulkan_.device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled}),
				  vk::raii::Fence(vulkan_.device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled})}
	{
	}

private:
	void frame() override
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		const size_t slot = frame_ % 2;
		if (vulkan_.device.waitForFences(*fences_[slot], true, UINT64_MAX) != vk::Result::eSuccess)
			throw std::runtime_error("the application's own work does not end");
		vulkan_.device.resetFences(*fences_[slot]);
		const vk::raii::CommandBuffer &commands = commands_[slot];
		commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
		const VkImage image = views_[views_.acquire()];
		recordFill(commands, image, views_.format, colour_);
		recordCode(commands, image);
		if (options_.quads > 0) recordFill(commands, quadImages_[quadImages_.acquire()], quadImages_.format, quadColour_);
		commands.end();
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands}, *fences_[slot]);
		views_.release();
		if (options_.quads > 0) quadImages_.release();
		show(state.predictedDisplayTime);
		++frame_;
	}
	void recordCode(const vk::raii::CommandBuffer &commands, VkImage image) const
	{
		const auto change = [&](Layout from, Layout to) {
			commands.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands, {}, {}, {},
									 vk::ImageMemoryBarrier{.srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
															.dstAccessMask = vk::AccessFlagBits::eMemoryWrite,
															.oldLayout = from,
															.newLayout = to,
															.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
															.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
															.image = image,
															.subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor,
																				 .levelCount = 1,
																				 .layerCount = VK_REMAINING_ARRAY_LAYERS}});
		};
		change(Layout::eColorAttachmentOptimal, Layout::eTransferDstOptimal);
		const vk::BufferImageCopy strip{
			.bufferOffset = CodePictures::each * (frame_ % (1u << codeBits)),
			.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
			.imageOffset = {int32_t(views_.size.width - codeWidth) / 2, int32_t(views_.size.height - codeHeight) / 2, 0},
			.imageExtent = {codeWidth, codeHeight, 1}};
		commands.copyBufferToImage(*codes_.buffer, image, Layout::eTransferDstOptimal, strip);
		change(Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
	}

	void show(XrTime displayTime) const
	{
		std::array<XrView, 2> located;
		locate(displayTime, space_, located);
		const ProjectionLayer projection(space_, located, {views_.all(0), views_.all(1)});
		std::vector<XrCompositionLayerQuad> quads(options_.quads, {XR_TYPE_COMPOSITION_LAYER_QUAD});
		std::vector<const XrCompositionLayerBaseHeader *> layers{projection.header()};
		for (uint32_t i = 0; i < options_.quads; ++i) {
			quads[i].layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
			quads[i].space = head_;
			quads[i].subImage = quadImages_.all();
			const float z = options_.kind == "hidden" ? 1 : -1;
			quads[i].pose = {{0, 0, 0, 1}, {0.25f * float(i % 4) - 0.375f, 0.3f - 0.25f * float(i / 4 % 4), z}};
			quads[i].size = {0.2f, 0.2f};
			layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quads[i]));
		}
		endFrame(displayTime, layers);
	}

	const Options options_;
	const Space space_, head_;
	const DrawnImages views_, quadImages_;
	const std::array<float, 4> colour_, quadColour_;
	const CodePictures codes_;
	const vk::raii::CommandPool pool_;
	const vk::raii::CommandBuffers commands_;
	const std::array<vk::raii::Fence, 2> fences_;
	uint32_t frame_ = 0;
};

} // namespace

int main(int count, char **arguments)
{
	if (count < 3 || count > 5) {
		std::fprintf(stderr, "usage: clearing_application CONTENT QUADS [KIND [SCALE]]\n");
		return 2;
	}
	Options options{arguments[1], uint32_t(std::atol(arguments[2]))};
	if (count > 3) options.kind = arguments[3];
	if (count > 4) options.scale = std::atof(arguments[4]);
	constexpr int never = 0;
	return runApplication("clearing_application", [&] { ClearingApplication(options).run(never); });
}
