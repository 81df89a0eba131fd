// A session against a client that this test plays, with a compositor that this test plays.
#include "runtime/service/session.h"
#include <gtest/gtest.h>

using namespace arift;

namespace
{

constexpr XrDuration plenty = 10 * second, period = 16 * millisecond;

class SessionTest : public testing::Test
{
protected:
	explicit SessionTest(std::unique_ptr<Clock> clock = makeRealClock())
		: clock_(std::move(clock)),
		  page_(std::make_shared<ipc::SharedPage<ipc::ClientPage>>("test")),
		  pair_(ipc::Socket::pair()),
		  session_(7, *clock_, std::move(pair_.first), {[](uint32_t) {
					   return std::optional(SwapchainShape{64, 64, 1, 3});
				   }},
				   page_, [this](const std::string &problem) { malformed_.update([&](std::string &kept) { kept = problem; }); })
	{
		session_.setRunning(true);
	}

	ipc::Socket &client() { return pair_.second; }

	void waitFrame(uint32_t submissions)
	{
		ipc::WaitFrame message;
		message.header.sequence = submissions;
		ASSERT_EQ(client().send(message, realTime() + plenty), ipc::Transfer::done);
	}
	std::optional<ipc::FrameReady> ready(XrDuration limit = plenty)
	{
		ipc::Received received;
		return client().receive(received, realTime() + limit) == ipc::Transfer::done ? received.as<ipc::FrameReady>() : std::nullopt;
	}
	void submit(uint64_t frame, uint32_t layers = 1)
	{
		ipc::Submission message;
		message.frame = frame;
		message.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		message.layerCount = layers;
		message.layers[0].type = ipc::LayerType::quad;
		message.layers[0].width = message.layers[0].height = 1;
		message.layers[0].views[0].image = {.swapchain = 1, .width = 64, .height = 64};
		ASSERT_EQ(client().send(message, realTime() + plenty), ipc::Transfer::done);
	}
	/// The session's thread has taken everything sent so far: it answers in order, so a frame is asked for and waited for.
	template <typename Condition> bool eventually(Condition condition)
	{
		for (const XrTime end = realTime() + plenty; realTime() < end; std::this_thread::yield())
			if (condition()) return true;
		return false;
	}
	/// Wakes until the application has been answered: its WaitFrame may still be on its way.
	ipc::FrameReady wakeUntilReady(XrTime displayTime)
	{
		for (const XrTime end = realTime() + plenty; realTime() < end;) {
			session_.wake({displayTime, period, displayTime - period});
			if (const auto answer = ready(millisecond)) return *answer;
		}
		ADD_FAILURE() << "never woken";
		return {};
	}
	uint64_t oldestHeld() const { return (*page_)->oldestHeldFrame.load(); }

	std::unique_ptr<Clock> clock_;
	std::shared_ptr<ipc::SharedPage<ipc::ClientPage>> page_;
	std::pair<ipc::Socket, ipc::Socket> pair_;
	Guarded<std::string> malformed_;
	Session session_;
};

class SteppedSession : public SessionTest
{
protected:
	SteppedSession() : SessionTest(makeSteppedClock(second)) {}
};

} // namespace

TEST_F(SessionTest, AWaitingApplicationIsToldTheDisplayTimeOnce)
{
	const XrTime display = clock_->now() + second;
	waitFrame(0);
	const ipc::FrameReady answer = wakeUntilReady(display);
	EXPECT_EQ(answer.predictedDisplayTime, display);
	EXPECT_EQ(answer.predictedDisplayPeriod, period);
	EXPECT_EQ(answer.shouldRender, 1u);
	session_.wake({display + period, period, display});
	EXPECT_FALSE(ready(20 * millisecond)) << "it has not asked again";
}

TEST_F(SessionTest, DisplayTimesRise)
{
	const XrTime display = clock_->now() - second; // too late to be given away between wakes
	waitFrame(0);
	wakeUntilReady(display);
	waitFrame(0);
	ASSERT_TRUE(eventually([&] {
		session_.wake({display, period, display - period});
		session_.wake({display + period, period, display});
		const auto answer = ready(millisecond);
		EXPECT_TRUE(!answer || answer->predictedDisplayTime == display + period);
		return answer.has_value();
	}));
}

