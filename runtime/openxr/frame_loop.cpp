// xrWaitFrame, xrBeginFrame, xrEndFrame. OpenXR 1.1, "Frame Synchronization" and "Frame Submission".
#include "runtime/openxr/frame_submission.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{
namespace
{

/// How often a wait for the service looks whether it still lives (real time).
constexpr XrDuration lookAround = 100 * millisecond;

} // namespace

ipc::FrameReady Session::askForFrame()
{
	// A stepped clock goes on when what the session submitted until now has come: the service is told how many that are.
	const ipc::WaitFrame request{{ipc::MessageType::waitFrame, uint32_t(submitted_.load())}};
	ipc::Transfer transfer = frames_->send(request, realTime() + second);
	while (transfer == ipc::Transfer::done || transfer == ipc::Transfer::timeout) {
		requireAlive();
		ipc::Received received;
		transfer = frames_->receive(received, realTime() + lookAround);
		if (transfer != ipc::Transfer::done) continue;
		if (const auto ready = received.as<ipc::FrameReady>()) return *ready;
	}
	instance.service.noticeHangUp();
	if (!instance.service.isLost()) lose();
	requireAlive();
	throw Error(XR_ERROR_SESSION_LOST, "the frame channel is closed");
}

XrFrameState Session::waitFrame()
{
	{
		auto life = life_.lock();
		requireRunning(*life);
		while (!life.waitFor({}, std::chrono::nanoseconds(lookAround), [](const Life &l) { return !l.facts.begun || l.order.mayWait(); }))
			requireAlive();
		requireRunning(*life);
		life->order.startWait();
	}
	try {
		// A headless session is paced by the service as well: its clock may be a stepped one.
		const ipc::FrameReady ready = askForFrame();
		instance.takeNews();
		life_.update([](Life &life) { life.order.finishWait(true); });
		const bool isShown = state() == XR_SESSION_STATE_VISIBLE || state() == XR_SESSION_STATE_FOCUSED;
		return {.predictedDisplayTime = ready.predictedDisplayTime,
				.predictedDisplayPeriod = ready.predictedDisplayPeriod,
				.shouldRender = ready.shouldRender != 0 && isShown && graphics_};
	} catch (...) {
		life_.update([](Life &life) { life.order.finishWait(false); });
		throw;
	}
}

bool Session::beginFrame()
{
	bool discarded = false;
	life_.update([&](Life &life) {
		requireRunning(life);
		discarded = life.order.begin();
	});
	return discarded;
}

void Session::endFrame(const XrFrameEndInfo &info)
{
	{
		auto life = life_.lock();
		requireRunning(*life);
		life->order.requireBegun();
	}
	FrameSubmission frame(*this, info);
	if (submitter_) {
		frame.submission.frame = ++submitted_;
		frame.noteUse();
		submitter_->submit(frame.submission, std::move(frame.work));
	}
	life_.update([&](Life &life) {
		life.order.end();
		life.facts.frameSynchronized = true;
		settleLocked(life);
	});
}

void Session::relinquish(uint64_t frame)
{
	ipc::Relinquish message;
	message.frame = frame;
	frames_->send(message, realTime() + second);
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
