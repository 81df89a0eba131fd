// One camera as the compositor sees it: its newest image, and when the next ones will be there.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/device/camera.h"
#include "runtime/ipc/pages.h"
#include <deque>
#include <optional>

namespace arift
{

/// Mid-exposures and arrivals of recent images -> when images are taken and usable. Robust against single late or mistimed ones. Pure.
class CameraTimingEstimate
{
public:
	void add(uint64_t sequence, XrTime midExposure, XrTime usable);
	/// period 0 until two images are known.
	ipc::CameraTiming timing() const;
	/// Of the newest image: where the line through its predecessors and itself says, as long as it lies no further from that than jitter
	/// like theirs explains, for a camera's clock is steadier than the times at which a host hears of it. As told where it does, or of few
	/// images.
	XrTime midExposure() const;

private:
	static constexpr size_t kept = 31, enough = 8;
	struct Image {
		uint64_t sequence;
		XrTime midExposure;
		XrDuration delay;
	};
	/// A straight line through the images: nanoseconds, from the newest image's mid-exposure and from image to image.
	struct Beat {
		double period, offset;
	};
	/// How far (ns) an image's mid-exposure lies from the line, whatever its side.
	static double distance(const Image &image, const Image &newest, const Beat &beat);
	double usualDistance(const Image &newest, const Beat &beat) const;
	/// Without those that are mistimed.
	Beat beat() const { return leastSquares(images_.back(), leastSquares(images_.back(), std::nullopt)); }
	Beat leastSquares(const Image &newest, std::optional<Beat> before) const;

	std::deque<Image> images_;
};

/// An image, and how its camera's raw values are to be read (as in CameraInfo).
struct CameraImage {
	CameraFrame frame;
	double blackLevel = 0;
	std::array<float, 3> whiteBalance{1, 1, 1};
	bool linear = true;
};

/// Thread-safe: one camera thread puts, the compositor takes.
class CameraFeed
{
public:
	/// `usable` is when the image was handed over. Its time becomes CameraTimingEstimate::midExposure().
	void put(CameraImage image, XrTime usable);
	/// The camera is gone: no image is the newest until one comes again.
	void lose();
	std::optional<CameraImage> newest();
	ipc::CameraTiming timing();
	uint64_t received();

private:
	struct State {
		std::optional<CameraImage> newest;
		CameraTimingEstimate estimate;
		ipc::CameraTiming timing; ///< of the estimate: asked for in every refresh
		uint64_t received = 0;
	};
	Guarded<State> state_;
};

} // namespace arift
