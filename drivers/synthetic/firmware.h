// A model of the DK1 tracker's firmware and sensors at the level of bytes: ranges, noise, quantisation, packing, keep-alive, backlog.
// Left out: the motion keep-alive and everything that persists in the device.
// Source: Oculus' released tracker firmware (main.c, data_packet.c); MPU-6000 and HMC5983 data sheets for noise and resolution.
#pragma once
#include "drivers/dk1/features.h"
#include "drivers/dk1/report.h"
#include <glm/vec3.hpp>
#include <optional>
#include <random>

namespace arift::synthetic
{

/// What acts on the sensors at one tick, in the tracker's axes.
struct PhysicalSample {
	glm::dvec3 acceleration{0};    ///< specific force, m/s^2
	glm::dvec3 angularVelocity{0}; ///< rad/s
	glm::dvec3 magneticField{0};   ///< tesla
	double temperature = 25;       ///< degrees Celsius
};

struct SensorErrors {
	bool noise = false;
	bool quantisation = true;          ///< of the sensors' converters; the 1e-4 of the report is always there
	glm::dvec3 angularVelocityBias{0}; ///< rad/s
	glm::dvec3 accelerationBias{0};    ///< m/s^2
	uint64_t seed = 1;
};

class Firmware
{
public:
	using Report = std::array<std::byte, dk1::inputReportSize>;

	explicit Firmware(const SensorErrors &errors);

	/// One data-ready interrupt of the sensors, nominally every millisecond.
	void tick(const PhysicalSample &sample);
	/// The host asks the interrupt endpoint: the report that waits there, if one does.
	std::optional<Report> poll();
	/// False: the request stalls (unknown, read-only or wrong in length).
	bool setFeature(std::span<const std::byte> bytes);
	/// Bytes written to `buffer`, whose first byte names the report; 0 when the request stalls.
	size_t getFeature(std::span<std::byte> buffer) const;

private:
	struct Sums {
		glm::dvec3 acceleration{0}, angularVelocity{0}; ///< in units of the report
	};
	Sums measure(const PhysicalSample &sample);
	void measureField(const PhysicalSample &sample);
	void store(const Sums &sample);
	void send();
	dk1::Counts rounded(const glm::dvec3 &value, glm::dvec3 &remainder) const;
	glm::dvec3 noise(double deviation, glm::dvec3 &state);

	SensorErrors errors_;
	std::mt19937_64 random_;
	dk1::SensorConfig config_;
	dk1::SensorRange range_;
	dk1::KeepAlive keepAlive_;
	uint16_t lastCommand_ = 0;
	uint16_t now_ = 0;          ///< count of interrupts, wraps
	uint32_t sinceCommand_ = 0; ///< ticks since the last set
	uint32_t sinceSent_ = 0;    ///< ticks
	uint32_t sinceField_ = 0;   ///< ticks since the magnetometer was read

	std::array<Sums, 3> slots_{};
	uint32_t stored_ = 0; ///< samples in the packet
	uint16_t firstTick_ = 0;
	int16_t temperature_ = 0;
	std::array<int16_t, 3> field_{};
	glm::dvec3 accelerationRemainder_{0}, angularVelocityRemainder_{0};
	glm::dvec3 accelerationNoise_{0}, angularVelocityNoise_{0}, biasWalk_{0};
	std::optional<Report> endpoint_;
};

} // namespace arift::synthetic
