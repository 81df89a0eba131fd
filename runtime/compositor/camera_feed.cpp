#include "runtime/compositor/camera_feed.h"
#include <algorithm>
#include <cmath>
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
	const Image &newest = images_.back();
	std::vector<XrDuration> delays;
	for (const Image &image : images_) delays.push_back(image.delay);
	const Beat line = beat();
	return {newest.midExposure + XrDuration(line.offset), XrDuration(line.period), atRank(delays, 0.9)};
}

XrTime CameraTimingEstimate::midExposure() const
{
	const Image &newest = images_.back();
	if (images_.size() < enough) return newest.midExposure;
	const Beat line = beat();
	const bool isJitter = std::abs(line.offset) <= 6 * usualDistance(newest, line); // four standard deviations
	return newest.midExposure + (isJitter ? XrDuration(line.offset) : 0);
}

double CameraTimingEstimate::distance(const Image &image, const Image &newest, const Beat &beat)
{
	return std::abs(double(image.midExposure - newest.midExposure) - beat.offset + beat.period * double(newest.sequence - image.sequence));
}

double CameraTimingEstimate::usualDistance(const Image &newest, const Beat &beat) const
{
	std::vector<XrDuration> distances;
	for (const Image &image : images_) distances.push_back(XrDuration(distance(image, newest, beat)));
	return double(atRank(distances, 0.5)) + 1000;
}

/// Straight line through (sequence, mid-exposure), both counted from the newest image; images further than three times the usual
/// distance from `before` (where there is one) take no part.
CameraTimingEstimate::Beat CameraTimingEstimate::leastSquares(const Image &newest, std::optional<Beat> before) const
{
	const auto at = [&](const Image &image) { return -double(newest.sequence - image.sequence); };
	const auto time = [&](const Image &image) { return double(image.midExposure - newest.midExposure); };
	const double usual = before ? usualDistance(newest, *before) : 0;
	double n = 0, x = 0, y = 0, xx = 0, xy = 0;
	for (const Image &image : images_) {
		if (before && distance(image, newest, *before) > 3 * usual) continue;
		n += 1, x += at(image), y += time(image), xx += at(image) * at(image), xy += at(image) * time(image);
	}
	const double spread = n * xx - x * x;
	if (spread <= 0) return *before; // one image alone agrees with the line: keep it
	const double period = (n * xy - x * y) / spread;
	return {period, (y - period * x) / n};
}

void CameraFeed::put(CameraImage image, XrTime usable)
{
	std::optional<CameraImage> before; // goes back to its driver when the lock is gone
	state_.update([&](State &state) {
		state.estimate.add(image.frame.sequence, image.frame.midExposure, usable);
		state.timing = state.estimate.timing();
		image.frame.midExposure = state.estimate.midExposure();
		before = std::exchange(state.newest, std::move(image));
		state.received++;
	});
}

void CameraFeed::lose()
{
	state_.update([](State &state) {
		state.newest.reset();
		state.estimate = {};
		state.timing = {};
	});
}

std::optional<CameraImage> CameraFeed::newest() { return state_.lock()->newest; }
ipc::CameraTiming CameraFeed::timing() { return state_.lock()->timing; }
uint64_t CameraFeed::received() { return state_.lock()->received; }

} // namespace arift
