#include "runtime/optics/pixel_rays.h"

namespace arift
{

std::vector<XrVector3f> pixelRays(const CameraModel &camera)
{
	std::vector<XrVector3f> rays;
	rays.reserve(size_t(camera.width()) * camera.height());
	for (uint32_t row = 0; row < camera.height(); ++row)
		for (uint32_t column = 0; column < camera.width(); ++column) {
			const glm::dvec3 ray = camera.unproject({column, row}).value_or(glm::dvec3(0));
			rays.push_back({float(ray.x), float(ray.y), float(ray.z)});
		}
	return rays;
}

} // namespace arift
