#include "drivers/dk1/report.h"
#include "drivers/dk1/bytes.h"
#include "runtime/base/pose.h"
#include <algorithm>

namespace arift::dk1
{

namespace
{

constexpr XrDuration tickPeriod = millisecond;
/// A pause as long as this is a restart: the mapping of ticks to host time has drifted away, and wraps may have been missed.
constexpr XrDuration longestPause = 30 * second;
/// How far ahead of the host's clock ticks may seem to run before the counter must have been reset; oscillators differ by a per cent at
/// most.
constexpr XrDuration resetTolerance = 200 * millisecond;
constexpr int64_t driftDivisor = 50;

constexpr int32_t signExtend21(uint32_t value) { return int32_t(value << 11) >> 11; }

XrVector3f scaled(const Counts &counts) { return {float(counts[0] * unit), float(counts[1] * unit), float(counts[2] * unit)}; }

bool isZero(const RawSample &sample) { return sample.acceleration == Counts{} && sample.angularVelocity == Counts{}; }

} // namespace

Counts unpackCounts(std::span<const std::byte, 8> bytes)
{
	const auto at = [&](size_t i) { return std::to_integer<uint32_t>(bytes[i]); };
	return {signExtend21(at(0) << 13 | at(1) << 5 | at(2) >> 3), signExtend21((at(2) & 7) << 18 | at(3) << 10 | at(4) << 2 | at(5) >> 6),
			signExtend21((at(5) & 0x3f) << 15 | at(6) << 7 | at(7) >> 1)};
}

void packCounts(const Counts &counts, std::span<std::byte, 8> bytes)
{
	uint64_t packed = 0;
	for (const int32_t count : counts) packed = packed << 21 | (uint32_t(count) & 0x1fffff);
	packed <<= 1;
	for (int i = 7; i >= 0; packed >>= 8) bytes[size_t(i--)] = std::byte(packed & 0xff);
}

std::optional<InputReport> parseInputReport(std::span<const std::byte> bytes)
{
	if (bytes.size() != inputReportSize && bytes.size() != paddedReportSize) return std::nullopt;
	if (bytes[0] != std::byte{1}) return std::nullopt;
	InputReport report;
	report.sampleCount = std::to_integer<uint8_t>(bytes[1]);
	if (report.sampleCount < 1 || report.sampleCount > maxSampleCount) return std::nullopt;
	report.timestamp = read16(bytes, 2);
	report.lastCommand = read16(bytes, 4);
	report.temperature = int16_t(read16(bytes, 6));
	for (size_t i = 0; i < 3; i++) {
		report.samples[i].acceleration = unpackCounts(bytes.subspan(8 + 16 * i).first<8>());
		report.samples[i].angularVelocity = unpackCounts(bytes.subspan(16 + 16 * i).first<8>());
		report.magnetometer[i] = int16_t(read16(bytes, 56 + 2 * i));
	}
	return report;
}

std::array<std::byte, inputReportSize> packInputReport(const InputReport &report)
{
	std::array<std::byte, inputReportSize> bytes{};
	const std::span<std::byte> all(bytes);
	bytes[0] = std::byte{1};
	bytes[1] = std::byte(report.sampleCount);
	write16(all, 2, report.timestamp);
	write16(all, 4, report.lastCommand);
	write16(all, 6, uint16_t(report.temperature));
	for (size_t i = 0; i < 3; i++) {
		packCounts(report.samples[i].acceleration, all.subspan(8 + 16 * i).first<8>());
		packCounts(report.samples[i].angularVelocity, all.subspan(16 + 16 * i).first<8>());
		write16(all, 56 + 2 * i, uint16_t(report.magnetometer[i]));
	}
	return bytes;
}

bool ReportDecoder::decode(std::span<const std::byte> bytes, XrTime arrival, ImuReport &report)
{
	const auto raw = parseInputReport(bytes);
	if (!raw || (last_ && last_->timestamp == raw->timestamp && last_->sampleCount == raw->sampleCount)) {
		malformed_++; // the second case: the same report twice
		return false;
	}
	const bool isShort = raw->sampleCount <= 3;
	const uint32_t lost = last_ ? uint16_t(raw->timestamp - last_->timestamp - last_->sampleCount) : 0;
	const int64_t firstTick = nextTick_ + lost;
	if (!last_ || arrival - last_->arrival > longestPause || beganAnew(firstTick, arrival)) {
		last_.reset();
		delivering_ = false;
		follow(*raw, arrival, nextTick_ + 1); // ticks never fall, not even over a restart
		return false;
	}
	const bool followsShort = last_->sampleCount <= 3;
	follow(*raw, arrival, firstTick);
	if (!delivering_ && !(isShort && followsShort && lost == 0)) return false;
	fill(*raw, arrival, firstTick, delivering_ ? lost : 0, report);
	report.restarted = !std::exchange(delivering_, true);
	return true;
}

bool ReportDecoder::beganAnew(int64_t firstTick, XrTime arrival) const
{
	const XrDuration slack = resetTolerance + (arrival - last_->arrival) / driftDivisor;
	return arrival - firstTick * tickPeriod < earliest_ - slack;
}

void ReportDecoder::follow(const InputReport &raw, XrTime arrival, int64_t firstTick)
{
	const XrDuration offset = arrival - firstTick * tickPeriod;
	const XrDuration drift = last_ ? (arrival - last_->arrival) / driftDivisor : 0;
	earliest_ = last_ ? std::min(offset, earliest_ + drift) : offset;
	nextTick_ = firstTick + raw.sampleCount;
	last_ = Last{raw.timestamp, raw.sampleCount, arrival};
}

void ReportDecoder::fill(const InputReport &raw, XrTime arrival, int64_t firstTick, uint32_t lost, ImuReport &report) const
{
	report = {};
	report.arrival = arrival;
	report.temperature = float(raw.temperature) * 0.01f;
	report.lostTicks = lost;
	// The magnetometer's registers are ordered x, z, y. 1e-4 gauss = 1e-8 tesla. Its sign is left as the device has it.
	report.magneticField = XrVector3f{raw.magnetometer[0] * 1e-8f, raw.magnetometer[2] * 1e-8f, raw.magnetometer[1] * 1e-8f};

	const int32_t merged = std::max(1, int32_t(raw.sampleCount) - 2); // ticks that samples[0] stands for
	const int count = std::min<int>(raw.sampleCount, 3);
	// When nobody fetched reports for 254 ticks the firmware overflows: it begins again with a zero in samples[0] that spoils the mean.
	const bool overflowed = lost > 0 && (raw.sampleCount > 3 || (count == 3 && isZero(raw.samples[0])));
	if (overflowed) report.lostTicks += uint32_t(merged);
	for (int i = overflowed ? 1 : 0; i < count; i++) {
		ImuSample &sample = report.samples[report.sampleCount++];
		sample.ticks = i == 0 ? merged : 1;
		sample.tick = firstTick + merged - 1 + i;
		sample.acceleration = scaled(raw.samples[size_t(i)].acceleration);
		sample.angularVelocity = scaled(raw.samples[size_t(i)].angularVelocity);
	}
}

} // namespace arift::dk1
