#include "drivers/played_camera.h"

namespace arift
{

PlayedCamera::PlayedCamera(Clock &clock, std::unique_ptr<ImageSource> source, const FrameAllocator &allocate)
	: clock_(clock),
	  source_(std::move(source)),
	  info_(source_->info()),
	  pool_(allocate, bufferCount, size_t(info_.width) * info_.height * bytesPerPixel(info_.format))
{
	skipTo(clock_.now());
	if (const auto timing = source_->timing(next_); timing && timing->arrival <= clock_.now()) next_++;
	info_.dropped = 0;
}

CameraInfo PlayedCamera::info() const { return info_; }

/// Moves on to the newest image that has arrived, if any has; those passed over are dropped.
void PlayedCamera::skipTo(XrTime now)
{
	for (auto following = source_->timing(next_ + 1); following && following->arrival <= now; following = source_->timing(next_ + 1)) {
		next_++;
		info_.dropped++;
		made_.reset();
	}
}

/// Damaged images and those without a free buffer are passed over; false: none was made this time.
bool PlayedCamera::makeNext()
{
	if (made_) return true;
	auto buffer = pool_.lend();
	if (!buffer) {
		info_.dropped++;
	} else if (!source_->make(next_, buffer->bytes().first(size_t(info_.width) * info_.height * bytesPerPixel(info_.format)))) {
		info_.malformed++;
	} else {
		made_ = std::move(buffer);
	}
	return made_ != nullptr;
}

Outcome PlayedCamera::read(CameraFrame &frame, XrTime deadline, std::stop_token stop)
{
	for (;;) {
		skipTo(clock_.now());
		const auto timing = source_->timing(next_);
		if (!timing) return Outcome::lost;
		const bool isMade = makeNext();
		const bool isDue = clock_.sleepUntil(std::min(timing->arrival, deadline), stop);
		if (!isDue || timing->arrival > deadline || stop.stop_requested()) return Outcome::timeout;
		if (!isMade) {
			next_++;
			continue;
		}
		frame = {.midExposure = timing->midExposure,
				 .exposure = timing->exposure,
				 .arrival = timing->arrival,
				 .sequence = next_,
				 .format = info_.format,
				 .width = info_.width,
				 .height = info_.height,
				 .stride = info_.width * bytesPerPixel(info_.format),
				 .buffer = std::exchange(made_, nullptr)};
		next_++;
		return Outcome::ready;
	}
}

} // namespace arift
