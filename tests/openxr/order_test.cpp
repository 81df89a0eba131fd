// The order of frame calls and of a swapchain's images, as tables without clock, lock or GPU.
#include "runtime/openxr/frame_order.h"
#include "runtime/openxr/image_queue.h"
#include <gtest/gtest.h>

namespace arift::openxr
{
namespace
{

template <typename Call> XrResult resultOf(Call call)
{
	try {
		call();
		return XR_SUCCESS;
	} catch (const Error &error) {
		return error.result;
	}
}

void waitOnce(FrameOrder &order)
{
	order.startWait();
	order.finishWait(true);
}

TEST(FrameOrder, OneFrame)
{
	FrameOrder order;
	EXPECT_TRUE(order.mayWait());
	EXPECT_EQ(resultOf([&] { order.begin(); }), XR_ERROR_CALL_ORDER_INVALID);
	order.startWait();
	EXPECT_FALSE(order.mayWait()) << "a second xrWaitFrame may not run beside the first";
	order.finishWait(true);
	EXPECT_FALSE(order.mayWait()) << "not before the frame is begun";
	EXPECT_EQ(resultOf([&] { order.requireBegun(); }), XR_ERROR_CALL_ORDER_INVALID);
	EXPECT_FALSE(order.begin());
	EXPECT_TRUE(order.mayWait()) << "independent of xrEndFrame";
	order.requireBegun();
	order.end();
	EXPECT_EQ(resultOf([&] { order.requireBegun(); }), XR_ERROR_CALL_ORDER_INVALID);
}

TEST(FrameOrder, BeginningTwiceDiscardsTheFirst)
{
	FrameOrder order;
	waitOnce(order);
	EXPECT_FALSE(order.begin());
	EXPECT_EQ(resultOf([&] { order.begin(); }), XR_ERROR_CALL_ORDER_INVALID) << "begun again without a wait between";
	waitOnce(order);
	EXPECT_TRUE(order.begin());
	order.end();
}

TEST(FrameOrder, AFailedWaitCanBeRepeated)
{
	FrameOrder order;
	order.startWait();
	order.finishWait(false);
	EXPECT_TRUE(order.mayWait());
	EXPECT_EQ(resultOf([&] { order.begin(); }), XR_ERROR_CALL_ORDER_INVALID);
}

uint32_t acquire(ImageQueue &queue, uint64_t oldestHeld)
{
	const uint32_t image = queue.toAcquire(oldestHeld);
	queue.acquire(image);
	return image;
}

/// Draws one image of `queue` and shows it in submission `frame`.
uint32_t draw(ImageQueue &queue, uint64_t frame, uint64_t oldestHeld)
{
	const uint32_t image = acquire(queue, oldestHeld);
	EXPECT_EQ(queue.toWaitFor(), image);
	EXPECT_TRUE(queue.isFree(image, oldestHeld));
	queue.waited();
	queue.release();
	queue.submitted(image, frame);
	return image;
}

TEST(ImageQueue, ThreeImagesInTurnWhileOneIsShown)
{
	ImageQueue queue(3, false);
	for (uint64_t frame = 1; frame <= 9; ++frame) EXPECT_EQ(draw(queue, frame, frame > 2 ? frame - 1 : 1), (frame - 1) % 3);
}

TEST(ImageQueue, PrefersAFreeImageToTheOneReleasedLongestAgo)
{
	ImageQueue queue(3, false);
	draw(queue, 5, 0);
	draw(queue, 2, 0); // shown earlier than the first: a swapchain may be left out of some frames
	draw(queue, 6, 0);
	EXPECT_EQ(acquire(queue, 3), 1u) << "images 0 and 2 are held, 1 is free";
	EXPECT_EQ(acquire(queue, 3), 0u) << "none is free: the one released longest ago";
	EXPECT_FALSE(queue.isFree(0, 3));
	EXPECT_FALSE(queue.allAcquired());
	EXPECT_EQ(acquire(queue, 3), 2u);
	EXPECT_TRUE(queue.allAcquired());
	EXPECT_EQ(resultOf([&] { acquire(queue, 3); }), XR_ERROR_CALL_ORDER_INVALID);
}

TEST(ImageQueue, ChoosingAnImageChangesNothing)
{
	ImageQueue queue(2, false);
	EXPECT_EQ(queue.toAcquire(0), 0u);
	EXPECT_EQ(queue.toAcquire(0), 0u);
	EXPECT_EQ(resultOf([&] { queue.toWaitFor(); }), XR_ERROR_CALL_ORDER_INVALID);
	queue.acquire(0);
	EXPECT_EQ(resultOf([&] { queue.acquire(0); }), XR_ERROR_CALL_ORDER_INVALID) << "two threads chose the same";
	EXPECT_EQ(queue.toAcquire(0), 1u);
}

TEST(ImageQueue, CallOrder)
{
	ImageQueue queue(3, false);
	EXPECT_EQ(resultOf([&] { queue.toWaitFor(); }), XR_ERROR_CALL_ORDER_INVALID);
	EXPECT_EQ(resultOf([&] { queue.toRelease(); }), XR_ERROR_CALL_ORDER_INVALID);
	EXPECT_FALSE(queue.newest());
	acquire(queue, 0);
	acquire(queue, 0);
	EXPECT_EQ(resultOf([&] { queue.toRelease(); }), XR_ERROR_CALL_ORDER_INVALID) << "acquired but not waited for";
	EXPECT_EQ(queue.toWaitFor(), 0u);
	queue.waited();
	EXPECT_EQ(resultOf([&] { queue.toWaitFor(); }), XR_ERROR_CALL_ORDER_INVALID) << "the first must be released first";
	queue.release();
	EXPECT_EQ(queue.newest(), 0u);
	EXPECT_EQ(queue.toWaitFor(), 1u);
}

TEST(ImageQueue, AStaticImageIsAcquiredOnce)
{
	ImageQueue queue(1, true);
	draw(queue, 1, 0);
	EXPECT_EQ(resultOf([&] { acquire(queue, 100); }), XR_ERROR_CALL_ORDER_INVALID);
	EXPECT_EQ(queue.newest(), 0u);
}

TEST(ImageQueue, AnImageIsFreeWhenEverySubmissionOfItIsDoneWith)
{
	ImageQueue queue(2, false);
	EXPECT_TRUE(queue.isFree(0, 0)) << "never shown";
	draw(queue, 7, 0);
	EXPECT_FALSE(queue.isFree(0, 7));
	EXPECT_TRUE(queue.isFree(0, 8));
	queue.submitted(0, 9); // shown again without being drawn again
	EXPECT_FALSE(queue.isFree(0, 8));
}

} // namespace
} // namespace arift::openxr
