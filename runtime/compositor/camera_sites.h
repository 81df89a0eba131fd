// A camera's raw image as the shader samples it: for every place between four pixels of one colour, those four in one texel. One fetch and
// two multiplications then interpolate a colour on its own lattice: a software renderer pays for every fetch. Pure functions.
#pragma once
#include "runtime/device/camera.h"
#include <array>
#include <span>

namespace arift
{

/// The image of sites: `planes` lattices of equal size, one below the other: red, green, blue of a Bayer image (green: the mean of a
/// cell's two), or the only one of a grey image.
struct SiteImage {
	uint32_t width = 0, height = 0; ///< of one plane
	uint32_t planes = 1;
	uint32_t bytesPerSite = 4; ///< four neighbours: right, below, right below; at the last column and row they are repeated
	bool operator==(const SiteImage &) const = default;
	size_t bytes() const { return size_t(width) * height * planes * bytesPerSite; }
};
SiteImage siteImageOf(const CameraFrame &frame);

/// Writes every site of `frame`, row by row, to `sites` (siteImageOf(frame).bytes() of them). This is the one copy of the image that a CPU
/// makes.
void packSites(const CameraFrame &frame, std::span<std::byte> sites);

/// Where red is in the cell of two by two pixels: column, row.
std::array<uint32_t, 2> redOf(PixelFormat format);

} // namespace arift
