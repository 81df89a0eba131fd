// What the compositor knows of the images it showed: the figures a person judges the system by. Counted at the panel, not by applications.
#pragma once
#include "runtime/base/xr.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace arift
{

/// One image that reached the panel.
struct ShownFrame {
	XrTime displayTime = 0;                             ///< of the middle line
	XrDuration period = 0;                              ///< of the display, as measured then
	std::array<std::optional<XrDuration>, 2> cameraAge; ///< from mid-exposure until displayTime; nothing without a camera image
	std::optional<XrDuration> poseAge;                  ///< from the newest sample used until displayTime
	XrDuration composeCost = 0;                         ///< real time from latching the inputs until the image was finished
};

struct Figure {
	double median = 0, p99 = 0; ///< milliseconds
};

struct FrameFigures {
	uint64_t shown = 0;
	uint64_t missed = 0;  ///< refreshes for which no new image was there
	double perSecond = 0; ///< shown per second of the system's clock
	Figure cameraAge, poseAge, compose;
	double cpuSeconds = 0; ///< of the whole process since the last reset; filled in by who asks
};

/// The last `kept` frames and the totals since reset(). Not thread-safe.
class FrameRecord
{
public:
	static constexpr size_t kept = 4096;
	void add(const ShownFrame &frame);
	void reset() { *this = FrameRecord(); }
	FrameFigures figures() const;

private:
	std::vector<ShownFrame> frames_; ///< a ring once it is full: frame n of the record lies in slot n % kept
	uint64_t shown_ = 0, missed_ = 0;
	XrTime first_ = 0, last_ = 0;
};

} // namespace arift
