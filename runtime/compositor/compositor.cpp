#include "runtime/compositor/compositor.h"
#include "runtime/compositor/compositor_loop.h"
#include <algorithm>

namespace arift
{

Compositor::Compositor(const Surroundings &surroundings, const Pacer &pacer, std::unique_ptr<Panel> panel)
	: loop_(std::make_unique<Loop>(surroundings, pacer, std::move(panel)))
{
	// Taken here: from the constructor's return on, a stepped clock does not move without this thread.
	thread_ = std::jthread([loop = loop_.get(), hold = Clock::Hold(surroundings.clock)](const std::stop_token &stop) { loop->run(stop); });
}

Compositor::~Compositor()
{
	thread_.request_stop();
	thread_.join();
}

void Compositor::addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec, std::shared_ptr<const void> owner,
						  const gpu::ImageRows &rows)
{
	loop_->inbox.update([&](Loop::Inbox &box) { box.imageChanges.push_back({key, image, spec, rows, std::move(owner)}); });
}

void Compositor::removeImage(uint64_t key)
{
	loop_->inbox.update([&](Loop::Inbox &box) { box.imageChanges.push_back({.key = key}); });
}

void Compositor::addSource(std::shared_ptr<FrameSource> source)
{
	loop_->inbox.update([&](Loop::Inbox &box) {
		std::erase(box.sources, source);
		const auto behind = std::ranges::find_if(box.sources, [&](const auto &each) { return each->order() > source->order(); });
		box.sources.insert(behind, std::move(source));
	});
}

void Compositor::removeSource(const FrameSource &source)
{
	std::shared_ptr<FrameSource> removed; // its destructor runs when the lock is gone
	loop_->inbox.update([&](Loop::Inbox &box) {
		std::erase_if(box.sources, [&](std::shared_ptr<FrameSource> &each) {
			if (each.get() != &source) return false;
			removed = std::move(each);
			return true;
		});
	});
}

void Compositor::setPassthroughDistance(double metres)
{
	loop_->inbox.update([&](Loop::Inbox &box) { box.settings.passthroughDistance = metres; });
}

void Compositor::setRawPassthrough(bool raw)
{
	loop_->inbox.update([&](Loop::Inbox &box) { box.settings.rawPassthrough = raw; });
}

bool Compositor::rawPassthrough() { return loop_->inbox.lock()->settings.rawPassthrough; }

std::optional<Picture> Compositor::picture(ipc::PictureKind kind, XrDuration limit)
{
	std::promise<Picture> promise;
	std::future<Picture> picture = promise.get_future();
	loop_->inbox.update([&](Loop::Inbox &box) { box.wanted.push_back({kind, std::move(promise)}); });
	if (picture.wait_for(std::chrono::nanoseconds(limit)) != std::future_status::ready) return std::nullopt;
	try {
		return picture.get();
	} catch (const std::future_error &) { // the compositor has ended in between
		return std::nullopt;
	}
}

FrameFigures Compositor::figures(bool reset)
{
	// A copy is sorted: the compositor's thread, which writes the record, waits for no more than the copying.
	FrameRecord record;
	const double used = processSeconds();
	double before = 0;
	loop_->report.update([&](Loop::Report &report) {
		record = report.record;
		before = report.cpuAtReset;
		if (!reset) return;
		report.record.reset();
		report.cpuAtReset = used;
	});
	FrameFigures figures = record.figures();
	figures.cpuSeconds = used - before;
	return figures;
}

std::optional<Compositor::End> Compositor::ended() { return loop_->report.lock()->end; }

} // namespace arift
