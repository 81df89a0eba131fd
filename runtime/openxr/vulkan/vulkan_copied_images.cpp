#include "runtime/openxr/vulkan/vulkan_copied_images.h"
#include "runtime/base/guarded.h"
#include "runtime/openxr/vulkan/vulkan_images.h"
#include <cstring>

namespace arift::openxr
{
namespace
{

constexpr VkMemoryPropertyFlags readable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

VkDeviceMemory allocate(const VulkanDevice &device, const VkMemoryRequirements &needs, VkMemoryPropertyFlags wanted,
						VkMemoryPropertyFlags wished)
{
	auto type = device.memoryType(needs.memoryTypeBits, wanted | wished);
	if (!type) type = device.memoryType(needs.memoryTypeBits, wanted);
	if (!type)
		throw Error(XR_ERROR_RUNTIME_FAILURE, "the device has no memory of types {:#x} with flags {:#x}", needs.memoryTypeBits, wanted);
	const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, *type};
	VkDeviceMemory memory = VK_NULL_HANDLE;
	requireSuccess(device.vulkan.AllocateMemory(device.device, &info, nullptr, &memory), "vkAllocateMemory");
	return memory;
}

} // namespace

/// Lives until the last that reads it back has gone. What the service gets is copied once more, by the CPU: the memory that a GPU reads
/// back into is seldom memory that another process can have.
class VulkanCopiedImages::Image
{
public:
	Image(VulkanDevice &device, const gpu::ImageSpec &spec, UniqueFd &memfd, const SharedMemory &memory)
		: device_(device), size_(gpu::copyLayoutOf(spec).size)
	{
		if (memory.size != size_)
			throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service sent {} bytes for an image of {}", memory.size, size_);
		shared_ = ipc::mapWritable(memfd.get(), size_);
		try {
			makeImage(spec);
			makeBuffer();
		} catch (...) {
			release();
			throw;
		}
	}
	~Image() { release(); }
	Image(const Image &) = delete;

