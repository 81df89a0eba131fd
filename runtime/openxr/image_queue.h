// Whose turn it is: the order in which a swapchain's images pass between application and runtime. OpenXR 1.1, "Swapchain Image
// Management". Knows no pixels, no clock and no lock; Swapchain adds memory and waiting.
#pragma once
#include "runtime/openxr/error.h"
#include <algorithm>
#include <deque>
#include <optional>
#include <vector>

namespace arift::openxr
{

class ImageQueue
{
public:
	/// `isStatic`: the one image is acquired once only.
	ImageQueue(uint32_t imageCount, bool isStatic) : isStatic_(isStatic), lastFrame_(imageCount, 0)
	{
		for (uint32_t image = 0; image < imageCount; ++image) idle_.push_back(image);
	}

	/// The image to acquire next: of the free ones the one released longest ago, or else of all of them.
	/// An image is free when the compositor holds no submission it was part of: those before frame `oldestHeld` are done with.
	uint32_t toAcquire(uint64_t oldestHeld) const
	{
		if (idle_.empty()) throw Error(XR_ERROR_CALL_ORDER_INVALID, "all {} images are acquired already", lastFrame_.size());
		if (isStatic_ && newest_) throw Error(XR_ERROR_CALL_ORDER_INVALID, "the image of a static swapchain is acquired only once");
		const auto found = std::ranges::find_if(idle_, [&](uint32_t image) { return isFree(image, oldestHeld); });
		return found != idle_.end() ? *found : idle_.front();
	}
	/// The image that toAcquire() chose becomes the application's.
	void acquire(uint32_t image)
	{
		if (std::erase(idle_, image) == 0)
			throw Error(XR_ERROR_CALL_ORDER_INVALID, "image {} was acquired by another thread meanwhile", image);
		acquired_.push_back(image);
	}

	/// The image that xrWaitSwapchainImage is about: the one acquired longest ago that was not waited for. Only one at once.
	uint32_t toWaitFor() const
	{
		if (waited_) throw Error(XR_ERROR_CALL_ORDER_INVALID, "image {} was waited for and is not released yet", acquired_.front());
		if (acquired_.empty()) throw Error(XR_ERROR_CALL_ORDER_INVALID, "no image is acquired");
		return acquired_.front();
	}
	void waited() { waited_ = true; }

	/// The image that release() would release.
	uint32_t toRelease() const
	{
		if (!waited_) throw Error(XR_ERROR_CALL_ORDER_INVALID, "no image has been waited for");
		return acquired_.front();
	}
	/// The image waited for becomes the runtime's again, and is the one to show.
	void release()
	{
		newest_ = toRelease();
		waited_ = false;
		acquired_.pop_front();
		idle_.push_back(*newest_);
	}

	/// The image released last.
	std::optional<uint32_t> newest() const { return newest_; }
	/// Notes that submission `frame` shows an image.
	void submitted(uint32_t image, uint64_t frame) { lastFrame_[image] = frame; }
	uint64_t lastFrame(uint32_t image) const { return lastFrame_[image]; }
	bool isFree(uint32_t image, uint64_t oldestHeld) const { return lastFrame_[image] == 0 || lastFrame_[image] < oldestHeld; }
	/// The application holds every image but those being shown.
	bool allAcquired() const { return idle_.empty(); }

private:
	bool isStatic_;
	std::deque<uint32_t> idle_;     ///< the runtime's, in order of release
	std::deque<uint32_t> acquired_; ///< the application's, in order of acquisition
	bool waited_ = false;           ///< acquired_.front() was waited for
	std::optional<uint32_t> newest_;
	std::vector<uint64_t> lastFrame_; ///< of each image: the newest submission it is part of
};

} // namespace arift::openxr
