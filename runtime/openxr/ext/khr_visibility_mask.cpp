#include "runtime/openxr/ext/khr_visibility_mask.h"
#include <cmath>

namespace arift::openxr
{
namespace
{

/// Twice the area of a triangle, in squared tangents: smaller ones are nothing but rounding.
constexpr float smallest = 1e-6f;

float doubleArea(XrVector2f a, XrVector2f b, XrVector2f c) { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); }

/// Where the ray from `centre` through `point` leaves the field of view.
XrVector2f atEdge(XrVector2f centre, XrVector2f point, const XrFovf &fov)
{
	const float x = point.x - centre.x, y = point.y - centre.y;
	const float edgeX = (x > 0 ? std::tan(fov.angleRight) : std::tan(fov.angleLeft)) - centre.x;
	const float edgeY = (y > 0 ? std::tan(fov.angleUp) : std::tan(fov.angleDown)) - centre.y;
	const float alongX = x != 0 ? edgeX / x : INFINITY, alongY = y != 0 ? edgeY / y : INFINITY;
	const float along = std::max(1.0f, std::min(alongX, alongY));
	return {centre.x + along * x, centre.y + along * y};
}

void addTriangle(MaskMesh &mesh, uint32_t a, uint32_t b, uint32_t c)
{
	if (doubleArea(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) < smallest) return;
	mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Between the outline and the edge of the field of view.
MaskMesh hiddenMesh(std::span<const XrVector2f> outline, XrVector2f centre, const XrFovf &fov)
{
	MaskMesh mesh;
	for (const XrVector2f point : outline) {
		mesh.vertices.push_back(point);
		mesh.vertices.push_back(atEdge(centre, point, fov));
	}
	const auto count = uint32_t(outline.size());
	for (uint32_t i = 0; i < count; ++i) {
		const uint32_t rim = 2 * i, edge = rim + 1, nextRim = 2 * ((i + 1) % count), nextEdge = nextRim + 1;
		addTriangle(mesh, rim, edge, nextEdge);
		addTriangle(mesh, rim, nextEdge, nextRim);
	}
	if (mesh.indices.empty()) mesh.vertices.clear();
	return mesh;
}

MaskMesh visibleMesh(std::span<const XrVector2f> outline, XrVector2f centre)
{
	MaskMesh mesh;
	mesh.vertices.assign(outline.begin(), outline.end());
	mesh.vertices.push_back(centre);
	const auto count = uint32_t(outline.size());
	for (uint32_t i = 0; i < count; ++i) addTriangle(mesh, count, i, (i + 1) % count);
	return mesh;
}

MaskMesh lineLoop(std::span<const XrVector2f> outline)
{
	MaskMesh mesh;
	mesh.vertices.assign(outline.begin(), outline.end());
	for (uint32_t i = 0; i < outline.size(); ++i) mesh.indices.push_back(i);
	return mesh;
}

} // namespace

MaskMesh makeMask(XrVisibilityMaskTypeKHR type, std::span<const XrVector2f> outline, XrVector2f centre, const XrFovf &fov)
{
	if (type < XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR || type > XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrVisibilityMaskTypeKHR", int(type));
	MaskMesh hidden = hiddenMesh(outline, centre, fov);
	if (hidden.indices.empty() || type == XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR) return hidden;
	return type == XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR ? lineLoop(outline) : visibleMesh(outline, centre);
}

XrResult getVisibilityMask(Session &session, XrViewConfigurationType type, uint32_t viewIndex, XrVisibilityMaskTypeKHR maskType,
						   XrVisibilityMaskKHR &mask)
{
	requireStereo(type);
	if (viewIndex >= 2) throw Error(XR_ERROR_VALIDATION_FAILURE, "viewIndex {} is not below 2", viewIndex);
	const ipc::LensOutlines lenses = session.instance.service.lensOutlines();
	const ipc::LensOutline &lens = lenses[viewIndex];
	const uint32_t size = std::min(lens.count, ipc::LensOutline::mostPoints);
	const XrFovf fov = session.instance.service.views().fov[viewIndex];
	const MaskMesh mesh = makeMask(maskType, std::span(lens.points).first(size), lens.centre, fov);
	mask.vertexCountOutput = uint32_t(mesh.vertices.size());
	mask.indexCountOutput = uint32_t(mesh.indices.size());
	if (mask.vertexCapacityInput == 0 || mask.indexCapacityInput == 0) return XR_SUCCESS; // the size is asked for
	if (mask.vertexCapacityInput < mask.vertexCountOutput || mask.indexCapacityInput < mask.indexCountOutput)
		return XR_ERROR_SIZE_INSUFFICIENT;
	if (!mask.vertices || !mask.indices) throw Error(XR_ERROR_VALIDATION_FAILURE, "vertices or indices is null but its capacity is not 0");
	std::ranges::copy(mesh.vertices, mask.vertices);
	std::ranges::copy(mesh.indices, mask.indices);
	return XR_SUCCESS;
}

} // namespace arift::openxr
