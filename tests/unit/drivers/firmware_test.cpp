// The firmware model against the decoder: exact where it can be, statistical where there is noise, and the firmware's quirks.
#include "drivers/dk1/report.h"
#include "drivers/synthetic/firmware.h"
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <vector>

using namespace arift;
using namespace arift::synthetic;

namespace
{

constexpr PhysicalSample rest{.acceleration = {0, 9.80665, 0}, .angularVelocity = {}, .magneticField = {10e-6, -43.5e-6, -20.3e-6}};

/// Runs the firmware, polled after every tick, and gives the reports that came.
std::vector<dk1::InputReport> run(Firmware &firmware, int ticks, const PhysicalSample &sample = rest)
{
	std::vector<dk1::InputReport> reports;
	for (int i = 0; i < ticks; i++) {
		firmware.tick(sample);
		if (const auto bytes = firmware.poll()) reports.push_back(dk1::parseInputReport(*bytes).value());
	}
	return reports;
}

std::vector<glm::dvec3> angularVelocities(const std::vector<dk1::InputReport> &reports)
{
	std::vector<glm::dvec3> values;
	for (const auto &report : reports)
		for (size_t i = 0; i < report.sampleCount; i++) {
			const dk1::Counts &c = report.samples[i].angularVelocity;
			values.push_back(glm::dvec3{c[0], c[1], c[2]} * dk1::unit);
		}
	return values;
}

} // namespace

TEST(Firmware, PowersOnAt500ReportsOfTwoSamples)
{
	Firmware firmware({});
	const auto reports = run(firmware, 1000);
	ASSERT_EQ(reports.size(), 500u);
	for (size_t i = 0; i < reports.size(); i++) {
		EXPECT_EQ(reports[i].sampleCount, 2);
		EXPECT_EQ(reports[i].timestamp, uint16_t(1 + 2 * i));
	}
}

TEST(Firmware, ReportsAtTheConfiguredRateAndEchoesCommands)
{
	Firmware firmware({});
	ASSERT_TRUE(firmware.setFeature(dk1::encode(dk1::SensorConfig{.command = 0x4321, .packetInterval = 0})));
	const auto reports = run(firmware, 100);
	ASSERT_EQ(reports.size(), 100u);
	EXPECT_EQ(reports[0].sampleCount, 1);
	EXPECT_EQ(reports[0].lastCommand, 0x4321);
}

