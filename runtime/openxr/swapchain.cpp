#include "runtime/openxr/swapchain.h"
#include "runtime/openxr/ext/khr_swapchain_usage_input_attachment_bit.h"
#include "runtime/openxr/ext/khr_vulkan_swapchain_format_list.h"
#include <algorithm>
#include <bit>

namespace arift::openxr
{
namespace
{

/// One being shown, one on its way, one being drawn.
constexpr uint32_t usualImages = 3;
/// How often a wait looks whether the compositor has let go: no wake-up crosses the process boundary.
constexpr XrDuration lookAgain = 200 * microsecond;
/// How long, in refreshes, an image that is being shown is waited for where the application has released others: one of its threads may be
/// about to show one of those.
constexpr int64_t patience = 10;

void requireCreateInfo(const XrSwapchainCreateInfo &info, const ipc::Welcome &welcome)
{
	constexpr XrSwapchainCreateFlags knownFlags = XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT | XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT;
	if (info.createFlags & ~knownFlags) throw Error(XR_ERROR_VALIDATION_FAILURE, "createFlags {:#x} has unknown bits", info.createFlags);
	if (info.width == 0 || info.height == 0 || info.arraySize == 0 || info.mipCount == 0 || info.sampleCount == 0)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "an image of {}x{}, {} layers, {} levels and {} samples is none", info.width, info.height,
					info.arraySize, info.mipCount, info.sampleCount);
	if (info.faceCount != 1 && info.faceCount != 6) throw Error(XR_ERROR_VALIDATION_FAILURE, "faceCount is {}, not 1 or 6", info.faceCount);
	if (info.createFlags & XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "protected content is not supported");
	if (info.width > welcome.maxWidth || info.height > welcome.maxHeight)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "{}x{} is larger than {}x{}", info.width, info.height, welcome.maxWidth,
					welcome.maxHeight);
	if (info.sampleCount > 1)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "{} samples are more than maxSwapchainSampleCount", info.sampleCount);
	if (info.mipCount > uint32_t(std::bit_width(std::max(info.width, info.height))))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} mip levels are more than {}x{} has", info.mipCount, info.width, info.height);
	if (uint64_t(info.arraySize) * info.faceCount > ipc::maxArrayLayers)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "{} layers of {} faces are more than {}", info.arraySize, info.faceCount,
					uint32_t(ipc::maxArrayLayers));
	if (info.faceCount == 6 && info.width != info.height)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a cube's faces are square, not {}x{}", info.width, info.height);
}

gpu::ImageSpec specFor(const Session &session, const XrSwapchainCreateInfo &info)
{
	requireCreateInfo(info, session.instance.service.welcome());
	requireInputAttachmentUsage(session.instance, info.usageFlags);
	requireFormatList(session.instance, info);
	if (!session.graphics()) throw Error(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "a headless session has no swapchains");
	const ImageSharing &sharing = session.sharing();
	if (std::ranges::find(sharing.formats, info.format) == sharing.formats.end())
		throw Error(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "format {} is not one of xrEnumerateSwapchainFormats", info.format);
	return session.graphics()->specOf(info, sharing.how);
}

} // namespace

AllocatedImages::AllocatedImages(Session &session, ipc::Answer<ipc::SwapchainCreated> answer)
	: session_(session), answer_(std::move(answer))
{
}

AllocatedImages::AllocatedImages(Session &session, const gpu::ImageSpec &spec, bool isStatic)
	: AllocatedImages(
		  session, session.instance.service.ask<ipc::SwapchainCreated>(ipc::CreateSwapchain{
					   .session = session.id(), .imageCount = isStatic ? 1 : usualImages, .sharing = session.sharing().how, .spec = spec}))
{
	const uint32_t wanted = isStatic ? 1 : usualImages;
	if (count() < wanted || count() > ipc::maxImages || answer_.fdCount != count())
		throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service allocated {} images and sent {} of them instead of {}", count(),
					answer_.fdCount, wanted);
}

AllocatedImages::~AllocatedImages()
{
	// No submission that names the images may come after the message that destroys them.
	session_.drainSubmissions();
	try {
		Service &service = session_.instance.service;
		if (!service.isLost()) service.ask<ipc::Done>(ipc::DestroySwapchain{.swapchain = swapchain()});
	} catch (const std::exception &problem) {
		log::warning("xrDestroySwapchain: {}", problem.what());
	}
}

Swapchain::Swapchain(Session &owner, const XrSwapchainCreateInfo &info)
	: session(owner),
	  spec_(specFor(session, info)),
	  allocated_(session, spec_, info.createFlags & XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT),
	  images_(session.graphics()->import(spec_, allocated_.memory())),
	  turns_(Turns{ImageQueue(allocated_.count(), info.createFlags & XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT),
				   std::vector<std::shared_ptr<Completion>>(allocated_.count()), std::vector<uint32_t>(allocated_.count()), std::nullopt,
				   0})
{
}

