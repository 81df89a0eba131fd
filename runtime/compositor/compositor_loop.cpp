#include "runtime/compositor/compositor_loop.h"
#include "runtime/base/log.h"
#include <algorithm>
#include <ctime>

namespace arift
{

namespace
{

/// How late a latch may be, of Pacer::Settings::margin.
constexpr XrDuration latest = 700 * microsecond;

} // namespace

double processSeconds()
{
	timespec used{};
	::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
	return double(used.tv_sec) + double(used.tv_nsec) * 1e-9;
}

Compositor::Loop::Loop(const Surroundings &surroundings, const Pacer &pacer, std::unique_ptr<Panel> panel)
	: surroundings_(surroundings), pacer_(pacer), panel_(std::move(panel)), stepped_(surroundings.clock.anchor().rate == 0)
{
	report.lock()->cpuAtReset = processSeconds();
}

void Compositor::Loop::changeImages(std::vector<ImageChange> changes)
{
	for (ImageChange &change : changes) {
		if (change.image != VK_NULL_HANDLE) {
			try {
				panel_->addImage(change.key, change.image, change.spec);
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

Latched Compositor::Loop::latch(const Sources &sources, Contents &contents)
{
	Latched latched;
	for (size_t eye = 0; eye < 2; ++eye)
		if (surroundings_.cameras[eye]) latched.cameras[eye] = surroundings_.cameras[eye]->newest();
	const auto isGone = [this](const auto &view) { return view && !images_.contains(view->texture.image); };
	for (const auto &source : sources) {
		const auto content = contents.emplace_back(source->content());
		if (!content) continue;
		latched.blendMode = content->blendMode; // the topmost application decides
		for (PanelLayer layer : content->layers) {
			for (size_t eye = 0; eye < 2; ++eye) {
				if (isGone(layer.projection[eye])) layer.projection[eye].reset();
				if (isGone(layer.quad[eye])) layer.quad[eye].reset();
			}
			latched.layers.push_back(std::move(layer));
		}
	}
	return latched;
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
	if (stepped_) surroundings_.page.clock.write({anchor.realAnchor, anchor.xrAnchor, anchor.rate});
}

Pacer::Refresh Compositor::Loop::after(const Pacer::Refresh &refresh) const
{
	Pacer::Refresh next = pacer_.following(refresh);
	// When composing has become cheaper than was thought, the refresh just served could be reached again.
	if (const XrDuration period = pacer_.period(); next.display - refresh.display < period / 2)
		next = {next.latch + period, next.vblank + period, next.display + period};
	return next;
}

void Compositor::Loop::wake(const Sources &sources, const Pacer::Refresh &refresh)
{
	const Pacer::Refresh following = after(refresh);
	for (const auto &source : sources) source->wake({following.display, pacer_.period(), following.latch});
}

void Compositor::Loop::record(const PanelInputs &inputs, const MotionSample &newest, XrTime display, XrDuration cost)
{
	ShownFrame shown{.displayTime = display, .period = pacer_.period(), .composeCost = cost};
	for (size_t eye = 0; eye < 2; ++eye)
		if (inputs.cameras[eye]) shown.cameraAge[eye] = display - inputs.cameras[eye]->frame.midExposure;
	if (newest.time != 0) shown.poseAge = display - newest.time;
	report.update([&](Report &kept) { kept.record.add(shown); });
}

void Compositor::Loop::hand(std::vector<Wanted> wanted, const PanelInputs &inputs, XrTime display)
{
	for (Wanted &each : wanted) {
		try {
			each.promise.set_value({each.kind == ipc::PictureKind::panel ? panel_->readPanel() : panel_->renderEyes(inputs), display});
		} catch (const std::exception &) {
			each.promise.set_exception(std::current_exception());
		}
	}
}

bool Compositor::Loop::frame(const Pacer::Refresh &refresh)
{
	Clock &clock = surroundings_.clock;
	Sources sources;
	std::vector<ImageChange> changes;
	std::vector<Wanted> wanted;
	Latched latched;
	double passthroughDistance = 0;
	inbox.update([&](Inbox &box) {
		sources = box.sources;
		changes.swap(box.imageChanges);
		wanted.swap(box.wanted);
		passthroughDistance = box.passthroughDistance;
	});
	changeImages(std::move(changes));

	const XrTime began = clock.now(), realBegan = realTime();
	publishTiming(refresh);
	Contents contents;
	latched = latch(sources, contents);
	latched.passthroughDistance = passthroughDistance;
	MotionSample newest;
	surroundings_.poses.newest(newest);
	if (const auto views = surroundings_.page.views.read()) views_ = *views;
	PanelInputs inputs = assemble(surroundings_.rig, views_, surroundings_.poses, refresh.display, std::move(latched));
	fade_.apply(inputs);
	wake(sources, refresh); // they draw for the refresh after this one while this one is drawn

	panel_->render(inputs);
	for (size_t i = 0; i < sources.size(); ++i) sources[i]->shown(contents[i]);
	const XrDuration cost = realTime() - realBegan;
	pacer_.composed(clock.now() - began);
	const Target::Result result = panel_->present(refresh);
	pacer_.displayed(result.display);
	lastDisplay_ = result.display;
	record(inputs, newest, result.display, cost);
	hand(std::move(wanted), inputs, result.display);
	return result.outcome == Presented::shown;
}

void Compositor::Loop::run(std::stop_token stop)
{
	Clock &clock = surroundings_.clock;
	End end;
	try {
		// On a machine that is always late no sleep is long enough to be ended by the stop request: it is asked for as well.
		for (Pacer::Refresh refresh = pacer_.next(clock.now()); clock.sleepUntil(refresh.latch, stop) && !stop.stop_requested();
			 refresh = after(refresh)) {
			// Later than the margin allows for, the refresh planned cannot be reached any more: the next one can.
			if (const XrTime now = clock.now(); now - refresh.latch > latest) refresh = pacer_.next(now);
			if (!frame(refresh)) {
				end.closed = true;
				break;
			}
		}
		if (stop.stop_requested()) return;
	} catch (const std::exception &problem) {
		end.problem = problem.what();
	}
	report.update([&](Report &kept) { kept.end = end; });
}

} // namespace arift
