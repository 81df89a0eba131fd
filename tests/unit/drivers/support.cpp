#include "tests/unit/drivers/support.h"
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace arift::test
{

XrVector3f PlainLens::ray(double x, double y) const
{
	const glm::dvec2 offset = (glm::dvec2{x, y} - glm::dvec2{(width - 1) / 2.0, (height - 1) / 2.0}) / focalLength;
	const double r = glm::length(offset), angle = isEquidistant ? r : std::atan(r);
	const double scale = r > 0 ? std::sin(angle) / r : 1;
	return toXr(glm::dvec3{offset.x * scale, offset.y * scale, std::cos(angle)});
}

glm::dvec2 PlainLens::project(const glm::dvec3 &d) const
{
	const double across = std::hypot(d.x, d.y), angle = std::atan2(across, d.z);
	const double r = focalLength * (isEquidistant ? angle : std::tan(angle)) / (across > 0 ? across : 1);
	return {(width - 1) / 2.0 + d.x * r, (height - 1) / 2.0 + d.y * r};
}

CameraGeometry PlainLens::geometry(const XrPosef &cameraInHead) const
{
	CameraGeometry geometry{.width = width, .height = height, .rays = {}, .cameraInHead = cameraInHead};
	for (uint32_t y = 0; y < height; y++)
		for (uint32_t x = 0; x < width; x++) geometry.rays.push_back(ray(x, y));
	return geometry;
}

std::vector<std::byte> fromHex(const std::string &text)
{
	std::istringstream stream(text);
	std::vector<std::byte> bytes;
	for (unsigned value; stream >> std::hex >> value;) bytes.push_back(std::byte(value));
	return bytes;
}

} // namespace arift::test
