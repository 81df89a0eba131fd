#include "runtime/compositor/frame_record.h"
#include <algorithm>
#include <cmath>

namespace arift
{

namespace
{

/// Nearest rank: the smallest value that at least this share of all values does not exceed.
double rank(const std::vector<XrDuration> &sorted, double share)
{
	const size_t index = size_t(std::max(std::ceil(share * double(sorted.size())), 1.0)) - 1;
	return double(sorted[std::min(index, sorted.size() - 1)]) * 1e-6;
}

} // namespace

Figure figureOf(std::vector<XrDuration> durations)
{
	if (durations.empty()) return {};
	std::ranges::sort(durations);
	return {rank(durations, 0.5), rank(durations, 0.99)};
}

void FrameRecord::add(const ShownFrame &frame)
{
	if (totals_.shown == 0) {
		totals_.first = frame.displayTime;
	} else if (frame.period > 0) {
		const XrDuration gap = frame.displayTime - totals_.last;
		const double refreshes = std::round(double(gap) / double(frame.period));
		if (refreshes > 1) totals_.missed += uint64_t(refreshes) - 1;
		if (gap > frame.period * 3 / 2) totals_.gaps++;
		totals_.longestGap = std::max(totals_.longestGap, gap);
	}
	totals_.last = frame.displayTime;
	totals_.leftOut = frame.leftOut;
	if (!frame.cameraAge[0] || !frame.cameraAge[1]) totals_.withoutCamera++;
	if (frames_.size() < kept)
		frames_.push_back(frame);
	else
		frames_[totals_.shown % kept] = frame;
	totals_.shown++;
}

void FrameRecord::reset()
{
	frames_.clear();
	totals_ = {};
}

FrameFigures FrameRecord::figures() const
{
	std::vector<XrDuration> cameraAges, poseAges, costs;
	std::array<std::vector<XrDuration>, frameStageNames.size()> stages;
	for (const ShownFrame &frame : frames_) {
		for (const auto &age : frame.cameraAge)
			if (age) cameraAges.push_back(*age);
		if (frame.poseAge) poseAges.push_back(*frame.poseAge);
		costs.push_back(frame.composeCost);
		for (size_t stage = 0; stage < stages.size(); ++stage) stages[stage].push_back(frame.stages[stage]);
	}
	FrameFigures figures{.shown = totals_.shown,
						 .missed = totals_.missed,
						 .gaps = totals_.gaps,
						 .longestGap = double(totals_.longestGap) * 1e-6,
						 .withoutCamera = totals_.withoutCamera,
						 .leftOut = totals_.leftOut};
	if (totals_.last > totals_.first) figures.perSecond = double(totals_.shown - 1) / inSeconds(totals_.last - totals_.first);
	figures.cameraAge = figureOf(std::move(cameraAges));
	figures.poseAge = figureOf(std::move(poseAges));
	figures.compose = figureOf(std::move(costs));
	for (size_t stage = 0; stage < stages.size(); ++stage) figures.stages[stage] = figureOf(std::move(stages[stage]));
	return figures;
}

} // namespace arift
