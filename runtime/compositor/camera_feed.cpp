#include "runtime/compositor/camera_feed.h"
#include <algorithm>
#include <vector>

namespace arift
{

namespace
{

XrDuration atRank(std::vector<XrDuration> values, double share)
{
	const auto place = values.begin() + std::min(ptrdiff_t(share * double(values.size())), ptrdiff_t(values.size()) - 1);
	std::nth_element(values.begin(), place, values.end());
	return *place;
}

} // namespace

void CameraTimingEstimate::add(uint64_t sequence, XrTime midExposure, XrTime usable)
{
	if (!images_.empty() && (sequence <= images_.back().sequence || midExposure <= images_.back().midExposure))
		images_.clear(); // restarted
	images_.push_back({sequence, midExposure, usable - midExposure});
	if (images_.size() > kept) images_.pop_front();
}

ipc::CameraTiming CameraTimingEstimate::timing() const
{
	if (images_.size() < 2) return {};
	std::vector<XrDuration> periods, offsets, delays;
	const size_t half = images_.size() / 2; // far pairs: jitter is divided by the number of periods between them
	for (size_t i = half; i < images_.size(); ++i)
		periods.push_back((images_[i].midExposure - images_[i - half].midExposure) /
						  XrDuration(images_[i].sequence - images_[i - half].sequence));
	const XrDuration period = atRank(periods, 0.5);
	const Image &newest = images_.back();
	// Every image says when the newest was taken if all were taken on the beat: the middle one of these is the most credible.
	for (const Image &image : images_) {
		offsets.push_back(image.midExposure + XrDuration(newest.sequence - image.sequence) * period - newest.midExposure);
		delays.push_back(image.delay);
	}
	return {newest.midExposure + atRank(offsets, 0.5), period, atRank(delays, 0.9)};
}

void CameraFeed::put(CameraImage image, XrTime usable)
{
	std::optional<CameraImage> before; // goes back to its driver when the lock is gone
	state_.update([&](State &state) {
		state.estimate.add(image.frame.sequence, image.frame.midExposure, usable);
		before = std::exchange(state.newest, std::move(image));
		state.received++;
	});
}

void CameraFeed::lose()
{
	state_.update([](State &state) {
		state.newest.reset();
		state.estimate = {};
	});
}

std::optional<CameraImage> CameraFeed::newest() { return state_.lock()->newest; }
ipc::CameraTiming CameraFeed::timing() { return state_.lock()->estimate.timing(); }
uint64_t CameraFeed::received() { return state_.lock()->received; }

} // namespace arift
