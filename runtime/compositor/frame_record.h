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

/// What the compositor's thread does for an image, one after the other.
enum class FrameStage : size_t {
	wake,   ///< how much later than planned the thread woke
	choose, ///< takes the newest of everything and places it; wakes applications
	plan,   ///< what is drawn where
	upload, ///< camera images that are new
	record, ///< the command buffer
	draw,   ///< submitted, until the GPU has finished
	present ///< handed to the target
};
constexpr std::array frameStageNames{"wake", "choose", "plan", "upload", "record", "draw", "present"};
using StageTimes = std::array<XrDuration, frameStageNames.size()>; ///< real time

/// One image that reached the panel.
struct ShownFrame {
	XrTime displayTime = 0;                             ///< of the middle line
	XrDuration period = 0;                              ///< of the display, as measured then
	std::array<std::optional<XrDuration>, 2> cameraAge; ///< from mid-exposure until displayTime; nothing without a camera image
	std::optional<XrDuration> poseAge;                  ///< from the newest sample used until displayTime
	XrDuration composeCost = 0;                         ///< real time from latching the inputs until the image was finished
	StageTimes stages{};
	uint32_t leftOut = 0; ///< PanelRenderer::Cost
};

struct Figure {
	double median = 0, p99 = 0; ///< milliseconds
};
/// Of durations in any order.
Figure figureOf(std::vector<XrDuration> durations);

struct FrameFigures {
	uint64_t shown = 0;
	uint64_t missed = 0;        ///< refreshes for which no new image was there
	double perSecond = 0;       ///< shown per second of the system's clock
	uint64_t gaps = 0;          ///< times that more than one and a half periods lay between two images
	double longestGap = 0;      ///< milliseconds
	uint64_t withoutCamera = 0; ///< images in which an eye saw no camera's image
	uint32_t leftOut = 0;       ///< draws that the newest image lacks because their pipelines are not made yet
	Figure cameraAge, poseAge, compose;
	std::array<Figure, frameStageNames.size()> stages;
	double cpuSeconds = 0; ///< of the whole process since the last reset; filled in by who asks
};

/// The last `kept` frames and the totals since reset(). Not thread-safe. Only the constructor allocates memory.
class FrameRecord
{
public:
	static constexpr size_t kept = 2048;
	FrameRecord() { frames_.reserve(kept); }
	void add(const ShownFrame &frame);
	void reset();
	/// Sorts: not for the compositor's thread, nor while it waits for a lock.
	FrameFigures figures() const;

private:
	struct Totals {
		uint64_t shown = 0, missed = 0, gaps = 0, withoutCamera = 0;
		uint32_t leftOut = 0;
		XrTime first = 0, last = 0;
		XrDuration longestGap = 0;
	};
	std::vector<ShownFrame> frames_; ///< a ring once it is full: frame n of the record lies in slot n % kept
	Totals totals_;
};

} // namespace arift
