#include "runtime/compositor/layer_order.h"
#include "runtime/base/frame_memory.h"
#include <algorithm>
#include <limits>

namespace arift
{

namespace
{

/// The world that the cameras see lies behind whatever holograms' distance nobody knows.
constexpr double world = std::numeric_limits<double>::infinity(), unknown = std::numeric_limits<double>::max();

/// Where the head is in a layer's own frame.
glm::dvec3 headIn(const XrPosef &pose, bool headLocked, const XrPosef &headInOrigin)
{
	const glm::dvec3 head = headLocked ? glm::dvec3(0) : toGlm(headInOrigin.position);
	return glm::conjugate(toGlm(pose.orientation)) * (head - toGlm(pose.position));
}

double distanceOf(const QuadView &quad, bool headLocked, const XrPosef &headInOrigin)
{
	const glm::dvec3 head = headIn(quad.quadInFrame, headLocked, headInOrigin);
	const glm::dvec2 beside = glm::abs(glm::dvec2(head)) - 0.5 * glm::dvec2(quad.size.width, quad.size.height);
	return glm::length(glm::dvec3(glm::max(beside, 0.0), head.z));
}

/// Of the whole cylinder or sphere, whatever part of it the image covers.
double distanceOf(const CurvedView &curved, bool headLocked, const XrPosef &headInOrigin)
{
	if (!(curved.radius > 0)) return unknown;
	glm::dvec3 head = headIn(curved.centreInFrame, headLocked, headInOrigin);
	if (curved.surface == Surface::cylinder) head.y = 0;
	return std::abs(double(curved.radius) - glm::length(head));
}

} // namespace

double distanceOf(const PanelLayer &layer, const XrPosef &headInOrigin)
{
	double nearest = layer.passthrough ? world : unknown;
	for (size_t eye = 0; eye < 2; ++eye) {
		if (layer.quad[eye]) nearest = std::min(nearest, distanceOf(*layer.quad[eye], layer.headLocked, headInOrigin));
		if (layer.curved[eye]) nearest = std::min(nearest, distanceOf(*layer.curved[eye], layer.headLocked, headInOrigin));
	}
	return nearest;
}

void mergeByDistance(std::span<const std::span<const PanelLayer>> applications, const XrPosef &headInOrigin, std::vector<PanelLayer> &all)
{
	struct Queue {
		std::span<const PanelLayer> left;
		double distance; ///< of the next one; less than nothing: there is none
	};
	const auto distanceOfNext = [&](std::span<const PanelLayer> left) { return left.empty() ? -1 : distanceOf(left[0], headInOrigin); };
	FrameVector<Queue> queues;
	for (const std::span<const PanelLayer> &layers : applications) queues.push_back({layers, distanceOfNext(layers)});
	for (;;) {
		const auto farthest = std::ranges::max_element(queues, {}, &Queue::distance);
		if (farthest == queues.end() || farthest->distance < 0) return;
		all.push_back(farthest->left[0]);
		farthest->left = farthest->left.subspan(1);
		farthest->distance = distanceOfNext(farthest->left);
	}
}

} // namespace arift
