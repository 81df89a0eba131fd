// XrSwapchain: images that the service allocated and both sides see. OpenXR 1.1, "Swapchain Image Management".
#pragma once
#include "runtime/openxr/image_queue.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{

/// The images as the service knows them. It is told when they are done with.
class AllocatedImages
{
public:
	/// Throws what xrCreateSwapchain returns.
	AllocatedImages(Session &session, const gpu::ImageSpec &spec, bool isStatic);
	~AllocatedImages();
	AllocatedImages(const AllocatedImages &) = delete;

	uint32_t swapchain() const { return answer_.reply.swapchain; }
	uint32_t count() const { return answer_.reply.imageCount; }
	SharedMemory memory()
	{
		return {session_.sharing().how, std::span(answer_.fds).first(count()), answer_.reply.memorySize, answer_.reply.memoryTypeIndex};
	}

private:
	AllocatedImages(Session &session, ipc::Answer<ipc::SwapchainCreated> answer);

	Session &session_;
	ipc::Answer<ipc::SwapchainCreated> answer_;
};

class Swapchain : public Object
{
public:
	/// Throws what xrCreateSwapchain returns.
	Swapchain(Session &session, const XrSwapchainCreateInfo &info);
	void requireAlive() const override { session.requireAlive(); }

	uint32_t id() const { return allocated_.swapchain(); }
	const gpu::ImageSpec &spec() const { return spec_; }
	bool isCube() const { return gpu::isCube(spec_); }
	XrResult describe(OutputArray<XrSwapchainImageBaseHeader> images) const;

	uint32_t acquire();
	/// False when the image is not free within `timeout`. What it waits for is remembered from call to call: an application may poll.
	bool wait(XrDuration timeout);
	void release();

	/// The image released last, which is the one a layer shows, and which release of it that was, from 1.
	struct Released {
		uint32_t image = 0, release = 0;
	};
	std::optional<Released> newestImage();
	/// The application's work on a released image.
	std::shared_ptr<Completion> workOn(uint32_t image);
	void noteSubmitted(uint32_t image, uint64_t frame);

	Session &session;

private:
	struct Turns {
		ImageQueue queue;
		std::vector<std::shared_ptr<Completion>> work; ///< of each image: what its last release waits for
		std::vector<uint32_t> releases;                ///< of each image
		std::optional<XrTime> waitingSince;            ///< when the image that is next was first found to be held by the compositor
		uint64_t relinquished = 0;                     ///< the compositor has been asked to give up submissions up to this one
	};
	uint64_t oldestHeld() const;
	bool isFree(const ImageQueue &queue, uint32_t image) const { return queue.isFree(image, oldestHeld()); }
	/// The submission to ask the compositor to give up: the application has waited long enough, and who waits submits no other.
	std::optional<uint64_t> toRelinquish(Turns &turns, XrTime now) const;

	const gpu::ImageSpec spec_;
	AllocatedImages allocated_;
	std::unique_ptr<SwapchainImages> images_;
	Guarded<Turns> turns_;
};

template <> struct HandleOf<Swapchain> {
	using type = XrSwapchain;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_SWAPCHAIN;
};

XrResult enumerateSwapchainFormats(Session &session, OutputArray<int64_t> formats);
void createSwapchain(Session &session, const XrSwapchainCreateInfo &info, XrSwapchain &swapchain);
void destroySwapchain(EvenIfLost<Swapchain> swapchain);
XrResult enumerateSwapchainImages(Swapchain &swapchain, OutputArray<XrSwapchainImageBaseHeader> images);
void acquireSwapchainImage(Swapchain &swapchain, const XrSwapchainImageAcquireInfo *info, uint32_t &index);
XrResult waitSwapchainImage(Swapchain &swapchain, const XrSwapchainImageWaitInfo &info);
void releaseSwapchainImage(Swapchain &swapchain, const XrSwapchainImageReleaseInfo *info);

} // namespace arift::openxr
