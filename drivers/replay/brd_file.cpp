#include "drivers/replay/brd_file.h"
#include "runtime/base/error.h"
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

namespace arift::replay
{

static_assert(std::endian::native == std::endian::little, "recordings are read as they lie in the file");

namespace
{

struct Header {
	char magic[4];
	uint32_t headerSize, recordSize, count;
	double rate;
	uint32_t trial, flags;
	char name[32];
};
static_assert(sizeof(Header) == 64);

using RawRecord = std::array<float, 18>;
constexpr double alignmentSeconds = 0.5;

Header readHeader(std::ifstream &stream, const std::string &file, uintmax_t size)
{
	Header header{};
	if (!stream.read(reinterpret_cast<char *>(&header), sizeof header))
		throw InputError("{}: {} bytes, expected a header of 64", file, size);
	if (std::memcmp(header.magic, "BRD1", 4) != 0) throw InputError("{}: does not begin with \"BRD1\", expected a .brd recording", file);
	if (header.headerSize < sizeof header || header.headerSize > 4096)
		throw InputError("{}: header size {}, expected 64 to 4096", file, header.headerSize);
	if (header.recordSize != sizeof(RawRecord))
		throw InputError("{}: record size {}, expected {}", file, header.recordSize, sizeof(RawRecord));
	if (!(header.rate >= 1 && header.rate <= 10'000)) throw InputError("{}: rate {} Hz, expected 1 to 10000", file, header.rate);
	if (header.count < 2) throw InputError("{}: {} records, expected at least 2", file, header.count);
	const uintmax_t expected = header.headerSize + uintmax_t(header.count) * sizeof(RawRecord);
	if (size != expected) throw InputError("{}: {} bytes, expected {} for {} records", file, size, expected, header.count);
	return header;
}

BrdRecord convert(const RawRecord &raw, float firstTime, const std::string &file, size_t index)
{
	BrdRecord record{.seconds = double(raw[0]) - double(firstTime),
					 .angularVelocity = {raw[1], raw[2], raw[3]},
					 .acceleration = {raw[4], raw[5], raw[6]},
					 .reference = {}};
	constexpr std::array<double, 7> limits{1e6, 100, 100, 100, 1000, 1000, 1000};
	for (size_t i = 0; i < limits.size(); i++)
		if (!(std::abs(raw[i]) <= limits[i]))
			throw InputError("{}: record {}: field {} is {}, expected at most {} in size", file, index, i, raw[i], limits[i]);
	const glm::dquat orientation(raw[10], raw[11], raw[12], raw[13]);
	const glm::dvec3 position{raw[15], raw[16], raw[17]};
	const bool isPose = std::abs(glm::length(orientation) - 1) < 0.01 && glm::length(position) < 1000; // false for NaN
	if (isPose) record.reference = TimedPose{record.seconds, glm::normalize(orientation), position};
	return record;
}

} // namespace

BrdRecording readBrd(const std::filesystem::path &path)
{
	const std::string file = path.string();
	if (!std::filesystem::exists(path)) throw InputError("{}: no such file", file);
	std::ifstream stream(path, std::ios::binary);
	if (!stream || !std::filesystem::is_regular_file(path)) throw InputError("{}: cannot be read, expected a .brd recording", file);
	const Header header = readHeader(stream, file, std::filesystem::file_size(path));
	BrdRecording recording{file, std::string(header.name, strnlen(header.name, sizeof header.name)), header.rate, {}};
	recording.records.reserve(header.count);
	stream.seekg(header.headerSize);
	float firstTime = 0;
	for (size_t i = 0; i < header.count; i++) {
		RawRecord raw;
		if (!stream.read(reinterpret_cast<char *>(raw.data()), sizeof raw)) throw InputError("{}: record {} cannot be read", file, i);
		if (i == 0) firstTime = raw[0];
		const BrdRecord record = convert(raw, firstTime, file, i);
		if (i > 0 && record.seconds <= recording.records.back().seconds)
			throw InputError("{}: record {}: time {} s, expected more than that of the record before", file, i, raw[0]);
		recording.records.push_back(record);
	}
	return recording;
}

glm::dquat imuInHead(const BrdRecording &recording)
{
	const glm::dquat nominal = glm::quat_cast(glm::dmat3{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}); // columns: the sensor's axes in the head's
	glm::dvec3 sum{0};
	for (const BrdRecord &record : recording.records)
		if (record.seconds <= alignmentSeconds) sum += record.acceleration;
	const glm::dvec3 up{0, 1, 0}, force = nominal * sum;
	const glm::dvec3 axis = glm::cross(force, up);
	const double sine = glm::length(axis), angle = std::atan2(sine, glm::dot(force, up));
	return glm::normalize((sine > 0 ? rotationOf(axis * (angle / sine)) : glm::dquat(1, 0, 0, 0)) * nominal);
}

Trajectory headTrajectory(const BrdRecording &recording, const glm::dquat &imuInHead)
{
	const glm::dquat yUp = rotationOf({-M_PI / 2, 0, 0}), headInImu = glm::conjugate(imuInHead);
	Trajectory trajectory;
	for (const BrdRecord &record : recording.records)
		if (record.reference)
			trajectory.push_back({record.seconds, yUp * record.reference->orientation * headInImu, yUp * record.reference->position});
	if (trajectory.size() < 2) throw InputError("{}: {} reference poses, expected at least 2", recording.file, trajectory.size());
	return fromStart(trajectory);
}

} // namespace arift::replay
