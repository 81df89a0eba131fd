#include "drivers/dk1/features.h"
#include "drivers/dk1/bytes.h"
#include <algorithm>
#include <cmath>

namespace arift::dk1
{

namespace
{

template <typename Report> Encoded<Report> header(const Report &report)
{
	Encoded<Report> bytes{};
	bytes[0] = std::byte{Report::reportId};
	write16(bytes, 1, report.command);
	return bytes;
}

template <typename Report> bool isReport(std::span<const std::byte> bytes)
{
	return bytes.size() == Report::size && bytes[0] == std::byte{Report::reportId};
}

bool isOneOf(unsigned value, std::initializer_list<unsigned> choices)
{
	return std::find(choices.begin(), choices.end(), value) != choices.end();
}

bool isWithin(double value, double low, double high) { return value >= low && value <= high; }

double metresAt(std::span<const std::byte> bytes, size_t at) { return read32(bytes, at) * 1e-6; }
uint32_t micrometres(double metres) { return uint32_t(std::lround(metres * 1e6)); }

bool isPlausible(const DisplayInfo &info)
{
	return info.width >= 640 && info.width <= 4096 && info.height >= 480 && info.height <= 4096 && isWithin(info.widthMetres, 0.05, 0.3) &&
		   isWithin(info.heightMetres, 0.03, 0.2) && isWithin(info.verticalCentre, 0, info.heightMetres) &&
		   isWithin(info.lensSeparation, 0.04, std::min(0.1, info.widthMetres)) && isWithin(info.lensToScreen[0], 0.01, 0.15) &&
		   isWithin(info.lensToScreen[1], 0.01, 0.15);
}

} // namespace

Encoded<SensorConfig> encode(const SensorConfig &config)
{
	auto bytes = header(config);
	bytes[3] = std::byte{config.flags};
	bytes[4] = std::byte{config.packetInterval};
	write16(bytes, 5, config.sampleRate);
	return bytes;
}

Encoded<SensorRange> encode(const SensorRange &range)
{
	auto bytes = header(range);
	bytes[3] = std::byte{range.accelerationG};
	write16(bytes, 4, range.degreesPerSecond);
	write16(bytes, 6, range.milligauss);
	return bytes;
}

Encoded<KeepAlive> encode(const KeepAlive &keepAlive)
{
	auto bytes = header(keepAlive);
	write16(bytes, 3, keepAlive.intervalMs);
	return bytes;
}

Encoded<DisplayInfo> encode(const DisplayInfo &info)
{
	auto bytes = header(info);
	bytes[3] = std::byte{info.distortionType};
	write16(bytes, 4, info.width);
	write16(bytes, 6, info.height);
	const double lengths[] = {info.widthMetres,    info.heightMetres,    info.verticalCentre,
							  info.lensSeparation, info.lensToScreen[0], info.lensToScreen[1]};
	for (size_t i = 0; i < std::size(lengths); i++) write32(bytes, 8 + 4 * i, micrometres(lengths[i]));
	for (size_t i = 0; i < info.distortion.size(); i++) write32(bytes, 32 + 4 * i, std::bit_cast<uint32_t>(info.distortion[i]));
	return bytes;
}

std::optional<SensorConfig> decodeSensorConfig(std::span<const std::byte> bytes)
{
	if (!isReport<SensorConfig>(bytes)) return std::nullopt;
	return SensorConfig{read16(bytes, 1), std::to_integer<uint8_t>(bytes[3]), std::to_integer<uint8_t>(bytes[4]), read16(bytes, 5)};
}

std::optional<SensorRange> decodeSensorRange(std::span<const std::byte> bytes)
{
	if (!isReport<SensorRange>(bytes)) return std::nullopt;
	const SensorRange range{read16(bytes, 1), std::to_integer<uint8_t>(bytes[3]), read16(bytes, 4), read16(bytes, 6)};
	const bool possible = isOneOf(range.accelerationG, {2, 4, 8, 16}) && isOneOf(range.degreesPerSecond, {250, 500, 1000, 2000}) &&
						  isOneOf(range.milligauss, {880, 1300, 1900, 2500, 4000, 4700, 5600, 8100});
	return possible ? std::optional(range) : std::nullopt;
}

std::optional<KeepAlive> decodeKeepAlive(std::span<const std::byte> bytes)
{
	if (!isReport<KeepAlive>(bytes)) return std::nullopt;
	return KeepAlive{read16(bytes, 1), read16(bytes, 3)};
}

std::optional<DisplayInfo> decodeDisplayInfo(std::span<const std::byte> bytes)
{
	if (!isReport<DisplayInfo>(bytes)) return std::nullopt;
	DisplayInfo info{.command = read16(bytes, 1),
					 .distortionType = uint8_t(std::to_integer<uint8_t>(bytes[3]) & 0x0f),
					 .width = read16(bytes, 4),
					 .height = read16(bytes, 6),
					 .widthMetres = metresAt(bytes, 8),
					 .heightMetres = metresAt(bytes, 12),
					 .verticalCentre = metresAt(bytes, 16),
					 .lensSeparation = metresAt(bytes, 20),
					 .lensToScreen = {metresAt(bytes, 24), metresAt(bytes, 28)}};
	if (info.distortionType < 1 || !isPlausible(info)) return std::nullopt;
	for (size_t i = 0; info.distortionType >= 2 && i < info.distortion.size(); i++) info.distortion[i] = readFloat(bytes, 32 + 4 * i);
	const bool finite = std::all_of(info.distortion.begin(), info.distortion.end(), [](float k) { return std::isfinite(k); });
	return finite ? std::optional(info) : std::nullopt;
}

} // namespace arift::dk1
