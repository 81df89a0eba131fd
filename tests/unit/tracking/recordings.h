// Real recordings with a known orientation, and what a filter made of them.
#pragma once
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace arift::test
{

struct RecordedSample {
	glm::dvec3 rate, acceleration, field; ///< rad/s, m/s^2, microtesla
	std::optional<glm::dquat> reference;  ///< sensor in earth, z up
	bool moving = false;
};

struct Recording {
	std::string name;
	double sampleRate = 0;
	std::vector<RecordedSample> samples;
};

/// All of a folder, by name: .brc (BROAD) and .brd (TUM-VI), as the data's README describes them. Throws std::runtime_error on a damaged
/// file.
std::vector<Recording> readRecordings(const std::filesystem::path &folder);

/// RMSE in degrees over the moving part, the metric of BROAD; drift of the heading by a straight line through it.
struct OrientationError {
	double total = 0, heading = 0, inclination = 0, driftPerMinute = 0;
};
/// `estimates` has one orientation (sensor in earth, z up) for each sample.
OrientationError orientationError(const Recording &recording, const std::vector<glm::dquat> &estimates);

} // namespace arift::test
