// Pictures whose texels hold their own coordinates: what the panel shows then says where each of its pixels looked.
#pragma once
#include "runtime/compositor/panel_renderer.h"
#include "runtime/device/camera.h"
#include "runtime/gpu/device.h"
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace arift::reference
{

enum class Content : uint32_t { column, row, white };
inline constexpr std::array contents{Content::column, Content::row, Content::white};

/// 16-bit values, row by row: (column + 0.5) / width, (row + 0.5) / height, or 1, of full scale.
std::vector<uint16_t> coordinateValues(Content content, uint32_t width, uint32_t height);

/// A camera image (grey16) in memory of `allocate`.
CameraFrame coordinateFrame(const FrameAllocator &allocate, Content content, uint32_t width, uint32_t height);

/// An application's image (RGBA16, all colours alike, alpha 1) in the state in which an application hands it over; of a cube, all faces.
class CoordinateTexture
{
public:
	CoordinateTexture(gpu::Device &device, Content content, uint32_t width, uint32_t height, bool cube = false);
	const gpu::SharedImage &shared() const { return image_; }

private:
	gpu::SharedImage image_;
};

/// An application's depth image (D32) in that state, filled by `value` of a texel's middle (column, row).
class DepthTexture
{
public:
	DepthTexture(gpu::Device &device, uint32_t width, uint32_t height, const std::function<double(double, double)> &value);
	const gpu::SharedImage &shared() const { return image_; }

private:
	gpu::SharedImage image_;
};

/// What a panel pixel says, after three renderings: where it looked, and how much of the picture is in it (1: nothing else).
class PanelReadings
{
public:
	PanelReadings(std::array<ReadbackImage, 3> images, uint32_t width, uint32_t height);
	struct Reading {
		double column, row, weight;
	};
	Reading at(uint32_t x, uint32_t y, int channel) const;

private:
	std::array<ReadbackImage, 3> images_;
	double width_, height_;
};

} // namespace arift::reference
