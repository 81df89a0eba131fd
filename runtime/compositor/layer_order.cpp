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
	// An image whose rows go up stands on a quad of negative height.
	const glm::dvec2 half = 0.5 * glm::abs(glm::dvec2(quad.size.width, quad.size.height)), beside = glm::abs(glm::dvec2(head)) - half;
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
		std::span<const PanelLayer> left; ///< never empty
		double distance;                  ///< of the next one
	};
	FrameVector<Queue> queues;
	for (const std::span<const PanelLayer> &layers : applications)
		if (!layers.empty()) queues.push_back({layers, distanceOf(layers[0], headInOrigin)});
	while (queues.size() > 1) {
		const auto farthest = std::ranges::max_element(queues, {}, &Queue::distance);
		all.push_back(farthest->left[0]);
		farthest->left = farthest->left.subspan(1);
		if (farthest->left.empty())
			queues.erase(farthest);
		else
			farthest->distance = distanceOf(farthest->left[0], headInOrigin);
	}
	for (const Queue &last : queues) all.insert(all.end(), last.left.begin(), last.left.end());
}

} // namespace arift
