#include "drivers/synthetic/firmware.h"
#include "drivers/dk1/bytes.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace arift::synthetic
{

namespace
{

constexpr double fullScale = 32768; // of the converters
// Noise densities of the MPU-6000: 0.005 deg/s/sqrt(Hz) and 400 ug/sqrt(Hz), white up to half of 1 kHz, then its 256 Hz low-pass.
const double angularVelocityDeviation = 0.005 * M_PI / 180 * std::sqrt(500.0);
const double accelerationDeviation = 400e-6 * standardGravity * std::sqrt(500.0);
const double lowPass = 1 - std::exp(-2 * M_PI * 256 * 1e-3);
constexpr double biasWalkPerTick = 1e-6; // rad/s per square root of a millisecond: about 0.1 deg/s in an hour
constexpr uint32_t fieldPeriod = 5;      // ticks: at most 220 Hz
constexpr double fieldResolution = 20;   // 2 milligauss in units of the report
constexpr uint32_t mostStored = 254;

} // namespace

Firmware::Firmware(const SensorErrors &errors) : errors_(errors), random_(errors.seed) {}

void Firmware::tick(const PhysicalSample &sample)
{
	now_++;
	sinceCommand_++;
	if (sinceField_++ % fieldPeriod == 0) measureField(sample);
	if (stored_ == 0) temperature_ = int16_t(std::lround(sample.temperature * 100));
	store(measure(sample));
	sinceSent_++;
	const bool isAlive = !(config_.flags & dk1::SensorConfig::commandKeepAlive) || sinceCommand_ <= keepAlive_.intervalMs;
	if (sinceSent_ > config_.packetInterval && !endpoint_ && isAlive) send();
}

Firmware::Sums Firmware::measure(const PhysicalSample &sample)
{
	const double angularVelocityLimit = range_.degreesPerSecond * M_PI / 180 / dk1::unit;
	const double accelerationLimit = range_.accelerationG * standardGravity / dk1::unit;
	const auto convert = [&](const glm::dvec3 &value, double limit) {
		const double step = limit / fullScale;
		const glm::dvec3 counts = value / dk1::unit / step;
		return glm::clamp(errors_.quantisation ? glm::round(counts) : counts, -fullScale, fullScale - 1) * step;
	};
	glm::dvec3 acceleration = sample.acceleration + errors_.accelerationBias;
	glm::dvec3 angularVelocity = sample.angularVelocity + errors_.angularVelocityBias;
	if (errors_.noise) {
		std::normal_distribution<double> walk(0, biasWalkPerTick);
		for (int i = 0; i < 3; i++) biasWalk_[i] += walk(random_);
		acceleration += noise(accelerationDeviation, accelerationNoise_);
		angularVelocity += biasWalk_ + noise(angularVelocityDeviation, angularVelocityNoise_);
	}
	return {convert(acceleration, accelerationLimit), convert(angularVelocity, angularVelocityLimit)};
}

glm::dvec3 Firmware::noise(double deviation, glm::dvec3 &state)
{
	std::normal_distribution<double> white(0, deviation);
	for (int i = 0; i < 3; i++) state[i] += lowPass * (white(random_) - state[i]);
	return state;
}

void Firmware::measureField(const PhysicalSample &sample)
{
	const double limit = range_.milligauss * 10.0;
	const double order[] = {sample.magneticField.x, sample.magneticField.z, sample.magneticField.y}; // as the registers are ordered
	for (size_t i = 0; i < 3; i++) {
		const double counts = std::clamp(order[i] * 1e8, -limit, limit);
		field_[i] = int16_t(std::lround(errors_.quantisation ? std::round(counts / fieldResolution) * fieldResolution : counts));
	}
}

/// Slot 0 holds the sum of all but the newest two. The overflow is the firmware's own: it empties slot 0 alone and loses one sample.
void Firmware::store(const Sums &sample)
{
	if (stored_ == mostStored) {
		stored_ = 2;
		slots_[0] = {};
		firstTick_ = uint16_t(now_ - 2);
	}
	if (stored_ == 0) firstTick_ = now_;
	if (stored_ < 3) {
		slots_[stored_] = sample;
	} else {
		slots_[0].acceleration += slots_[1].acceleration;
		slots_[0].angularVelocity += slots_[1].angularVelocity;
		slots_[1] = slots_[2];
		slots_[2] = sample;
	}
	stored_++;
}

void Firmware::send()
{
	dk1::InputReport report{.sampleCount = uint8_t(stored_),
							.timestamp = firstTick_,
							.lastCommand = lastCommand_,
							.temperature = temperature_,
							.samples = {},
							.magnetometer = field_};
	const double merged = std::max(1.0, double(stored_) - 2);
	for (size_t i = 0; i < std::min<size_t>(stored_, 3); i++) {
		const double share = i == 0 ? 1 / merged : 1;
		report.samples[i].acceleration = rounded(slots_[i].acceleration * share, accelerationRemainder_);
		report.samples[i].angularVelocity = rounded(slots_[i].angularVelocity * share, angularVelocityRemainder_);
	}
	endpoint_ = dk1::packInputReport(report);
	stored_ = 0;
	sinceSent_ = 0;
}

/// What rounding takes from one sample is given to the next.
dk1::Counts Firmware::rounded(const glm::dvec3 &value, glm::dvec3 &remainder) const
{
	dk1::Counts counts;
	for (int i = 0; i < 3; i++) {
		const double wanted = std::clamp(value[i] + remainder[i], double(-dk1::packedLimit - 1), double(dk1::packedLimit));
		counts[size_t(i)] = int32_t(std::lround(wanted));
		remainder[i] = wanted - counts[size_t(i)];
	}
	return counts;
}

std::optional<Firmware::Report> Firmware::poll() { return std::exchange(endpoint_, std::nullopt); }

bool Firmware::setFeature(std::span<const std::byte> bytes)
{
	if (const auto config = dk1::decodeSensorConfig(bytes)) {
		config_ = *config;
		config_.sampleRate = 1000;
	} else if (const auto range = dk1::decodeSensorRange(bytes)) {
		range_ = *range;
	} else if (const auto keepAlive = dk1::decodeKeepAlive(bytes)) {
		keepAlive_ = *keepAlive;
	} else {
		return false;
	}
	lastCommand_ = dk1::read16(bytes, 1);
	sinceCommand_ = 0;
	return true;
}

size_t Firmware::getFeature(std::span<std::byte> buffer) const
{
	const auto answer = [&](const auto &report) -> size_t {
		const auto bytes = dk1::encode(report);
		if (buffer.size() < bytes.size()) return 0;
		std::copy(bytes.begin(), bytes.end(), buffer.begin());
		return bytes.size();
	};
	switch (buffer.empty() ? 0 : std::to_integer<uint8_t>(buffer[0])) {
	case dk1::SensorConfig::reportId: return answer(config_);
	case dk1::SensorRange::reportId: return answer(range_);
	case dk1::KeepAlive::reportId: return answer(keepAlive_);
	case dk1::DisplayInfo::reportId: return answer(dk1::DisplayInfo{});
	default: return 0;
	}
}

} // namespace arift::synthetic
