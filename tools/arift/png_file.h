// Writes PNG files.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace arift::tools
{

/// Rows of RGBA8, sRGB encoded, without padding; alpha is dropped: a display has none. The file appears whole or not at all. Throws
/// InputError.
void writePng(const std::filesystem::path &file, uint32_t width, uint32_t height, std::span<const std::byte> pixels);

} // namespace arift::tools
