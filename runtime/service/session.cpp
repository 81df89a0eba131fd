#include "runtime/service/session.h"

namespace arift
{

Session::Session(uint32_t number, Clock &clock, ipc::Socket channel, Images images, std::shared_ptr<ipc::SharedPage<ipc::ClientPage>> page,
				 std::function<void(const std::string &)> onMalformed, uint64_t order)
	: number_(number),
	  order_(order),
	  clock_(clock),
	  channel_(std::move(channel)),
	  images_(std::move(images)),
	  page_(std::move(page)),
	  onMalformed_(std::move(onMalformed)),
	  shown_(Shown{.presentation = {.overlay = order > 0}}),
	  thread_([this](const std::stop_token &stop) { serve(stop); })
{
}

Session::~Session() { close(); }

void Session::close()
{
	thread_.request_stop();
	channel_.hangUp();
	if (thread_.joinable()) thread_.join();
}

void Session::finish(Afterwards &afterwards)
{
	// A full or dead channel is its reader's loss: the compositor never waits for an application.
	if (afterwards.ready) channel_.send(*afterwards.ready, 0);
	afterwards.released.reset();
}

ipc::FrameReady Session::answer(State &state)
{
	ipc::FrameReady ready;
	ready.header.sequence = state.announced;
	ready.predictedDisplayTime = state.current.displayTime;
	ready.predictedDisplayPeriod = state.pace.period();
	ready.shouldRender = state.running;
	state.waiting = false;
	state.answered = state.current.displayTime;
	return ready;
}

void Session::releaseIfComplete(State &state, Afterwards &afterwards)
{
	const bool complete = int32_t(uint32_t(state.received) - state.announced) >= 0;
	if (state.waiting && complete) afterwards.released = std::exchange(state.hold, std::nullopt);
}

void Session::setRunning(bool running)
{
	Afterwards afterwards;
	shown_.update([&](Shown &shown) {
		if (!running) shown.submission.reset();
		state_.update([&](State &state) {
			state.running = running;
			if (running) state.pace = {}; // the pause before was no interval
			if (running) return;
			state.newest.reset();
			if (state.waiting) afterwards.ready = answer(state);
			afterwards.released = std::exchange(state.hold, std::nullopt);
		});
	});
	finish(afterwards);
}

bool Session::running() { return state_.lock()->running; }

Session::Count Session::count()
{
	const auto state = state_.lock();
	return {state->received, state->shown};
}

void Session::wake(const Opportunity &opportunity)
{
	std::optional<Clock::Hold> hold(clock_);
	Afterwards afterwards;
	state_.update([&](State &state) {
		state.current = opportunity;
		state.offeredAt = clock_.now();
		state.pace.offer(opportunity.displayTime, opportunity.period);
		if (!state.waiting || opportunity.displayTime <= state.answered) return;
		afterwards.ready = answer(state);
		state.hold.swap(hold);
		state.holdSince = realTime();
	});
	finish(afterwards);
}

std::shared_ptr<const FrameContent> Session::content() { return state_.lock()->newest; }

void Session::shown(const std::shared_ptr<const FrameContent> &content)
{
	uint64_t oldestHeld = 0;
	state_.update([&](State &state) {
		if (content && content->frame > state.newestShown) {
			state.newestShown = content->frame;
			state.shown++;
		}
		// Without content nothing is held: what comes next is newer than all that came.
		oldestHeld = content ? content->frame : std::max(state.newestShown, state.relinquished) + 1;
	});
	(*page_)->oldestHeldFrame.store(oldestHeld, std::memory_order_release);
}

void Session::displayed(const FrameContent &content, XrTime display)
{
	state_.update([&](State &state) {
		Latencies &latencies = state.latencies;
		if (content.frame <= latencies.newest) return;
		latencies.newest = content.frame;
		latencies.values[latencies.count++ % latencies.values.size()] = display - content.received;
	});
}

Figure Session::latency()
{
	const Latencies latencies = [&] { return state_.lock()->latencies; }();
	const size_t count = std::min<size_t>(latencies.count, latencies.values.size());
	return figureOf({latencies.values.begin(), latencies.values.begin() + ptrdiff_t(count)});
}

/// What is drawn for the newest opportunity can still come until then. A compositor that is slower than the panel takes what there is when
/// it has made the image that it is at, which lasts about as long as those before, however long it was hoped to last.
XrTime Session::latchOf(const State &state)
{
	const XrDuration pace = state.pace.period();
	return pace > state.current.period ? std::max(state.current.latch, state.offeredAt + pace) : state.current.latch;
}

void Session::take(const ipc::WaitFrame &message)
{
	const XrTime now = clock_.now();
	const bool stepped = clock_.anchor().rate == 0;
	Afterwards afterwards;
	state_.update([&](State &state) {
		state.waiting = true;
		state.announced = message.header.sequence;
		// An application slower than the display need not wait for the next wake when there is still time for the newest opportunity.
		const bool inTime = state.current.displayTime > state.answered && now + state.current.period / 4 < latchOf(state);
		if (!stepped && inTime) afterwards.ready = answer(state);
		releaseIfComplete(state, afterwards);
	});
	finish(afterwards);
}

std::shared_ptr<const FrameContent> Session::Shown::content() const
{
	return submission ? contentOf(*submission, submissionCame, presentation) : nullptr;
}

/// What was shown before goes when the lock is gone.
void Session::show(std::shared_ptr<const FrameContent> content)
{
	state_.update([&](State &state) { state.newest.swap(content); });
}

void Session::take(const ipc::Submission &message)
{
	Afterwards afterwards;
	images_.fetch(message);
	const XrTime now = clock_.now();
	shown_.update([&](Shown &shown) {
		uint64_t received = 0, relinquished = 0;
		state_.update([&](State &state) {
			received = std::exchange(state.received, std::max(state.received, message.frame));
			relinquished = state.relinquished;
		});
		if (message.frame <= received) throw Malformed("submission {} comes after a later one", message.frame);
		if (message.frame <= relinquished) return;
		shown.submission = std::make_shared<const ipc::Submission>(message);
		shown.submissionCame = now;
		show(shown.content());
	});
	state_.update([&](State &state) { releaseIfComplete(state, afterwards); });
	finish(afterwards);
}

void Session::take(const ipc::Relinquish &message)
{
	const auto shown = shown_.lock();
	state_.update([&](State &state) { state.relinquished = std::max(state.relinquished, message.frame); });
	if (!shown->submission || shown->submission->frame > message.frame) return;
	shown->submission.reset();
	show(nullptr);
}

void Session::dropOldHold()
{
	Afterwards afterwards;
	state_.update([&](State &state) {
		if (state.hold && realTime() - state.holdSince > longestHold) afterwards.released = std::exchange(state.hold, std::nullopt);
	});
	if (afterwards.released && clock_.anchor().rate == 0)
		log::warning("session {} has not gone on with its frame for {} s: the stepped clock goes on without it", number_,
					 longestHold / second);
	finish(afterwards);
}

void Session::serve(const std::stop_token &stop)
{
	ipc::Received received;
	try {
		while (!stop.stop_requested()) {
			const ipc::Transfer transfer = channel_.receive(received, realTime() + second / 2);
			if (transfer == ipc::Transfer::hungUp) break;
			if (transfer == ipc::Transfer::malformed) throw Malformed("message longer than {} bytes", ipc::maxMessageSize);
			if (transfer == ipc::Transfer::done)
				std::visit([this](const auto &message) { take(message); }, decodeFrameRequest(received, images_.find));
			dropOldHold();
		}
	} catch (const Malformed &problem) {
		onMalformed_(problem.what());
	} catch (const std::exception &problem) {
		log::error("session {} is lost: {}", number_, problem.what());
		channel_.hangUp();
	}
	setRunning(false);
}

} // namespace arift
