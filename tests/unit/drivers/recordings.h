// Small recordings made by the tests themselves.
#pragma once
#include "runtime/device/driver.h"
#include "tests/unit/drivers/support.h"
#include <span>

namespace arift::test
{

/// Writes an 8-bit grey PNG of width * height pixels; folders are made.
void writeGreyPng(const std::filesystem::path &file, uint32_t width, uint32_t height, std::span<const uint8_t> pixels);
/// One of a single value.
void writeGreyPng(const std::filesystem::path &file, uint32_t width, uint32_t height, uint8_t value);

/// Five 8 x 6 images of values 10, 20 … every 50 ms in cam0 and cam1 (whose values are one higher), IMU at 200 Hz for two seconds from half
/// a second before; angular velocity about x counts the samples.
void writeEuroc(const std::filesystem::path &folder);

/// One record of a .brd file.
struct Record {
	float seconds;
	float angularVelocity[3], acceleration[3];
	float orientation[4]; ///< w x y z; NaN: none
	float position[3];
};
/// The bytes of a .brd file at 200 Hz.
std::string brdFile(const std::vector<Record> &records);

/// A configuration file that names a recording.
std::filesystem::path replayConfiguration(const TemporaryFolder &folder, const std::filesystem::path &recording,
										  const std::string &more = "");

} // namespace arift::test
