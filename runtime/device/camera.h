// What a camera is: blocks until the next image and hands out the driver's own buffer, in the camera's own format.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/device/outcome.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace arift
{

/// Pixel layouts as cameras deliver them. Bayer formats are named by the first two pixels of the first row and the row below.
enum class PixelFormat : uint32_t { grey8, grey16, bayerRggb8, bayerGrbg8, bayerGbrg8, bayerBggr8 };

constexpr bool isBayer(PixelFormat format) { return format >= PixelFormat::bayerRggb8; }
constexpr uint32_t bytesPerPixel(PixelFormat format) { return format == PixelFormat::grey16 ? 2 : 1; }

/// Memory an image can lie in. The consumer may provide memory that its GPU reads directly; a driver fills it and knows no more.
class FrameBuffer
{
public:
	virtual ~FrameBuffer() = default;
	virtual std::span<std::byte> bytes() = 0;
};
/// Makes buffers for a camera that can fill memory of ours. Called when the camera opens, never per frame.
using FrameAllocator = std::function<std::shared_ptr<FrameBuffer>(size_t bytes)>;
/// Plain host memory.
std::shared_ptr<FrameBuffer> makeHostFrameBuffer(size_t bytes);

/// One image. Holds its buffer until the last copy of this value is gone; the driver then fills it again.
struct CameraFrame {
	XrTime midExposure = 0;  ///< the instant the image shows
	XrDuration exposure = 0; ///< how long light was gathered
	XrTime arrival = 0;      ///< when the host had it
	uint64_t sequence = 0;   ///< counts every image the camera took, lost ones included
	PixelFormat format = PixelFormat::grey8;
	uint32_t width = 0, height = 0;
	uint32_t stride = 0;                 ///< bytes from row to row
	std::shared_ptr<FrameBuffer> buffer; ///< rows from its first byte on; the type tells the consumer whose memory it is
};

struct CameraInfo {
	std::string name; ///< for people
	uint32_t width = 0, height = 0;
	PixelFormat format = PixelFormat::grey8;
	double frameRate = 0;                       ///< images per second
	double blackLevel = 0;                      ///< raw value of darkness, 0..1 of full scale
	std::array<float, 3> whiteBalance{1, 1, 1}; ///< gains that make grey grey, for raw colour
	bool linear = true;                         ///< raw values are proportional to light; otherwise sRGB encoded
	uint64_t dropped = 0;                       ///< images known to be lost so far
	uint64_t malformed = 0;                     ///< images dropped because they were short, torn or of the wrong size
};

class Camera
{
public:
	virtual ~Camera() = default;
	virtual CameraInfo info() const = 0;
	/// Thread-bound. Blocks until an image newer than the last is there, `deadline` has come or stop is requested (both: timeout).
	/// Skips to the newest image; those skipped are counted as dropped.
	virtual Outcome read(CameraFrame &frame, XrTime deadline, std::stop_token stop) = 0;
};

} // namespace arift