XrResult Swapchain::describe(OutputArray<XrSwapchainImageBaseHeader> images) const
{
	const uint32_t count = allocated_.count();
	*images.count = count;
	if (images.capacity == 0) return XR_SUCCESS;
	if (images.capacity < count) return XR_ERROR_SIZE_INSUFFICIENT;
	if (!images.elements) throw Error(XR_ERROR_VALIDATION_FAILURE, "images is null but its capacity is {}", images.capacity);
	std::vector<XrSwapchainImageBaseHeader *> elements(count);
	for (uint32_t i = 0; i < count; ++i)
		elements[i] =
			reinterpret_cast<XrSwapchainImageBaseHeader *>(reinterpret_cast<std::byte *>(images.elements) + i * images_->elementSize());
	images_->describe(elements);
	return XR_SUCCESS;
}

uint64_t Swapchain::oldestHeld() const { return session.instance.service.client().oldestHeldFrame.load(std::memory_order_acquire); }

uint32_t Swapchain::acquire()
{
	uint32_t image = 0;
	bool isReleased = false;
	{
		const auto turns = turns_.lock();
		image = turns->queue.toAcquire(oldestHeld());
		isReleased = isFree(turns->queue, image);
	}
	// An image the compositor may still read stays its own: the application gets it after a wait, and without its contents, so that
	// Vulkan asks for no transfer ("Queue Family Ownership Transfer": a transfer may be left out when contents need not survive).
	if (isReleased) images_->takeOver(image);
	turns_.lock()->queue.acquire(image);
	return image;
}

bool Swapchain::wait(XrDuration timeout)
{
	const XrTime begin = realTime();
	const XrTime end = timeout > XR_INFINITE_DURATION - begin ? XR_INFINITE_DURATION : begin + std::max<XrDuration>(timeout, 0);
	for (;;) {
		std::optional<uint64_t> unwanted;
		{
			auto turns = turns_.lock();
			const uint32_t image = turns->queue.toWaitFor();
			if (isFree(turns->queue, image)) {
				turns->queue.waited();
				turns->waitingSince.reset();
				return true;
			}
			unwanted = toRelinquish(*turns, realTime());
		}
		if (unwanted) session.relinquish(*unwanted);
		const XrTime now = realTime();
		if (now >= end) return false;
		session.instance.service.noticeHangUp(std::min(lookAgain, end - now));
		session.requireAlive();
	}
}

std::optional<uint64_t> Swapchain::toRelinquish(Turns &turns, XrTime now) const
{
	if (!turns.waitingSince) turns.waitingSince = now;
	const XrDuration refresh = std::clamp<XrDuration>(session.instance.service.timing().displayPeriod, millisecond, 100 * millisecond);
	const XrDuration enough = turns.queue.allAcquired() ? refresh : patience * refresh;
	const uint64_t frame = turns.queue.lastFrame(turns.queue.toWaitFor());
	if (now - *turns.waitingSince < enough || frame <= turns.relinquished) return std::nullopt;
	turns.relinquished = frame;
	return frame;
}

void Swapchain::release()
{
	const uint32_t image = turns_.lock()->queue.toRelease();
	std::shared_ptr<Completion> work = images_->handOver(image);
	const auto turns = turns_.lock();
	turns->work[image].swap(work);
	turns->queue.release();
	turns->releases[image] = std::max(turns->releases[image] + 1, 1u); // 0 says nothing
}

std::optional<Swapchain::Released> Swapchain::newestImage()
{
	const auto turns = turns_.lock();
	const auto newest = turns->queue.newest();
	return newest ? std::optional(Released{*newest, turns->releases[*newest]}) : std::nullopt;
}

std::shared_ptr<Completion> Swapchain::workOn(uint32_t image) { return turns_.lock()->work[image]; }

void Swapchain::noteSubmitted(uint32_t image, uint64_t frame) { turns_.lock()->queue.submitted(image, frame); }

XrResult enumerateSwapchainFormats(Session &session, OutputArray<int64_t> formats)
{
	if (!session.graphics()) return formats.assign({});
	return formats.assign(session.sharing().formats);
}

void createSwapchain(Session &session, const XrSwapchainCreateInfo &info, XrSwapchain &swapchain)
{
	swapchain = handles.insert(std::make_unique<Swapchain>(session, info), &session);
}

void destroySwapchain(EvenIfLost<Swapchain> swapchain)
{
	if (swapchain->session.instance.service.isOfAnotherProcess())
		handles.forget(*swapchain);
	else
		handles.destroy(*swapchain);
}

XrResult enumerateSwapchainImages(Swapchain &swapchain, OutputArray<XrSwapchainImageBaseHeader> images)
{
	return swapchain.describe(images);
}

void acquireSwapchainImage(Swapchain &swapchain, const XrSwapchainImageAcquireInfo *, uint32_t &index) { index = swapchain.acquire(); }

XrResult waitSwapchainImage(Swapchain &swapchain, const XrSwapchainImageWaitInfo &info)
{
	return swapchain.wait(info.timeout) ? XR_SUCCESS : XR_TIMEOUT_EXPIRED;
}

void releaseSwapchainImage(Swapchain &swapchain, const XrSwapchainImageReleaseInfo *) { swapchain.release(); }

} // namespace arift::openxr
