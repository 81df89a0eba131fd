#include "runtime/compositor/frame_record.h"
#include <algorithm>
#include <cmath>

namespace arift
{

namespace
{

/// Nearest rank: the smallest value that at least this share of all values does not exceed.
double rank(const std::vector<double> &sorted, double share)
{
	const size_t index = size_t(std::max(std::ceil(share * double(sorted.size())), 1.0)) - 1;
	return sorted[std::min(index, sorted.size() - 1)];
}

Figure figureOf(std::vector<double> values)
{
	if (values.empty()) return {};
	std::ranges::sort(values);
	return {rank(values, 0.5), rank(values, 0.99)};
}

double inMilliseconds(XrDuration duration) { return double(duration) * 1e-6; }

} // namespace

void FrameRecord::add(const ShownFrame &frame)
{
	if (shown_ == 0) {
		first_ = frame.displayTime;
	} else if (frame.period > 0) {
		const double refreshes = std::round(double(frame.displayTime - last_) / double(frame.period));
		if (refreshes > 1) missed_ += uint64_t(refreshes) - 1;
	}
	last_ = frame.displayTime;
	if (frames_.size() < kept)
		frames_.push_back(frame);
	else
		frames_[shown_ % kept] = frame;
	shown_++;
}

FrameFigures FrameRecord::figures() const
{
	std::vector<double> cameraAges, poseAges, costs;
	for (const ShownFrame &frame : frames_) {
		for (const auto &age : frame.cameraAge)
			if (age) cameraAges.push_back(inMilliseconds(*age));
		if (frame.poseAge) poseAges.push_back(inMilliseconds(*frame.poseAge));
		costs.push_back(inMilliseconds(frame.composeCost));
	}
	FrameFigures figures{.shown = shown_, .missed = missed_};
	if (last_ > first_) figures.perSecond = double(shown_ - 1) / inSeconds(last_ - first_);
	figures.cameraAge = figureOf(std::move(cameraAges));
	figures.poseAge = figureOf(std::move(poseAges));
	figures.compose = figureOf(std::move(costs));
	return figures;
}

} // namespace arift