	VkImage image() const { return image_; }
	VkBuffer buffer() const { return buffer_; }
	size_t size() const { return size_; }
	/// The GPU has written the buffer.
	void give() const { std::memcpy(shared_.address(), mapped_, size_); }

private:
	void makeImage(const gpu::ImageSpec &spec)
	{
		const VulkanDeviceApi &vulkan = device_.vulkan;
		VkExternalMemoryImageCreateInfo external;
		VkImageCreateInfo info = gpu::imageCreateInfo(spec, external);
		info.pNext = nullptr;
		info.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
		requireSuccess(vulkan.CreateImage(device_.device, &info, nullptr, &image_), "vkCreateImage");
		VkMemoryRequirements needs{};
		vulkan.GetImageMemoryRequirements(device_.device, image_, &needs);
		imageMemory_ = allocate(device_, needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
		requireSuccess(vulkan.BindImageMemory(device_.device, image_, imageMemory_, 0), "vkBindImageMemory");
	}
	void makeBuffer()
	{
		const VulkanDeviceApi &vulkan = device_.vulkan;
		const VkBufferCreateInfo info{
			.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size_, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
		requireSuccess(vulkan.CreateBuffer(device_.device, &info, nullptr, &buffer_), "vkCreateBuffer");
		VkMemoryRequirements needs{};
		vulkan.GetBufferMemoryRequirements(device_.device, buffer_, &needs);
		bufferMemory_ = allocate(device_, needs, readable, VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
		requireSuccess(vulkan.BindBufferMemory(device_.device, buffer_, bufferMemory_, 0), "vkBindBufferMemory");
		requireSuccess(vulkan.MapMemory(device_.device, bufferMemory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "vkMapMemory");
	}
	void release() noexcept
	{
		const VulkanDeviceApi &vulkan = device_.vulkan;
		vulkan.DestroyImage(device_.device, image_, nullptr);
		vulkan.FreeMemory(device_.device, imageMemory_, nullptr);
		vulkan.DestroyBuffer(device_.device, buffer_, nullptr);
		vulkan.FreeMemory(device_.device, bufferMemory_, nullptr);
	}

	VulkanDevice &device_;
	const size_t size_;
	ipc::Mapping shared_;
	VkImage image_ = VK_NULL_HANDLE;
	VkBuffer buffer_ = VK_NULL_HANDLE;
	VkDeviceMemory imageMemory_ = VK_NULL_HANDLE, bufferMemory_ = VK_NULL_HANDLE;
	void *mapped_ = nullptr;
};

namespace
{

/// An image that is read back: done when the service can read it too.
template <typename Image> class ReadBack final : public Completion
{
public:
	ReadBack(std::shared_ptr<const Image> image, std::shared_ptr<Completion> work) : image_(std::move(image)), work_(std::move(work)) {}
	Outcome wait(XrDuration limit) const override
	{
		const Outcome outcome = work_->wait(limit);
		if (outcome != Outcome::done) return outcome;
		const auto given = given_.lock(); // several submissions may show one release
		if (!*given) image_->give();
		*given = true;
		return outcome;
	}

private:
	const std::shared_ptr<const Image> image_;
	const std::shared_ptr<Completion> work_;
	mutable Guarded<bool> given_{false};
};

} // namespace

VulkanCopiedImages::VulkanCopiedImages(VulkanDevice &device, const gpu::ImageSpec &spec, const SharedMemory &memory)
	: device_(device), entries_(memory.fds.size())
{
	const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = device_.queueFamily};
	requireSuccess(device_.vulkan.CreateCommandPool(device_.device, &info, nullptr, &pool_), "vkCreateCommandPool");
	try {
		for (size_t i = 0; i < entries_.size(); ++i) {
			entries_[i].image = std::make_shared<Image>(device_, spec, memory.fds[i], memory);
			record(entries_[i], spec);
			memory.fds[i] = UniqueFd(); // mapped by now
		}
	} catch (...) {
		device_.vulkan.DestroyCommandPool(device_.device, pool_, nullptr);
		throw;
	}
}

VulkanCopiedImages::~VulkanCopiedImages()
{
	for (const Entry &entry : entries_)
		if (entry.lastWork && entry.lastWork->wait(endLimit) == Completion::Outcome::notYet) {
			log::error("the application's GPU still works on a swapchain {} s after its last use; its images are left alone",
					   inSeconds(endLimit));
			for (Entry &abandoned : entries_) new std::shared_ptr(std::move(abandoned.image)); // never freed
			return;
		}
	device_.vulkan.DestroyCommandPool(device_.device, pool_, nullptr);
}

void VulkanCopiedImages::record(Entry &entry, const gpu::ImageSpec &spec) const
{
	const VulkanDeviceApi &vulkan = device_.vulkan;
	const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
										   .pNext = nullptr,
										   .commandPool = pool_,
										   .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
										   .commandBufferCount = 2};
	std::array<VkCommandBuffer, 2> commands{};
	requireSuccess(vulkan.AllocateCommandBuffers(device_.device, &info, commands.data()), "vkAllocateCommandBuffers");
	entry.enter = commands[0];
	entry.readBack = commands[1];
	beginCommands(vulkan, entry.enter);
	change(entry, entry.enter, spec, Step::enter);
	requireSuccess(vulkan.EndCommandBuffer(entry.enter), "vkEndCommandBuffer");

	beginCommands(vulkan, entry.readBack);
	change(entry, entry.readBack, spec, Step::beforeReading);
	const gpu::CopyLayout layout = gpu::copyLayoutOf(spec);
	std::vector<VkBufferImageCopy> regions;
	for (uint32_t layer = 0; layer < spec.arrayLayers; ++layer)
		regions.push_back({.bufferOffset = layer * layout.layerPitch,
						   .imageSubresource = {gpu::copiedAspectOf(VkFormat(spec.format)), 0, layer, 1},
						   .imageExtent = {spec.width, spec.height, 1}});
	vulkan.CmdCopyImageToBuffer(entry.readBack, entry.image->image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, entry.image->buffer(),
								uint32_t(regions.size()), regions.data());
	change(entry, entry.readBack, spec, Step::afterReading);
	requireSuccess(vulkan.EndCommandBuffer(entry.readBack), "vkEndCommandBuffer");
}

void VulkanCopiedImages::change(const Entry &entry, VkCommandBuffer commands, const gpu::ImageSpec &spec, Step step) const
{
	struct Side {
		VkImageLayout layout;
		VkPipelineStageFlags stages;
		VkAccessFlags imageAccess, bufferAccess;
	};
	const VkImageLayout boundary = gpu::boundaryLayout(VkFormat(spec.format));
	const Side nothing{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0, 0};
	const Side application{boundary, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, everyAccess, VK_ACCESS_HOST_READ_BIT};
	const Side reading{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
					   VK_ACCESS_TRANSFER_WRITE_BIT};
	const Side &from = step == Step::enter ? nothing : step == Step::beforeReading ? application : reading;
	const Side &to = step == Step::beforeReading ? reading : application;
	const VkImageMemoryBarrier image{
		.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
		.pNext = nullptr,
		.srcAccessMask = from.imageAccess,
		.dstAccessMask = to.imageAccess,
		.oldLayout = from.layout,
		.newLayout = to.layout,
		.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
		.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
		.image = entry.image->image(),
		.subresourceRange = {gpu::aspectOf(VkFormat(spec.format)), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
	const VkBufferMemoryBarrier buffer{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
									   .pNext = nullptr,
									   .srcAccessMask = from.bufferAccess,
									   .dstAccessMask = to.bufferAccess,
									   .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
									   .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
									   .buffer = entry.image->buffer(),
									   .offset = 0,
									   .size = VK_WHOLE_SIZE};
	device_.vulkan.CmdPipelineBarrier(commands, from.stages, to.stages, 0, 0, nullptr, 1, &buffer, 1, &image);
}

void VulkanCopiedImages::describe(std::span<XrSwapchainImageBaseHeader *const> elements) const
{
	std::vector<VkImage> images;
	for (const Entry &entry : entries_) images.push_back(entry.image->image());
	describeImages(elements, images);
}

void VulkanCopiedImages::takeOver(uint32_t index)
{
	Entry &entry = entries_[index];
	if (!std::exchange(entry.entered, true)) entry.lastWork = device_.submit(entry.enter);
}

std::shared_ptr<Completion> VulkanCopiedImages::handOver(uint32_t index)
{
	Entry &entry = entries_[index];
	entry.lastWork = device_.submit(entry.readBack);
	return std::make_shared<ReadBack<Image>>(entry.image, entry.lastWork);
}

} // namespace arift::openxr
