// Colours as people write them.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <string>

namespace arift
{

/// RRGGBB in hexadecimal digits, with or without a # before, as 0..1; nothing where it is not that.
inline std::optional<std::array<float, 3>> colourOf(const std::string &text)
{
	const std::string digits = text.starts_with('#') ? text.substr(1) : text;
	if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) return std::nullopt;
	const unsigned long value = std::stoul(digits, nullptr, 16);
	return std::array{float(value >> 16 & 255) / 255, float(value >> 8 & 255) / 255, float(value & 255) / 255};
}

inline std::string textOf(const std::array<float, 3> &colour)
{
	std::string text;
	for (const float channel : colour) text += fmt::format("{:02X}", int(std::lround(std::clamp(channel, 0.0f, 1.0f) * 255)));
	return text;
}

} // namespace arift
