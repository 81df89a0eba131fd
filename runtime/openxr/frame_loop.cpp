// xrWaitFrame, xrBeginFrame, xrEndFrame. OpenXR 1.1, "Frame Synchronization" and "Frame Submission".
#include "runtime/openxr/frame_submission.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{
namespace
{

/// How often a wait for the service, or for the application's own next frame, looks whether the service still lives (real time).
constexpr XrDuration lookAround = 20 * millisecond;
/// A process that dies closes its sockets one after the other (real time): the one for frames may be the first.
constexpr XrDuration bothEnd = 20 * millisecond;
/// How long the service may leave a frame channel unread that is full (real time).
constexpr XrDuration sendLimit = second;

} // namespace

void Session::loseFrames(const char *why)
{
	instance.service.noticeHangUp(bothEnd);
	instance.requireAlive();
	life_->lose();
	throw Error(XR_ERROR_SESSION_LOST, "{}", why);
}

template <typename Message> void Session::sendFrame(const Message &message)
{
	switch (frames_->send(message, realTime() + sendLimit)) {
	case ipc::Transfer::done: return;
	case ipc::Transfer::timeout: loseFrames("arift-service does not read the frame channel");
	default: loseFrames("the frame channel is closed");
	}
}

ipc::FrameReady Session::askForFrame()
{
	// A stepped clock goes on when what the session submitted until now has come: the service is told how many that are.
	sendFrame(ipc::WaitFrame{{ipc::MessageType::waitFrame, uint32_t(submitted_.load())}});
	for (ipc::Received received;;) {
		const ipc::Transfer transfer = frames_->receive(received, realTime() + lookAround);
		if (transfer != ipc::Transfer::done && transfer != ipc::Transfer::timeout) loseFrames("the frame channel is closed");
		if (transfer == ipc::Transfer::done)
			if (const auto ready = received.as<ipc::FrameReady>()) return *ready;
		requireAlive();
	}
}

XrFrameState Session::waitFrame()
{
	{
		auto life = life_->lock();
		life->requireRunning();
		while (!life.waitFor({}, std::chrono::nanoseconds(lookAround), [](const Life &l) { return !l.facts.begun || l.order.mayWait(); })) {
			instance.service.noticeHangUp();
			requireAlive();
		}
		life->requireRunning();
		life->order.startWait();
	}
	try {
		// A headless session is paced by the service as well: its clock may be a stepped one.
		const ipc::FrameReady ready = askForFrame();
		takeNews();
		life_->change([](Life &life) { life.order.finishWait(true); });
		waitedAt_ = realTime();
		const bool isShown = state() == XR_SESSION_STATE_VISIBLE || state() == XR_SESSION_STATE_FOCUSED;
		return {.predictedDisplayTime = ready.predictedDisplayTime,
				.predictedDisplayPeriod = ready.predictedDisplayPeriod,
				.shouldRender = ready.shouldRender != 0 && isShown && graphics_};
	} catch (...) {
		life_->change([](Life &life) { life.order.finishWait(false); });
		throw;
	}
}

bool Session::beginFrame()
{
	bool discarded = false;
	life_->change([&](Life &life) {
		life.requireRunning();
		discarded = life.order.begin();
	});
	begunAt_ = waitedAt_.load();
	return discarded;
}

void Session::endFrame(const XrFrameEndInfo &info)
{
	{
		const auto life = life_->lock();
		life->requireRunning();
		life->order.requireBegun();
	}
	FrameSubmission frame(*this, info);
	for (const std::shared_ptr<Completion> &work : frame.work) work->settle();
	if (submitter_) {
		frame.submission.frame = ++submitted_;
		frame.noteUse();
		submitter_->submit(frame.submission, std::move(frame.work));
	}
	life_->change([](Life &life) {
		life.order.end();
		life.facts.frameSynchronized = true;
	});
	if (!measuresFrames) return;
	const XrTime now = realTime();
	frameCost_.update([&](FrameCost &cost) { cost = {cost.frames + 1, now - begunAt_}; });
}

void Session::relinquish(uint64_t frame)
{
	ipc::Relinquish message;
	message.frame = frame;
	sendFrame(message);
}

void waitFrame(Session &session, const XrFrameWaitInfo *, XrFrameState &state)
{
	const XrFrameState found = session.waitFrame();
	state.predictedDisplayTime = found.predictedDisplayTime;
	state.predictedDisplayPeriod = found.predictedDisplayPeriod;
	state.shouldRender = found.shouldRender;
}

XrResult beginFrame(Session &session, const XrFrameBeginInfo *) { return session.beginFrame() ? XR_FRAME_DISCARDED : XR_SUCCESS; }

void endFrame(Session &session, const XrFrameEndInfo &info) { session.endFrame(info); }

} // namespace arift::openxr
