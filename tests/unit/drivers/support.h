// What the driver tests share: simple lenses, temporary files.
#pragma once
#include "runtime/base/pose.h"
#include "runtime/device/driver.h"
#include "tests/common/temporary_folder.h"
#include <filesystem>
#include <string>
#include <vector>

namespace arift::test
{

/// A lens on paper: pixel = centre + f * (angle off the axis or its tangent) along the direction.
struct PlainLens {
	uint32_t width = 752, height = 480;
	double focalLength = 420;
	bool isEquidistant = true;

	XrVector3f ray(double x, double y) const;
	glm::dvec2 project(const glm::dvec3 &cvDirection) const;
	CameraGeometry geometry(const XrPosef &cameraInHead = identityPose) const;
};

/// The bytes of a hexadecimal dump.
std::vector<std::byte> fromHex(const std::string &text);

} // namespace arift::test
