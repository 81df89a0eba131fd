// A stream of tracker reports. Input: for each report one byte of milliseconds since the one before, then 62 bytes.
#include "drivers/dk1/report.h"
#include "tests/fuzz/input.h"
#include <cmath>

using namespace arift;

namespace
{

constexpr XrDuration millisecondsOf(uint8_t value) { return XrDuration(value) * 1'000'000; }

void checkSample(const ImuSample &sample, int64_t &lastTick)
{
	fuzz::require(sample.ticks >= 1 && sample.ticks <= 254, "a sample stands for 1 to 254 ticks");
	fuzz::require(sample.tick > lastTick, "ticks rise");
	lastTick = sample.tick;
	constexpr float largest = float(dk1::packedLimit + 1) * float(dk1::unit) * 1.001f;
	for (const float value : {sample.angularVelocity.x, sample.angularVelocity.y, sample.angularVelocity.z, sample.acceleration.x,
							  sample.acceleration.y, sample.acceleration.z})
		fuzz::require(std::abs(value) <= largest, "a component is within 21 bits");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	dk1::ReportDecoder decoder;
	XrTime arrival = 1'000'000'000;
	int64_t lastTick = INT64_MIN;
	uint64_t malformed = 0;
	while (size > 0) {
		arrival += millisecondsOf(*data++);
		--size;
		const size_t length = std::min(size, dk1::inputReportSize);
		const std::span bytes(reinterpret_cast<const std::byte *>(data), length);
		if (const auto parsed = dk1::parseInputReport(bytes)) {
			const auto again = dk1::parseInputReport(dk1::packInputReport(*parsed));
			fuzz::require(again && dk1::packInputReport(*again) == dk1::packInputReport(*parsed), "packing and parsing are inverse");
		}
		ImuReport report;
		if (decoder.decode(bytes, arrival, report)) {
			fuzz::require(report.sampleCount >= 1 && report.sampleCount <= 3, "a report has 1 to 3 samples");
			fuzz::require(report.arrival == arrival, "a report keeps its arrival");
			for (uint32_t i = 0; i < report.sampleCount; ++i) checkSample(report.samples[i], lastTick);
		}
		fuzz::require(decoder.malformed() >= malformed, "the count of malformed reports never falls");
		malformed = decoder.malformed();
		data += length;
		size -= length;
	}
	return 0;
}