TEST_F(SessionTest, AnApplicationSlowerThanTheDisplayGetsWhatIsStillInTime)
{
	const XrTime display = clock_->now() + 100 * second;
	session_.wake({display, period, display - period});
	waitFrame(0);
	const auto answer = ready();
	ASSERT_TRUE(answer);
	EXPECT_EQ(answer->predictedDisplayTime, display);
}

TEST_F(SessionTest, ASlowCompositorsPaceIsToldAndLeavesAsMuchTime)
{
	constexpr XrDuration pace = 1000 * period; // longer than any pause of this test
	XrTime display = realTime();
	// Each time it hopes to be ready at once.
	for (int i = 0; i < 10; ++i) session_.wake({display += pace, period, realTime()});
	waitFrame(0);
	const auto frame = ready();
	ASSERT_TRUE(frame) << "there is a whole image's time left";
	EXPECT_EQ(frame->predictedDisplayTime, display);
	EXPECT_EQ(frame->predictedDisplayPeriod, pace);
}

TEST_F(SessionTest, TheNewestSubmissionIsShownAndOlderImagesAreFree)
{
	submit(1);
	submit(2);
	ASSERT_TRUE(eventually([&] { return session_.content() && session_.content()->frame == 2; }));
	session_.shown(session_.content());
	EXPECT_EQ(oldestHeld(), 2u);
	submit(3, 0); // nothing to show: nothing is held
	ASSERT_TRUE(eventually([&] { return !session_.content(); }));
	session_.shown(nullptr);
	EXPECT_EQ(oldestHeld(), 3u);
	EXPECT_EQ(session_.count().submitted, 3u);
	EXPECT_EQ(session_.count().shown, 1u);
}

TEST_F(SessionTest, WhatIsRelinquishedIsShownNoMore)
{
	submit(1);
	ASSERT_TRUE(eventually([&] { return session_.content() != nullptr; }));
	session_.shown(session_.content());
	ipc::Relinquish message;
	message.frame = 1;
	ASSERT_EQ(client().send(message, realTime() + plenty), ipc::Transfer::done);
	ASSERT_TRUE(eventually([&] { return session_.content() == nullptr; }));
	session_.shown(nullptr);
	EXPECT_EQ(oldestHeld(), 2u);
}

TEST_F(SessionTest, WhoWaitsWhenTheSessionEndsIsToldNotToDraw)
{
	waitFrame(0);
	ASSERT_TRUE(eventually([&] {
		session_.setRunning(false);
		const auto answer = ready(millisecond);
		EXPECT_TRUE(!answer || answer->shouldRender == 0);
		return answer.has_value();
	}));
}

TEST_F(SessionTest, AMalformedMessageIsReported)
{
	submit(5);
	submit(5);
	ASSERT_TRUE(eventually([&] { return !malformed_.lock()->empty(); }));
	EXPECT_EQ(*malformed_.lock(), "submission 5 comes after a later one");
}

TEST_F(SteppedSession, TimeStandsStillUntilFrameAndNextWait)
{
	std::optional<Clock::Hold> compositor(*clock_);
	waitFrame(0);
	const XrTime start = clock_->now();
	wakeUntilReady(start + period);
	std::atomic<bool> stepped = false;
	std::jthread thread([&, hold = std::move(*std::exchange(compositor, std::nullopt))](std::stop_token stop) {
		clock_->sleepUntil(start + period, stop);
		stepped = true;
	});
	// The next wait overtakes the submission it announces.
	waitFrame(1);
	for (int i = 0; i < 50; ++i) std::this_thread::yield();
	EXPECT_FALSE(stepped) << "submission 1 has been announced and is not there";
	EXPECT_EQ(clock_->now(), start);
	submit(1);
	thread.join();
	EXPECT_TRUE(stepped);
	EXPECT_EQ(session_.content()->frame, 1u) << "it was there before time went on";
}

TEST_F(SteppedSession, AClientThatDiesLetsTimeGoOn)
{
	std::optional<Clock::Hold> compositor(*clock_);
	waitFrame(0);
	const XrTime start = clock_->now();
	wakeUntilReady(start + period);
	client().hangUp();
	EXPECT_TRUE(clock_->sleepUntil(start + period, {}));
}
