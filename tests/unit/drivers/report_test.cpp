// The DK1's input report: every published vector, and what the decoder makes of a stream.
#include "drivers/dk1/report.h"
#include "tests/unit/drivers/support.h"
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::dk1;

namespace
{

struct Vector {
	const char *name, *hex;
	uint8_t count;
	uint16_t timestamp, command;
	int16_t temperature;
	Counts acceleration[3], angularVelocity[3];
	std::array<int16_t, 3> field;
};

#define ZEROS_16 " 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"
// The first four were captured from a device that speaks the DK1's protocol; S1 to S4 are built by its rules.
const Vector vectors[] = {
	{"clone 1",
	 "01 01 01 00 00 00 60 09 ff ce ff b9 84 02 33 e0 00 04 3f ff cc 40 00 88" ZEROS_16 ZEROS_16 " a9 fe 9c 17 b4 fb",
	 1,
	 1,
	 0,
	 2400,
	 {{-1569, -72176, 72176}},
	 {{135, -207, 68}},
	 {-343, 6044, -1100}},
	{"clone 15000",
	 "01 01 98 3a 00 00 60 09 00 00 07 b9 84 02 27 9e 00 02 bf ff d1 40 01 14" ZEROS_16 ZEROS_16 " 7c fe 70 17 b4 fb",
	 1,
	 15000,
	 0,
	 2400,
	 {{0, -72176, 70607}},
	 {{87, -187, 138}},
	 {-388, 6000, -1100}},
	{"clone 30000",
	 "01 01 30 75 00 00 60 09 ff ce ff fc ef 83 29 0c ff fe 77 ff fd 80 00 28" ZEROS_16 ZEROS_16 " 89 ff df fa 4a f1",
	 1,
	 30000,
	 0,
	 2400,
	 {{-1569, -3138, 103558}},
	 {{-50, -10, 20}},
	 {-119, -1313, -3766}},
	{"clone 59999",
	 "01 01 5f ea 00 00 60 09 ff ce ff fe 77 c3 35 4e 00 01 18 00 07 80 01 2a" ZEROS_16 ZEROS_16 " 89 ff d0 fa 4a f1",
	 1,
	 59999,
	 0,
	 2400,
	 {{-1569, -1569, 105127}},
	 {{35, 30, 149}},
	 {-119, -1328, -3766}},
	{"S1 level rest",
	 "01 02 e8 03 00 00 4e 0c 00 00 00 5f c4 c0 00 00 00 00 00 00 00 00 00 00 00 00 60 5f c1 bf ff d0 00 00 5f ff fd 40 00 00" ZEROS_16
	 " b0 04 3c f6 d8 0e",
	 2,
	 1000,
	 0,
	 3150,
	 {{0, 98067, 0}, {12, 98054, -24}},
	 {{0, 0, 0}, {11, -11, 0}},
	 {1200, -2500, 3800}},
	{"S2",
	 "01 01 d2 04 34 12 d0 09 01 38 87 ec 78 00 ea 60 fb 1e 00 30 d4 3e 2b 40" ZEROS_16 ZEROS_16 " d2 04 d7 f6 80 0d",
	 1,
	 1234,
	 0x1234,
	 2512,
	 {{10000, -20000, 30000}},
	 {{-40000, 50000, -60000}},
	 {1234, -2345, 3456}},
	{"S3 wraps inside",
	 "01 03 fe ff 00 00 83 ff 00 00 00 5f c4 c0 00 00 02 21 68 00 00 00 00 00 00 00 00 5f c4 c0 00 00 00 00 00 11 0b 40 00 00 00 00 00 5f "
	 "c4 c0 00 "
	 "00 00 00 00 00 00 00 88 5a 00 00 00 00 00 00",
	 3,
	 65534,
	 0,
	 -125,
	 {{0, 98067, 0}, {0, 98067, 0}, {0, 98067, 0}},
	 {{17453, 0, 0}, {0, 17453, 0}, {0, 0, 17453}},
	 {0, 0, 0}},
	{"S4 backlog",
	 "01 14 fa ff 07 00 b8 0b f4 07 68 00 00 00 00 00 00 00 08 00 00 80 00 06 00 00 00 00 00 02 fe 26 ff ff ff ff ff bf ff fa 7f ff fc 00 "
	 "00 3f ff fe "
	 "7f ff fc 00 00 00 00 00 00 80 ff 7f ff ff",
	 20,
	 65530,
	 7,
	 3000,
	 {{-98067, 0, 0}, {0, 0, 98067}, {1048575, -1048576, -1}},
	 {{1, 2, 3}, {-1, -2, -3}, {1048575, -1048576, 0}},
	 {-32768, 32767, -1}},
};

InputReport reportOf(uint8_t count, uint16_t timestamp, int32_t value = 100)
{
	InputReport report{.sampleCount = count, .timestamp = timestamp};
	for (RawSample &sample : report.samples) sample = {{0, 98067, 0}, {value, 0, 0}};
	return report;
}

/// Feeds reports as they would arrive: `now` after the last tick.
struct Stream {
	ReportDecoder decoder;
	XrTime start = 1000 * second;
	int64_t ticks = 0;
	ImuReport report;

