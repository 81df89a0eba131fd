#include "runtime/compositor/compositor_loop.h"
#include "runtime/base/log.h"
#include "runtime/compositor/layer_order.h"
#include "runtime/motion/view_poses.h"
#include <ctime>

namespace arift
{

double processSeconds()
{
	timespec used{};
	::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
	return double(used.tv_sec) + double(used.tv_nsec) * 1e-9;
}

Compositor::Loop::Loop(const Surroundings &surroundings, const Pacer &pacer, std::unique_ptr<Panel> panel)
	: surroundings_(surroundings), pacer_(pacer), panel_(std::move(panel)), rate_(surroundings.clock.anchor().rate)
{
	report.lock()->cpuAtReset = processSeconds();
}

void Compositor::Loop::changeImages(std::vector<ImageChange> changes)
{
	for (ImageChange &change : changes) {
		if (change.image != VK_NULL_HANDLE) {
			try {
				panel_->addImage(change.key, change.image, change.spec, change.rows);
				images_[change.key] = std::move(change.owner);
			} catch (const std::exception &problem) {
				log::error("an application's image cannot be shown: {}", problem.what()); // its layers are left out
			}
		} else if (images_.contains(change.key)) {
			panel_->removeImage(change.key);
			images_.erase(change.key);
		}
	}
}

std::vector<Compositor::Loop::ImageChange> Compositor::Loop::take(Frame &frame)
{
	std::vector<ImageChange> changes;
	inbox.update([&](Inbox &box) {
		frame.sources.assign(box.sources.begin(), box.sources.end());
		frame.settings = box.settings;
		changes.swap(box.imageChanges);
		frame.wanted.swap(box.wanted);
	});
	return changes;
}

void Compositor::Loop::latchLayers(Frame &frame, const XrPosef &head, Latched &latched) const
{
	for (const auto &source : frame.sources) frame.contents.push_back(source->content());
	if (frame.settings.rawPassthrough) return;
	FrameVector<std::span<const PanelLayer>> together; // of sources with the same order
	for (size_t i = 0; i < frame.sources.size(); ++i) {
		const uint64_t order = frame.sources[i]->order();
		if (const auto &content = frame.contents[i]) {
			// Among main applications the world is behind all of them, and the topmost one decides how it is seen. An overlay's hides
			// theirs.
			const bool hidesOthers = content->hidesOthers && order > 0;
			if (order == 0 || hidesOthers) latched.blendMode = content->blendMode;
			if (hidesOthers) {
				latched.layers.clear();
				together.clear();
			}
			together.push_back(content->layers);
		}
		const bool isLast = i + 1 == frame.sources.size() || frame.sources[i + 1]->order() != order;
		if (!isLast && surroundings_.nearerOver) continue;
		mergeByDistance(together, head, latched.layers);
		together.clear();
	}
}

void Compositor::Loop::publishTiming(const Pacer::Refresh &refresh)
{
	ipc::TimingTable timing;
	for (size_t eye = 0; eye < 2; ++eye)
		if (surroundings_.cameras[eye]) timing.cameras[eye] = surroundings_.cameras[eye]->timing();
	timing.displayPeriod = pacer_.period();
	timing.lastDisplayTime = lastDisplay_;
	timing.latchBeforeDisplay = refresh.display - refresh.latch;
	surroundings_.page.timing.write(timing);
	const ClockAnchor anchor = surroundings_.clock.anchor();
	if (rate_ == 0) surroundings_.page.clock.write({anchor.realAnchor, anchor.xrAnchor, anchor.rate});
}

void Compositor::Loop::wake(const Sources &sources, const Pacer::Refresh &refresh)
{
	const Pacer::Refresh following = pacer_.following(refresh);
	for (const auto &source : sources) source->wake({following.display, pacer_.period(), following.latch});
}

void Compositor::Loop::record(const Frame &frame)
{
	const XrTime display = frame.result.display;
	ShownFrame shown{
		.displayTime = display, .period = pacer_.period(), .composeCost = frame.cost, .stages = frame.stages, .leftOut = frame.leftOut};
	for (size_t eye = 0; eye < 2; ++eye)
		if (const auto &camera = frame.inputs.cameras[eye]) shown.cameraAge[eye] = display - camera->frame.midExposure;
	if (frame.newest.time != 0) shown.poseAge = display - frame.newest.time;
	report.update([&](Report &kept) { kept.record.add(shown); });
}

/// Stages follow each other: their times say when each began.
void Compositor::Loop::trace(const Frame &frame, XrTime realBegan)
{
	frameNumber_++;
	if (!surroundings_.trace) return;
	XrTime begin = realBegan - frame.stages.front();
	for (size_t stage = 0; stage < frame.stages.size(); ++stage) {
		surroundings_.trace->add({frameStageNames[stage], begin, frame.stages[stage], 0, frameNumber_});
		begin += frame.stages[stage];
	}
	if (rate_ <= 0) return;
	const XrTime now = surroundings_.clock.now(), realNow = realTime();
	const auto real = [&](XrDuration duration) { return XrDuration(double(duration) / rate_); };
	for (size_t i = 0; i < frame.sources.size(); ++i)
		if (const auto &content = frame.contents[i])
			surroundings_.trace->add({"received until seen", realNow - real(now - content->received),
									  real(frame.result.display - content->received), frame.sources[i]->number(), content->frame});
}

void Compositor::Loop::hand(Frame &frame)
{
	std::array<std::optional<ReadbackImage>, 2> made; // of each kind one, however many want it
	for (Wanted &each : frame.wanted) {
		try {
			auto &image = made[size_t(each.kind)];
			if (!image) image = each.kind == ipc::PictureKind::panel ? panel_->readPanel() : panel_->renderEyes(frame.inputs);
			each.promise.set_value({*image, frame.result.display});
		} catch (const std::exception &) {
			each.promise.set_exception(std::current_exception());
		}
	}
}

void Compositor::Loop::choose(const Pacer::Refresh &refresh, Frame &frame)
{
	publishTiming(refresh);
	Latched latched{.layers = std::move(layers_), .passthroughDistance = frame.settings.passthroughDistance};
	for (size_t eye = 0; eye < 2; ++eye)
		if (surroundings_.cameras[eye]) latched.cameras[eye] = surroundings_.cameras[eye]->newest();
	const PoseMoment poses = surroundings_.poses.now(); // one moment for all of the frame
	if (poses.newest()) frame.newest = *poses.newest();
	if (const auto views = surroundings_.page.views.read()) views_ = *views;
	latchLayers(frame, headInOrigin(views_, poses.at(refresh.display)), latched);
	frame.inputs = assemble(surroundings_.rig, views_, poses, refresh.display, std::move(latched));
	fade_.apply(frame.inputs);
	wake(frame.sources, refresh); // they draw for the refresh after this one while this one is drawn
}

void Compositor::Loop::show(const Pacer::Refresh &refresh, Frame &frame)
{
	frame.result = panel_->present(refresh);
	pacer_.displayed(frame.result.display);
	lastDisplay_ = frame.result.display;
	for (size_t i = 0; i < frame.sources.size(); ++i)
		if (frame.contents[i]) frame.sources[i]->displayed(*frame.contents[i], frame.result.display);
	if (frame.result.rawKeys % 2 == 0) return;
	bool raw = false;
	inbox.update([&](Inbox &box) { raw = box.settings.rawPassthrough = !box.settings.rawPassthrough; });
	log::info("key: {}", raw ? "the cameras alone are shown" : "holograms are shown again");
}

XrDuration Compositor::Loop::lateness(XrTime planned, XrTime now) const
{
	return rate_ > 0 && now > planned ? XrDuration(double(now - planned) / rate_) : 0;
}

bool Compositor::Loop::frame(const Pacer::Refresh &refresh, XrTime planned)
{
	Clock &clock = surroundings_.clock;
	const FrameMemory::Turn turn(memory_);
	Frame frame;
	auto &[wakeLate, choosing, planning, uploading, recording, drawing, presenting] = frame.stages;
	const XrTime began = clock.now(), realBegan = realTime();
	changeImages(take(frame));
	choose(refresh, frame);
	const XrTime chosen = realTime();
	panel_->render(frame.inputs);
	for (size_t i = 0; i < frame.sources.size(); ++i) frame.sources[i]->shown(frame.contents[i]);
	const XrTime rendered = realTime();
	pacer_.composed(clock.now() - planned);
	show(refresh, frame);

	const PanelRenderer::Cost cost = panel_->cost();
	wakeLate = lateness(planned, began);
	choosing = chosen - realBegan;
	planning = fromSeconds(cost.plan);
	uploading = fromSeconds(cost.upload);
	recording = fromSeconds(cost.record);
	drawing = fromSeconds(cost.wait);
	presenting = realTime() - rendered;
	frame.leftOut = cost.leftOut;
	frame.cost = rendered - realBegan;
	record(frame);
	trace(frame, realBegan);
	hand(frame);
	layers_ = std::move(frame.inputs.layers);
	layers_.clear();
	return frame.result.outcome == Presented::shown;
}

void Compositor::Loop::run(const std::stop_token &stop)
{
	Clock &clock = surroundings_.clock;
	End end;
	try {
		if (surroundings_.threadBegins) surroundings_.threadBegins();
		// On a machine that is always late no sleep is long enough to be ended by the stop request: it is asked for as well.
		for (Pacer::Refresh refresh = pacer_.next(clock.now()); clock.sleepUntil(refresh.latch, stop) && !stop.stop_requested();
			 refresh = pacer_.after(lastDisplay_, clock.now())) {
			const XrTime planned = refresh.latch, now = clock.now();
			if (!pacer_.reaches(refresh, now)) refresh = pacer_.next(now); // woken far too late
			if (!frame(refresh, planned)) {
				end.closed = true;
				break;
			}
		}
		if (stop.stop_requested()) return;
	} catch (const std::exception &problem) {
		end.problem = problem.what();
	}
	report.update([&](Report &kept) { kept.end = end; });
	panel_.reset(); // no window without anything in it
	std::vector<Wanted> unanswered;
	inbox.update([&](Inbox &box) { box.wanted.swap(unanswered); });
}

} // namespace arift
