#include "tests/unit/tracking/recordings.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace arift::test
{
namespace
{

template <typename T> T readAt(const std::vector<char> &bytes, size_t offset)
{
	T value;
	std::memcpy(&value, bytes.data() + offset, sizeof value);
	return value;
}

RecordedSample readBroad(const std::vector<char> &bytes, size_t offset)
{
	const auto raw = readAt<std::array<int16_t, 14>>(bytes, offset);
	const auto vector = [&raw](size_t first, double scale) { return glm::dvec3(raw[first], raw[first + 1], raw[first + 2]) / scale; };
	RecordedSample sample{vector(0, 1200), vector(3, 200), vector(6, 100), std::nullopt, raw[13] != 0};
	if (raw[9] || raw[10] || raw[11] || raw[12]) { sample.reference = glm::normalize(glm::dquat(raw[9], raw[10], raw[11], raw[12])); }
	return sample;
}

RecordedSample readTumVi(const std::vector<char> &bytes, size_t offset)
{
	const auto raw = readAt<std::array<float, 18>>(bytes, offset);
	const auto vector = [&raw](size_t first) { return glm::dvec3(raw[first], raw[first + 1], raw[first + 2]); };
	RecordedSample sample{vector(1), vector(4), vector(7), std::nullopt, raw[14] != 0};
	if (std::isfinite(raw[10])) sample.reference = glm::normalize(glm::dquat(raw[10], raw[11], raw[12], raw[13]));
	return sample;
}

Recording readRecording(const std::filesystem::path &file)
{
	std::ifstream stream(file, std::ios::binary);
	const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
	if (bytes.size() < 64) throw std::runtime_error(file.string() + ": too short for a header");
	const bool broad = std::memcmp(bytes.data(), "BRC1", 4) == 0, tumVi = std::memcmp(bytes.data(), "BRD1", 4) == 0;
	const auto header = readAt<uint32_t>(bytes, 4), record = readAt<uint32_t>(bytes, 8), count = readAt<uint32_t>(bytes, 12);
	const size_t smallest = broad ? 28 : 72;
	if ((!broad && !tumVi) || record < smallest || bytes.size() < header + size_t(count) * record) {
		throw std::runtime_error(file.string() + ": damaged");
	}
	Recording recording{file.stem().string(), readAt<double>(bytes, 16), {}};
	for (uint32_t i = 0; i < count; ++i) {
		const size_t offset = header + size_t(i) * record;
		recording.samples.push_back(broad ? readBroad(bytes, offset) : readTumVi(bytes, offset));
	}
	return recording;
}

/// Degrees per minute of the straight line through headings (degrees) at times (seconds).
double slopePerMinute(const std::vector<double> &times, const std::vector<double> &headings)
{
	double meanTime = 0, meanHeading = 0, covariance = 0, variance = 0;
	for (size_t i = 0; i < times.size(); ++i)
		meanTime += times[i] / double(times.size()), meanHeading += headings[i] / double(times.size());
	for (size_t i = 0; i < times.size(); ++i) {
		covariance += (times[i] - meanTime) * (headings[i] - meanHeading);
		variance += (times[i] - meanTime) * (times[i] - meanTime);
	}
	return 60 * covariance / variance;
}

} // namespace

std::vector<Recording> readRecordings(const std::filesystem::path &folder)
{
	std::vector<std::filesystem::path> files;
	for (const auto &entry : std::filesystem::directory_iterator(folder)) {
		if (entry.path().extension() == ".brc" || entry.path().extension() == ".brd") files.push_back(entry.path());
	}
	std::sort(files.begin(), files.end());
	std::vector<Recording> recordings;
	for (const std::filesystem::path &file : files) recordings.push_back(readRecording(file));
	return recordings;
}

OrientationError orientationError(const Recording &recording, const std::vector<glm::dquat> &estimates)
{
	constexpr double inDegrees = 180 / 3.141592653589793;
	const auto angle = [](double cosineOfHalf) { return 2 * std::acos(std::clamp(cosineOfHalf, -1.0, 1.0)) * inDegrees; };
	double total = 0, heading = 0, inclination = 0, unwrapped = 0;
	std::vector<double> times, headings;
	for (size_t i = 0; i < recording.samples.size(); ++i) {
		const RecordedSample &sample = recording.samples[i];
		if (!sample.reference || !sample.moving) continue;
		const glm::dquat e = estimates[i] * glm::conjugate(*sample.reference);
		const double turned = 2 * std::atan2(e.z, e.w) * inDegrees;
		unwrapped += std::remainder(turned - unwrapped, 360.0);
		times.push_back(double(i) / recording.sampleRate);
		headings.push_back(unwrapped);
		total += std::pow(angle(std::abs(e.w)), 2);
		heading += std::pow(std::remainder(turned, 360.0), 2);
		inclination += std::pow(angle(std::hypot(e.w, e.z)), 2);
	}
	const double n = double(times.size());
	return {std::sqrt(total / n), std::sqrt(heading / n), std::sqrt(inclination / n), slopePerMinute(times, headings)};
}

} // namespace arift::test