	bool feed(uint8_t count, uint16_t timestamp, int64_t elapsedTicks, int32_t value = 100)
	{
		ticks += elapsedTicks;
		return decoder.decode(packInputReport(reportOf(count, timestamp, value)), start + ticks * millisecond, report);
	}
	/// Two short reports that follow each other: the decoder delivers from the second on.
	void warmUp(uint16_t timestamp)
	{
		EXPECT_FALSE(feed(2, timestamp, 2));
		EXPECT_TRUE(feed(2, uint16_t(timestamp + 2), 2));
		EXPECT_TRUE(report.restarted);
	}
};

} // namespace

TEST(InputReport, DecodesAndEncodesEveryVector)
{
	for (const Vector &vector : vectors) {
		SCOPED_TRACE(vector.name);
		const auto bytes = test::fromHex(vector.hex);
		ASSERT_EQ(bytes.size(), inputReportSize);
		const auto report = parseInputReport(bytes);
		ASSERT_TRUE(report);
		EXPECT_EQ(report->sampleCount, vector.count);
		EXPECT_EQ(report->timestamp, vector.timestamp);
		EXPECT_EQ(report->lastCommand, vector.command);
		EXPECT_EQ(report->temperature, vector.temperature);
		for (size_t i = 0; i < std::min<size_t>(vector.count, 3); i++) {
			EXPECT_EQ(report->samples[i].acceleration, vector.acceleration[i]) << i;
			EXPECT_EQ(report->samples[i].angularVelocity, vector.angularVelocity[i]) << i;
		}
		EXPECT_EQ(report->magnetometer, vector.field);
		const auto packed = packInputReport(*report);
		EXPECT_TRUE(std::equal(packed.begin(), packed.end(), bytes.begin(), bytes.end()));
	}
}

TEST(InputReport, Packs21BitNumbers)
{
	const struct {
		Counts counts;
		const char *hex;
	} cases[] = {{{1, 0, -1}, "00 00 08 00 00 3f ff fe"},
				 {{10000, -20000, 30000}, "01 38 87 ec 78 00 ea 60"},
				 {{0, 98067, 0}, "00 00 00 5f c4 c0 00 00"},
				 {{1048575, -1048576, -1}, "7f ff fc 00 00 3f ff fe"}};
	for (const auto &c : cases) {
		const auto bytes = test::fromHex(c.hex);
		EXPECT_EQ(unpackCounts(std::span(bytes).first<8>()), c.counts) << c.hex;
		std::array<std::byte, 8> packed;
		packCounts(c.counts, packed);
		EXPECT_TRUE(std::equal(packed.begin(), packed.end(), bytes.begin())) << c.hex;
	}
}

