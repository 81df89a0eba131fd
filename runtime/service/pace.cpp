#include "runtime/service/pace.h"
#include <algorithm>
#include <numeric>

namespace arift
{

namespace
{

/// The longest of several intervals says nothing of those to come: a machine that stood still for a moment.
constexpr size_t several = 8;
/// Refreshes for an image up to which it counts as one.
constexpr double hardly = 1.25;

} // namespace

void Pace::offer(XrTime display, XrDuration refresh)
{
	if (newest_ != 0 && display > newest_) intervals_[count_++ % kept] = display - newest_;
	newest_ = std::max(newest_, display);
	refresh_ = refresh;
}

XrDuration Pace::period() const
{
	const size_t size = std::min(count_, kept), usual = size - (size >= several ? 1 : 0);
	if (usual == 0) return refresh_;
	std::array<XrDuration, kept> sorted = intervals_;
	std::sort(sorted.begin(), sorted.begin() + ptrdiff_t(size));
	const XrDuration mean = std::accumulate(sorted.begin(), sorted.begin() + ptrdiff_t(usual), XrDuration{0}) / XrDuration(usual);
	return double(mean) < hardly * double(refresh_) ? refresh_ : mean;
}

} // namespace arift
