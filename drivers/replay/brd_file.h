// `.brd` recordings: IMU samples with the reference pose of the same instant (TUM-VI room sequences and the like).
// File: 64-byte header ("BRD1", u32 header size, u32 record size, u32 count, f64 rate, u32 trial, u32 flags, char[32] name), then records
// of 18 float32, little-endian: t s, angular velocity rad/s x3, acceleration m/s^2 x3, magnetometer x3 (unused), reference quaternion wxyz
// (sensor in a z-up world, NaN: none), movement flag, position m x3.
#pragma once
#include "drivers/trajectory.h"
#include <optional>
#include <string>

namespace arift::replay
{

struct BrdRecord {
	double seconds = 0;                             ///< from the first record
	glm::dvec3 angularVelocity{0}, acceleration{0}; ///< sensor axes
	std::optional<TimedPose> reference;             ///< sensor in the z-up world
};

struct BrdRecording {
	std::string file;
	std::string name;
	double rate = 0; ///< samples a second
	std::vector<BrdRecord> records;
};

/// Throws InputError, naming file and record, where the file is no recording, truncated or holds numbers that cannot be.
BrdRecording readBrd(const std::filesystem::path &file);

/// The sensor's axes in those of a head. TUM-VI's IMU has x left, y back, z up as its cameras look; from there the smallest turn that
/// makes the specific force of the first half second point up: whoever wears it holds their head level at the start.
glm::dquat imuInHead(const BrdRecording &recording);

/// Reference poses of the head in a y-up world that begins at its first position and heading; gaps are bridged. Throws InputError where
/// there are fewer than two.
Trajectory headTrajectory(const BrdRecording &recording, const glm::dquat &imuInHead);

} // namespace arift::replay