TEST(InputReport, MalformedReportsAreCountedAndDropped)
{
	const auto good = packInputReport(reportOf(2, 100));
	std::vector<std::byte> tooShort(good.begin(), good.end() - 1), tooLong(good.begin(), good.end()), wrongId = {good.begin(), good.end()};
	tooLong.resize(63);
	wrongId[0] = std::byte{2};
	auto none = good, tooMany = good;
	none[1] = std::byte{0};
	tooMany[1] = std::byte{255};
	ReportDecoder decoder;
	ImuReport report;
	const std::vector<std::span<const std::byte>> bad = {tooShort, tooLong, wrongId, none, tooMany, std::span<const std::byte>()};
	for (const auto &bytes : bad) EXPECT_FALSE(decoder.decode(bytes, second, report));
	EXPECT_EQ(decoder.malformed(), bad.size());
	std::vector<std::byte> padded(good.begin(), good.end());
	padded.resize(paddedReportSize);
	EXPECT_TRUE(parseInputReport(padded));
}

TEST(ReportDecoder, DeliversUnitsAndAxes)
{
	Stream stream;
	stream.warmUp(10);
	InputReport raw{.sampleCount = 2, .timestamp = 14, .temperature = -125, .magnetometer = {1000, 2000, -3000}};
	raw.samples[0] = {{0, 98067, 0}, {17453, 0, 0}};
	raw.samples[1] = {{-1, 2, 3}, {4, -5, 6}};
	stream.ticks += 2;
	const XrTime arrival = stream.start + stream.ticks * millisecond;
	ASSERT_TRUE(stream.decoder.decode(packInputReport(raw), arrival, stream.report));
	const ImuReport &report = stream.report;
	EXPECT_EQ(report.arrival, arrival);
	EXPECT_FALSE(report.restarted);
	ASSERT_EQ(report.sampleCount, 2u);
	EXPECT_NEAR(report.samples[0].acceleration.y, 9.8067, 1e-6);
	EXPECT_NEAR(report.samples[0].angularVelocity.x, 1.7453, 1e-6);
	EXPECT_NEAR(report.samples[1].angularVelocity.y, -5e-4, 1e-9);
	EXPECT_NEAR(report.temperature, -1.25, 1e-6);
	ASSERT_TRUE(report.magneticField);
	EXPECT_NEAR(report.magneticField->x, 1000e-8, 1e-12);
	EXPECT_NEAR(report.magneticField->y, -3000e-8, 1e-12) << "the third number is the y axis";
	EXPECT_NEAR(report.magneticField->z, 2000e-8, 1e-12);
}

TEST(ReportDecoder, DiscardsTheStaleReportAndTheBacklogAfterAStart)
{
	Stream stream;
	EXPECT_FALSE(stream.feed(2, 700, 0)) << "a stale report";
	EXPECT_FALSE(stream.feed(180, 900, 300)) << "a backlog";
	EXPECT_FALSE(stream.feed(2, 1080, 2)) << "the first short one may still follow a gap";
	EXPECT_TRUE(stream.feed(2, 1082, 2));
	EXPECT_TRUE(stream.report.restarted);
	EXPECT_EQ(stream.report.lostTicks, 0u);
	EXPECT_TRUE(stream.feed(2, 1084, 2));
	EXPECT_FALSE(stream.report.restarted);
	EXPECT_EQ(stream.decoder.malformed(), 0u);
}

TEST(ReportDecoder, UnwrapsTicks)
{
	Stream stream;
	stream.warmUp(65530);
	const int64_t before = stream.report.samples[1].tick; // 65533
	ASSERT_TRUE(stream.feed(3, 65534, 3));
	for (int i = 0; i < 3; i++) {
		EXPECT_EQ(stream.report.samples[size_t(i)].tick, before + 1 + i);
		EXPECT_EQ(stream.report.samples[size_t(i)].ticks, 1);
	}
	ASSERT_TRUE(stream.feed(2, 1, 2));
	EXPECT_EQ(stream.report.samples[1].tick, before + 5);
}

