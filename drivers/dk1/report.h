// The DK1 tracker's input report 1: 62 bytes on the wire <-> numbers, and the decoder that turns a stream of them into ImuReports.
// Source: Oculus' released tracker firmware (data_packet.c) and TrackerFirmwareSpecification 0.20.
#pragma once
#include "runtime/device/imu_tracker.h"
#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace arift::dk1
{

constexpr size_t inputReportSize = 62;
constexpr size_t paddedReportSize = 64;        ///< as some hosts deliver it
constexpr double unit = 1e-4;                  ///< of a count: m/s^2, rad/s, gauss
constexpr int32_t packedLimit = (1 << 20) - 1; ///< largest value of a 21-bit field
constexpr uint8_t maxSampleCount = 254;

using Counts = std::array<int32_t, 3>; ///< x right, y up, z back

struct RawSample {
	Counts acceleration{}; ///< specific force
	Counts angularVelocity{};
};

/// Input report 1 as it is sent.
struct InputReport {
	uint8_t sampleCount = 0;  ///< 1 to 254; with more than 3, samples[0] is the mean of all but the newest two
	uint16_t timestamp = 0;   ///< data-ready tick of the first sample, about 1 ms each, wraps
	uint16_t lastCommand = 0; ///< id of the last feature report that was set
	int16_t temperature = 0;  ///< 0.01 degrees Celsius
	std::array<RawSample, 3> samples{};
	std::array<int16_t, 3> magnetometer{}; ///< in the order of the wire: x, z, y
};

/// Three 21-bit two's complement numbers, most significant bit first; the last bit is unused.
Counts unpackCounts(std::span<const std::byte, 8> bytes);
void packCounts(const Counts &counts, std::span<std::byte, 8> bytes);

/// Nothing where the bytes are no such report: wrong length, wrong id, impossible sample count.
std::optional<InputReport> parseInputReport(std::span<const std::byte> bytes);
std::array<std::byte, inputReportSize> packInputReport(const InputReport &report);

/// Reports -> samples with unwrapped ticks. After a start the stream holds a stale report and a backlog whose mean the firmware spoils,
/// so nothing is delivered until two short reports have followed each other without a gap.
class ReportDecoder
{
public:
	/// Says whether `report` was filled. Malformed reports are counted and dropped.
	bool decode(std::span<const std::byte> bytes, XrTime arrival, ImuReport &report);
	uint64_t malformed() const { return malformed_; }

private:
	struct Last {
		uint16_t timestamp = 0;
		uint8_t sampleCount = 0;
		XrTime arrival = 0;
	};
	bool beganAnew(int64_t firstTick, XrTime arrival) const;
	void follow(const InputReport &raw, XrTime arrival, int64_t firstTick);
	void fill(const InputReport &raw, XrTime arrival, int64_t firstTick, uint32_t lost, ImuReport &report) const;

	std::optional<Last> last_;
	int64_t nextTick_ = 0;    ///< that of the next sample when nothing is lost
	XrDuration earliest_ = 0; ///< least (arrival - tick) seen: no report can come before it was measured
	bool delivering_ = false;
	uint64_t malformed_ = 0;
};

} // namespace arift::dk1
