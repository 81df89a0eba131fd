// Little-endian numbers in a report. The caller has checked the length.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace arift::dk1
{

inline uint16_t read16(std::span<const std::byte> bytes, size_t at)
{
	return uint16_t(std::to_integer<unsigned>(bytes[at]) | std::to_integer<unsigned>(bytes[at + 1]) << 8);
}
inline uint32_t read32(std::span<const std::byte> bytes, size_t at) { return read16(bytes, at) | uint32_t(read16(bytes, at + 2)) << 16; }
inline float readFloat(std::span<const std::byte> bytes, size_t at) { return std::bit_cast<float>(read32(bytes, at)); }

inline void write16(std::span<std::byte> bytes, size_t at, uint16_t value)
{
	bytes[at] = std::byte(value & 0xff);
	bytes[at + 1] = std::byte(value >> 8);
}
inline void write32(std::span<std::byte> bytes, size_t at, uint32_t value)
{
	write16(bytes, at, uint16_t(value & 0xffff));
	write16(bytes, at + 2, uint16_t(value >> 16));
}

} // namespace arift::dk1