TEST(Firmware, WithoutSensorErrorsTheMeanIsExactForRoundingCarriesItsRemainder)
{
	Firmware firmware({.noise = false, .quantisation = false});
	const PhysicalSample sample{.acceleration = {0.12344, 9.80665, -3.00006}, .angularVelocity = {0.10003, -1.23457, 3.33333}};
	glm::dvec3 sum{0};
	const auto values = angularVelocities(run(firmware, 10'000, sample));
	for (const glm::dvec3 &value : values) {
		EXPECT_NEAR(value.x, sample.angularVelocity.x, 1e-4);
		EXPECT_NEAR(value.y, sample.angularVelocity.y, 1e-4);
		sum += value;
	}
	// all but at most one count of the sum of 10000
	EXPECT_LE(glm::length(sum / double(values.size()) - sample.angularVelocity), 2e-4 / double(values.size()));
}

TEST(Firmware, QuantisesByRangeAndSaturates)
{
	Firmware firmware({});
	const double step = 2000.0 / 32768 * M_PI / 180; // rad/s: 10.65 counts
	const auto coarse = angularVelocities(run(firmware, 4, {.angularVelocity = {0.45 * step, 1.4 * step, 0}}));
	for (const glm::dvec3 &value : coarse) {
		EXPECT_EQ(value.x, 0);
		EXPECT_NEAR(value.y, step, 1.01e-4) << "rounded to a count, with the remainder of the one before";
	}
	ASSERT_TRUE(firmware.setFeature(dk1::encode(dk1::SensorRange{.degreesPerSecond = 250})));
	const auto saturated = angularVelocities(run(firmware, 4, {.angularVelocity = {10, -10, 0.001}}));
	const double limit = 250 * M_PI / 180;
	for (const glm::dvec3 &value : saturated) {
		EXPECT_NEAR(value.x, limit, 2.5e-4);
		EXPECT_NEAR(value.y, -limit, 1.1e-4);
		EXPECT_NEAR(value.z, 0.001, 1.2e-4) << "an eighth of the range, an eighth of the step, the same unit";
	}
	const auto fallen = run(firmware, 2, {.acceleration = {0, 50, 0}});
	EXPECT_NEAR(fallen[0].samples[0].acceleration[1], 2 * 98066.5, 7) << "2 g at power-on";
}

TEST(Firmware, NoiseAndBiasAreTheSensors)
{
	const glm::dvec3 bias{0.02, -0.01, 0.005};
	Firmware firmware({.noise = true, .angularVelocityBias = bias, .seed = 7});
	const auto values = angularVelocities(run(firmware, 20'000, rest));
	glm::dvec3 mean{0}, square{0};
	double successive = 0;
	for (const glm::dvec3 &value : values) mean += value / double(values.size());
	for (size_t i = 0; i < values.size(); i++) {
		square += (values[i] - mean) * (values[i] - mean) / double(values.size());
		if (i > 0) successive += glm::dot(values[i] - mean, values[i - 1] - mean) / double(values.size());
	}
	// 0.005 deg/s/sqrt(Hz) over 500 Hz, through the low-pass: factor sqrt(a / (2 - a)) with a = 0.80
	const double expected = 0.005 * M_PI / 180 * std::sqrt(500.0) * std::sqrt(0.80 / 1.20);
	for (int axis = 0; axis < 3; axis++) {
		EXPECT_NEAR(mean[axis], bias[axis], 2e-4) << axis;
		EXPECT_NEAR(std::sqrt(square[axis]), expected, 0.06 * expected) << axis;
	}
	EXPECT_NEAR(successive / (square.x + square.y + square.z), 0.20, 0.05) << "the low-pass correlates neighbours";
}

TEST(Firmware, FallsSilentWithoutCommandsAndAnyCommandWakesIt)
{
	Firmware firmware({});
	EXPECT_EQ(run(firmware, 10'000).size(), 5000u);
	EXPECT_EQ(run(firmware, 5000).size(), 0u);
	std::array<std::byte, dk1::KeepAlive::size> query{std::byte{dk1::KeepAlive::reportId}};
	EXPECT_EQ(firmware.getFeature(query), query.size());
	EXPECT_EQ(run(firmware, 10).size(), 0u) << "a GET does not count";
	ASSERT_TRUE(firmware.setFeature(dk1::encode(dk1::KeepAlive{.intervalMs = 100})));
	EXPECT_GE(run(firmware, 100).size(), 50u);
	EXPECT_EQ(run(firmware, 100).size(), 0u);
}

TEST(Firmware, AnUnreadBacklogIsAveraged)
{
	Firmware firmware({.quantisation = false});
	run(firmware, 2);
	firmware.tick(rest);
	firmware.tick(rest); // this report waits in the endpoint
	for (int i = 1; i <= 20; i++) firmware.tick({.angularVelocity = {i * 0.01, 0, 0}});
	ASSERT_TRUE(firmware.poll());
	firmware.tick({.angularVelocity = {0.21, 0, 0}});
	const auto report = dk1::parseInputReport(firmware.poll().value()).value();
	EXPECT_EQ(report.sampleCount, 21);
	EXPECT_EQ(report.timestamp, 5);
	EXPECT_NEAR(report.samples[0].angularVelocity[0], 1000, 1) << "the mean of 0.01 to 0.19";
	EXPECT_NEAR(report.samples[1].angularVelocity[0], 2000, 1);
	EXPECT_NEAR(report.samples[2].angularVelocity[0], 2100, 1);
}

TEST(Firmware, OverflowsAfter254UnreadTicks)
{
	Firmware firmware({.quantisation = false});
	const PhysicalSample turning{.acceleration = {0, 9.8, 0}, .angularVelocity = {1, 0, 0}};
	firmware.tick(turning);
	firmware.tick(turning); // fills the endpoint with ticks 1 and 2
	for (int i = 0; i < 254 + 10; i++) firmware.tick(turning);
	ASSERT_TRUE(firmware.poll());
	firmware.tick(turning);
	const auto report = dk1::parseInputReport(firmware.poll().value()).value();
	EXPECT_EQ(report.sampleCount, 13);         // 3 at the overflow, 9 more, 1 with the send
	EXPECT_EQ(report.timestamp, 267 - 13 + 1); // one sample of the span is gone, yet it counts
	EXPECT_NEAR(report.samples[0].angularVelocity[0], 10'000 * 10 / 11, 1) << "one of the eleven is zero";
	EXPECT_EQ(report.samples[1].angularVelocity[0], 10'000);
}

TEST(Firmware, AnswersFeatureRequests)
{
	Firmware firmware({});
	std::array<std::byte, 56> buffer{std::byte{dk1::DisplayInfo::reportId}};
	ASSERT_EQ(firmware.getFeature(buffer), 56u);
	EXPECT_EQ(dk1::decodeDisplayInfo(buffer)->width, 1280);
	buffer[0] = std::byte{dk1::SensorRange::reportId};
	ASSERT_EQ(firmware.getFeature(buffer), 8u);
	EXPECT_EQ(dk1::decodeSensorRange(std::span(buffer).first(8))->accelerationG, 2);
	buffer[0] = std::byte{42};
	EXPECT_EQ(firmware.getFeature(buffer), 0u);
	EXPECT_FALSE(firmware.setFeature(dk1::encode(dk1::DisplayInfo{}))) << "persists in the device: refused";
}
