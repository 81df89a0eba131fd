// The DK1 tracker's feature reports: little-endian, byte 0 the report id, bytes 1-2 a command id that input reports echo.
// Only those that are safe to write have an encoder: reports 3 and 9 persist in the device's EEPROM, 6 starts its boot loader.
// Source: Oculus' released tracker firmware (feature_*.c) and TrackerFirmwareSpecification 0.20.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace arift::dk1
{

/// Report 2. 1000 / (1 + packetInterval) input reports a second.
struct SensorConfig {
	static constexpr uint8_t reportId = 2;
	static constexpr size_t size = 7;
	enum Flag : uint8_t {
		rawData = 0x01,
		useCalibration = 0x04,
		autoCalibration = 0x08,
		motionKeepAlive = 0x10,
		commandKeepAlive = 0x20,
		sensorCoordinates = 0x40
	};
	uint16_t command = 0;
	uint8_t flags = useCalibration | autoCalibration | commandKeepAlive;
	uint8_t packetInterval = 1;
	uint16_t sampleRate = 1000; ///< read-only
};

/// Report 4. Ranges change saturation only, never the units of the samples.
struct SensorRange {
	static constexpr uint8_t reportId = 4;
	static constexpr size_t size = 8;
	uint16_t command = 0;
	uint8_t accelerationG = 2;        ///< 2, 4, 8, 16
	uint16_t degreesPerSecond = 2000; ///< 250, 500, 1000, 2000
	uint16_t milligauss = 1300;       ///< 880, 1300, 1900, 2500
};

/// Report 8. Input reports stop when no feature report has been set for this long.
struct KeepAlive {
	static constexpr uint8_t reportId = 8;
	static constexpr size_t size = 5;
	uint16_t command = 0;
	uint16_t intervalMs = 10000;
};

/// Report 9, read only. Metres.
struct DisplayInfo {
	static constexpr uint8_t reportId = 9;
	static constexpr size_t size = 56;
	uint16_t command = 0;
	uint8_t distortionType = 1; ///< below 2: the coefficients are garbage on real units and are not given
	uint16_t width = 1280, height = 800;
	double widthMetres = 0.14976, heightMetres = 0.0936;
	double verticalCentre = 0.0468;
	double lensSeparation = 0.0635;
	std::array<double, 2> lensToScreen{0.0498, 0.0498};
	std::array<float, 6> distortion{};
};

template <typename Report> using Encoded = std::array<std::byte, Report::size>;

Encoded<SensorConfig> encode(const SensorConfig &config);
Encoded<SensorRange> encode(const SensorRange &range);
Encoded<KeepAlive> encode(const KeepAlive &keepAlive);
/// For the firmware model and tests; never sent to a device.
Encoded<DisplayInfo> encode(const DisplayInfo &info);

/// Nothing where length or id are wrong, or the values are none the device can have.
std::optional<SensorConfig> decodeSensorConfig(std::span<const std::byte> bytes);
std::optional<SensorRange> decodeSensorRange(std::span<const std::byte> bytes);
std::optional<KeepAlive> decodeKeepAlive(std::span<const std::byte> bytes);
/// Other software can destroy what the device stores: nothing where the numbers describe no DK1-like panel. Fall back to DisplayInfo{}.
std::optional<DisplayInfo> decodeDisplayInfo(std::span<const std::byte> bytes);

} // namespace arift::dk1
