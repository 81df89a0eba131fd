// Recordings in the EuRoC/ASL folder layout: mav0/cam0, mav0/cam1 (data.csv and data/*.png, 8-bit grey), mav0/imu0/data.csv.
#pragma once
#include "runtime/base/xr.h"
#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace arift::replay
{

/// IMU sample in the recording's body axes.
struct RecordedImu {
	XrDuration time = 0;           ///< since the recording's begin
	glm::dvec3 angularVelocity{0}; ///< rad/s
	glm::dvec3 acceleration{0};    ///< m/s^2, specific force
};

struct RecordedImage {
	XrDuration time = 0; ///< of mid-exposure, since the recording's begin
	std::filesystem::path file;
};

struct RecordedCamera {
	uint32_t width = 0, height = 0;
	double frameRate = 0; ///< from the median interval
	std::vector<RecordedImage> images;
};

/// Begins with the first image; ends one interval after the last.
struct EurocRecording {
	std::string name; ///< for people
	XrDuration length = 0;
	std::array<RecordedCamera, 2> cameras; ///< left, right; without images where the recording has no cam1
	std::vector<RecordedImu> imu;          ///< within the recording, rising in time
	double imuRate = 0;                    ///< from the median interval
};

/// `folder`: as base/euroc_folder.h says. Checks that every image is there with the right size and format; decodes none.
/// Throws InputError, naming file and line.
EurocRecording readEuroc(const std::filesystem::path &folder);

/// Decodes one image of width * height pixels; false where it is damaged.
bool decodeImage(const std::filesystem::path &file, uint32_t width, uint32_t height, std::span<std::byte> pixels);

} // namespace arift::replay