TEST(ReportDecoder, ABacklogsFirstSampleStandsForAllButTwo)
{
	Stream stream;
	stream.warmUp(100);
	const int64_t before = stream.report.samples[1].tick;
	ASSERT_TRUE(stream.feed(20, 104, 20));
	ASSERT_EQ(stream.report.sampleCount, 3u);
	EXPECT_EQ(stream.report.samples[0].ticks, 18);
	EXPECT_EQ(stream.report.samples[0].tick, before + 18);
	EXPECT_EQ(stream.report.samples[1].ticks, 1);
	EXPECT_EQ(stream.report.samples[1].tick, before + 19);
	EXPECT_EQ(stream.report.samples[2].tick, before + 20);
	EXPECT_EQ(stream.report.lostTicks, 0u);
}

TEST(ReportDecoder, CountsLostTicks)
{
	Stream stream;
	stream.warmUp(100);
	const int64_t before = stream.report.samples[1].tick;
	ASSERT_TRUE(stream.feed(2, 110, 8));
	EXPECT_EQ(stream.report.lostTicks, 6u);
	EXPECT_EQ(stream.report.samples[0].tick, before + 7);
	ASSERT_TRUE(stream.feed(2, 112, 2));
	EXPECT_EQ(stream.report.lostTicks, 0u);
}

TEST(ReportDecoder, TheOverflowsSpoiltMeanIsNotDelivered)
{
	Stream stream;
	stream.warmUp(100);
	ASSERT_TRUE(stream.feed(10, 357, 263)); // 253 ticks are missing: the firmware began again
	EXPECT_EQ(stream.report.sampleCount, 2u);
	EXPECT_EQ(stream.report.samples[0].ticks, 1);
	EXPECT_EQ(stream.report.lostTicks, 253u + 8);
	InputReport zero = reportOf(3, 620);
	zero.samples[0] = {};
	stream.ticks += 256;
	ASSERT_TRUE(stream.decoder.decode(packInputReport(zero), stream.start + stream.ticks * millisecond, stream.report));
	EXPECT_EQ(stream.report.sampleCount, 2u);
	EXPECT_NE(stream.report.samples[0].acceleration.y, 0);
}

TEST(ReportDecoder, ATrackerPluggedInAgainIsARestart)
{
	Stream stream;
	stream.warmUp(30000);
	const int64_t before = stream.report.samples[1].tick;
	EXPECT_FALSE(stream.feed(2, 5, 1500)) << "35 s of ticks in 1.5 s: the counter began anew";
	EXPECT_TRUE(stream.feed(2, 7, 2));
	EXPECT_TRUE(stream.report.restarted);
	EXPECT_GT(stream.report.samples[0].tick, before) << "ticks never fall";
	EXPECT_EQ(stream.report.lostTicks, 0u);
}

TEST(ReportDecoder, ALongSilenceIsARestart)
{
	Stream stream;
	stream.warmUp(10);
	EXPECT_FALSE(stream.feed(2, 20, 70'000));
	EXPECT_TRUE(stream.feed(2, 22, 2));
	EXPECT_TRUE(stream.report.restarted);
}

TEST(ReportDecoder, QueuedReportsReadTogetherAreNoRestart)
{
	Stream stream;
	stream.warmUp(0);
	stream.ticks += 128; // the host slept; then it reads everything at once
	for (uint16_t i = 0; i < 64; i++) {
		ASSERT_TRUE(stream.feed(2, uint16_t(4 + 2 * i), 0));
		EXPECT_FALSE(stream.report.restarted);
		EXPECT_EQ(stream.report.lostTicks, 0u);
	}
}

TEST(ReportDecoder, TheSameReportTwiceIsMalformed)
{
	Stream stream;
	stream.warmUp(10);
	EXPECT_FALSE(stream.feed(2, 12, 2));
	EXPECT_EQ(stream.decoder.malformed(), 1u);
	EXPECT_TRUE(stream.feed(2, 14, 0));
	EXPECT_FALSE(stream.report.restarted);
}
