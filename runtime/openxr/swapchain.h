// XrSwapchain: images that the service allocated and both sides see. OpenXR 1.1, "Swapchain Image Management".
#pragma once
#include "runtime/openxr/image_queue.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{

class Swapchain : public Object
{
public:
	/// Throws what xrCreateSwapchain returns.
	Swapchain(Session &session, const XrSwapchainCreateInfo &info);
	~Swapchain() override;
	void requireAlive() const override { session.requireAlive(); }

	uint32_t id() const { return shared_.reply.swapchain; }
	const gpu::ImageSpec &spec() const { return spec_; }
	bool isCube() const { return spec_.createFlags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT; }
	XrResult describe(OutputArray<XrSwapchainImageBaseHeader> images) const;

	uint32_t acquire();
	/// False when the image is not free within `timeout`.
	bool wait(XrDuration timeout);
	void release();

	/// The image released last, which is the one a layer shows.
	std::optional<uint32_t> newestImage();
	/// The application's work on a released image.
	std::shared_ptr<Completion> workOn(uint32_t image);
	void noteSubmitted(uint32_t image, uint64_t frame);

	Session &session;

private:
	struct Turns {
		ImageQueue queue;
		std::vector<std::shared_ptr<Completion>> work; ///< of each image: what its last release waits for
	};
	uint64_t oldestHeld() const;

	const gpu::ImageSpec spec_;
	ipc::Answer<ipc::SwapchainCreated> shared_;
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
