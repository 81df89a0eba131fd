// A camera whose images are made (drawn, or read from files) on a timetable instead of received: what the simulated and the replayed
// cameras share. An image is made before the time at which it becomes available, so that its cost does not delay it.
#pragma once
#include "drivers/frame_pool.h"
#include "runtime/device/camera.h"
#include <optional>

namespace arift
{

/// Where a PlayedCamera's images come from. Thread-bound.
class ImageSource
{
public:
	struct Timing {
		XrTime midExposure = 0; ///< as the frame shall say; may be wrong on purpose
		XrDuration exposure = 0;
		XrTime arrival = 0; ///< when the host has the image; rises with the sequence
	};

	virtual ~ImageSource() = default;
	/// What never changes; the counters are PlayedCamera's.
	virtual CameraInfo info() const = 0;
	/// Nothing where there is no such image: the source has ended.
	virtual std::optional<Timing> timing(uint64_t sequence) const = 0;
	/// Fills width * height pixels without padding; false when the image is damaged.
	virtual bool make(uint64_t sequence, std::span<std::byte> pixels) = 0;
};

class PlayedCamera final : public Camera
{
public:
	/// The first image is the first that arrives after now. `clock` outlives this.
	PlayedCamera(Clock &clock, std::unique_ptr<ImageSource> source, const FrameAllocator &allocate);

	CameraInfo info() const override;
	Outcome read(CameraFrame &frame, XrTime deadline, std::stop_token stop) override;

private:
	void skipTo(XrTime now);
	bool makeNext();

	static constexpr size_t bufferCount = 6;

	Clock &clock_;
	std::unique_ptr<ImageSource> source_;
	CameraInfo info_;
	FramePool pool_;
	uint64_t next_ = 0;                 ///< sequence of the image to deliver next
	std::shared_ptr<FrameBuffer> made_; ///< holds image next_ when not null
};

} // namespace arift
