// What goes wrong on the way of an image or a frame: nothing is lost on the way, nothing is waited for in vain.
#include "tests/openxr/fake_graphics.h"
#include <fstream>
#include <unistd.h>

namespace arift::openxr
{
namespace
{

constexpr XrDuration patience = 10 * second; // of a test with a machine that is busy

/// Ends what waits for the service, as a service that stops for good: a test that would hang fails instead.
class Rescue
{
public:
	explicit Rescue(FakeService &service)
		: thread_([&service, this](const std::stop_token &stop) {
			  if (over_.lock().waitFor(stop, std::chrono::nanoseconds(patience), [](bool over) { return over; })) return;
			  if (stop.stop_requested()) return;
			  ADD_FAILURE() << "a call waits for ever";
			  service.stopHeart();
			  service.system().heartbeat = 0;
		  })
	{
	}

private:
	Guarded<bool> over_{false};
	std::jthread thread_;
};

/// Until the session's loss is told.
bool lossIsTold(Instance &instance)
{
	XrEventDataBuffer event{};
	for (const XrTime end = realTime() + patience; realTime() < end; std::this_thread::yield())
		while (instance.takeEvent(event))
			if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED &&
				reinterpret_cast<const XrEventDataSessionStateChanged &>(event).state == XR_SESSION_STATE_LOSS_PENDING)
				return true;
	return false;
}

TEST_F(FakeSession, AServiceThatReadsNoFramesLosesTheSession)
{
	service.stopReadingFrames();
	Session &lost = session();
	const Rescue rescue(service);
	EXPECT_EQ(resultOf([&] { lost.waitFrame(); }), XR_ERROR_SESSION_LOST);
	EXPECT_EQ(resultOf([&] { lost.requireAlive(); }), XR_ERROR_SESSION_LOST);
	EXPECT_TRUE(lossIsTold(instance));
}

TEST(FrameThatNobodyTakes, EndsTheSubmitter)
{
	std::pair<ipc::Socket, ipc::Socket> ends = ipc::Socket::pair();
	while (ends.first.send(ipc::Relinquish{}, 0) == ipc::Transfer::done) {}
	Guarded<int> failures{0};
	Submitter submitter(ends.first, [&] { failures.update([](int &count) { ++count; }); });
	submitter.submit({}, {});
	EXPECT_TRUE(failures.lock().waitFor({}, std::chrono::nanoseconds(patience), [](int count) { return count == 1; }));
}

/// Whether a thread of this process sleeps in the kernel.
bool sleeps(pid_t thread)
{
	std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
	std::string text;
	std::getline(file, text);
	const size_t name = text.rfind(") ");
	return name != text.npos && text[name + 2] == 'S';
}

/// One waits in xrWaitFrame while the frame before is not begun. The channel shows the order: what was sent in between stands in between.
TEST_F(FakeSession, AWaitInAnotherThreadBlocksUntilTheFrameIsBegun)
{
	Session &running = session();
	running.waitFrame();
	std::atomic<pid_t> waiter{0};
	std::jthread thread([&] {
		waiter = ::gettid();
		running.waitFrame();
	});
	for (const XrTime end = realTime() + patience; !sleeps(waiter); std::this_thread::yield())
		ASSERT_LT(realTime(), end) << "the second wait does not block";
	running.relinquish(0);
	running.beginFrame();
	thread.join();
	using Type = ipc::MessageType;
	EXPECT_EQ(service.waitFor([](const auto &record) { return record.frameMessages.size() == 3; }).frameMessages,
			  (std::vector{Type::waitFrame, Type::relinquish, Type::waitFrame}));
}

TEST_F(FakeSession, WhatTheServiceAllocatedIsGivenBackWhenItCannotBeUsed)
{
	Session &running = session();
	const auto create = [&] { swapchain(running); };
	imagesMissing = 1;
	EXPECT_EQ(resultOf(create), XR_ERROR_RUNTIME_FAILURE);
	EXPECT_EQ(service.record().swapchainsDestroyed, 1u);
	imagesMissing = 0;
	device.importFails = true;
	EXPECT_EQ(resultOf(create), XR_ERROR_RUNTIME_FAILURE);
	EXPECT_EQ(service.record().swapchainsDestroyed, 2u);
	device.importFails = false;
	EXPECT_EQ(resultOf(create), XR_SUCCESS);
	EXPECT_EQ(service.record().swapchainsDestroyed, 2u);
}

TEST_F(FakeSession, AnAcquireOrReleaseThatFailsHasChangedNothing)
{
	Swapchain &images = swapchain(session());
	device.submitFails = true;
	EXPECT_EQ(resultOf([&] { images.acquire(); }), XR_ERROR_RUNTIME_FAILURE);
	device.submitFails = false;
	for (uint32_t expected = 0; expected < 3; ++expected) EXPECT_EQ(images.acquire(), expected);
	EXPECT_TRUE(images.wait(0));
	device.submitFails = true;
	EXPECT_EQ(resultOf([&] { images.release(); }), XR_ERROR_RUNTIME_FAILURE);
	EXPECT_EQ(images.newestImage(), std::nullopt);
	device.submitFails = false;
	images.release();
	EXPECT_EQ(images.newestImage().value().image, 0u);
}

/// An application may poll with a timeout shorter than a refresh, or with none.
TEST_F(FakeSession, PollingForTheImageThatIsShownGivesItUp)
{
	service.client().oldestHeldFrame = 1; // the compositor holds on to everything
	Swapchain &images = swapchain(session());
	for (uint64_t frame = 1; frame <= 3; ++frame) images.noteSubmitted(draw(images), frame);
	for (int i = 0; i < 3; ++i) images.acquire();
	const auto poll = [&](XrDuration timeout) {
		const XrTime begin = realTime();
		while (!images.wait(timeout)) ASSERT_LT(realTime() - begin, patience) << "with a timeout of " << timeout << " ns";
		EXPECT_GE(realTime() - begin, 16 * millisecond) << "not before a refresh has passed";
	};
	poll(0);
	EXPECT_EQ(service.record().relinquished, (std::vector<uint64_t>{1})) << "asked for once";
	images.release();
	images.noteSubmitted(0, 4);
	images.acquire();
	poll(millisecond);
	EXPECT_EQ(service.record().relinquished, (std::vector<uint64_t>{1, 2}));
}

/// xrWaitSwapchainImage: images may be acquired ahead, the shown one among them. Who waits for it shows no other meanwhile.
TEST_F(FakeSession, AWaitForTheImageThatIsShownEndsThoughOthersWereReleased)
{
	const Rescue rescue(service);
	service.client().oldestHeldFrame = 1; // the compositor shows frame 1 until it is told something else
	service.system().timing.write({.displayPeriod = millisecond});
	Swapchain &images = swapchain(session());
	images.acquire();
	images.acquire();
	const auto draw = [&] {
		ASSERT_TRUE(images.wait(0));
		images.release();
	};
	draw();
	images.noteSubmitted(0, 1);
	images.acquire();
	EXPECT_EQ(images.acquire(), 0u);
	draw();
	draw();
	const XrTime begin = realTime();
	EXPECT_TRUE(images.wait(XR_INFINITE_DURATION));
	EXPECT_GE(realTime() - begin, 10 * millisecond) << "what another thread has drawn may be shown any moment";
	EXPECT_EQ(service.record().relinquished, (std::vector<uint64_t>{1}));
}

/// A thread that waits for the service when that dies is told at once, not when the heartbeat is missed.
struct DyingService : FakeSession {
	void expectTheEndOf(const std::function<void()> &wait)
	{
		const Rescue rescue(service);
		std::atomic<pid_t> waiter{0};
		XrTime ended = 0;
		XrResult result = XR_SUCCESS;
		std::jthread thread([&] {
			waiter = ::gettid();
			result = resultOf(wait);
			ended = realTime();
		});
		for (const XrTime end = realTime() + patience; !sleeps(waiter); std::this_thread::yield())
			ASSERT_LT(realTime(), end) << "it does not wait";
		const XrTime died = realTime();
		service.hangUp();
		thread.join();
		EXPECT_EQ(result, XR_ERROR_INSTANCE_LOST);
		EXPECT_LT(ended - died, 100 * millisecond);
	}
};

TEST_F(DyingService, EndsAFramesWait)
{
	Session &running = session();
	service.stopAnswering();
	expectTheEndOf([&] { running.waitFrame(); });
}

TEST_F(DyingService, EndsAWaitForTheFrameBeforeToBeBegun)
{
	Session &running = session();
	running.waitFrame();
	expectTheEndOf([&] { running.waitFrame(); });
}

TEST_F(DyingService, EndsAnImagesWait)
{
	service.client().oldestHeldFrame = 1;
	service.system().timing.write({.displayPeriod = 10 * second}); // nothing is given up meanwhile
	Swapchain &images = swapchain(session());
	for (uint64_t frame = 1; frame <= 3; ++frame) images.noteSubmitted(draw(images), frame);
	for (int i = 0; i < 3; ++i) images.acquire();
	expectTheEndOf([&] { images.wait(XR_INFINITE_DURATION); });
}

TEST_F(DyingService, EndsARequest)
{
	Session &running = session();
	service.stopAnswering();
	expectTheEndOf([&] { swapchain(running); });
}

TEST_F(DyingService, ItsSilenceEndsARequestLongBeforeTheLimit)
{
	Session &running = session();
	service.stopAnswering();
	service.stopHeart();
	const XrTime asked = realTime();
	EXPECT_EQ(resultOf([&] { swapchain(running); }), XR_ERROR_INSTANCE_LOST);
	EXPECT_LT(realTime() - asked, Service::requestLimit / 2);
}

TEST_F(FakeSession, ALostDeviceEndsTheSession)
{
	Session &running = session();
	Swapchain &images = swapchain(running);
	draw(images);
	device.outcome = Completion::Outcome::failed;
	const XrTime time = running.waitFrame().predictedDisplayTime;
	running.beginFrame();
	const XrSpace local = handles.insert(std::make_unique<Space>(running, Space::Kind::local, identityPose), &running);
	const XrCompositionLayerQuad quad{.type = XR_TYPE_COMPOSITION_LAYER_QUAD,
									  .space = local,
									  .eyeVisibility = XR_EYE_VISIBILITY_BOTH,
									  .subImage = {handleOf(images), {{0, 0}, {64, 48}}, 0},
									  .pose = identityPose,
									  .size = {1, 1}};
	const auto *layer = reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quad);
	running.endFrame({XR_TYPE_FRAME_END_INFO, nullptr, time, XR_ENVIRONMENT_BLEND_MODE_OPAQUE, 1, &layer});
	EXPECT_TRUE(lossIsTold(instance));
	EXPECT_EQ(resultOf([&] { running.requireAlive(); }), XR_ERROR_SESSION_LOST);
	EXPECT_TRUE(service.record().submissions.empty());
}

} // namespace
} // namespace arift::openxr
