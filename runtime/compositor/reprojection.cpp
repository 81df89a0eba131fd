#include "runtime/compositor/reprojection.h"
#include <algorithm>

namespace arift
{

namespace
{

/// Tangents to directions: (x, y, 1) -> (x, y, -1). OpenXR's axes to a camera's (x right, y down, z forward) and back.
const glm::dmat3 tangentsToDirection{1, 0, 0, 0, 1, 0, 0, 0, -1};
const glm::dmat3 directionToCv{1, 0, 0, 0, -1, 0, 0, 0, -1};
/// No plane is nearer than this: a plane through the view would be infinitely large.
constexpr double nearest = 0.05;

Placement between(const XrPosef &first, const XrPosef &last, double fraction)
{
	const Placement a = toPlacement(first), b = toPlacement(last);
	return {glm::slerp(a.orientation, b.orientation, fraction), glm::mix(a.position, b.position, fraction)};
}

Placement combine(const Placement &bInC, const Placement &aInB)
{
	return {bInC.orientation * aInB.orientation, bInC.orientation * aInB.position + bInC.position};
}

/// (x, y, 1) -> the vector, in the frame of `target`, from it to the point on the passthrough plane, up to a positive factor:
/// ray + offset (ray . ahead) / planeDistance with offset = view - target.
glm::dmat3 toPlanePoint(const EyeAtLine &eye, const Placement &target)
{
	const glm::dmat3 rays = glm::mat3_cast(eye.view.orientation) * tangentsToDirection;
	const glm::dvec3 offset = (eye.view.position - target.position) / eye.planeDistance;
	return glm::mat3_cast(glm::conjugate(target.orientation)) * (rays + glm::outerProduct(offset, eye.ahead * rays));
}

/// A point in a view's frame to (u w, v w, w): u = (x / -z - left) / (right - left), v = (up - y / -z) / (up - down), times w = -z.
glm::dmat3 toUv(const XrFovf &fov)
{
	const double left = std::tan(fov.angleLeft), right = std::tan(fov.angleRight);
	const double up = std::tan(fov.angleUp), down = std::tan(fov.angleDown);
	return glm::transpose(glm::dmat3{                                              //
									 1 / (right - left), 0, left / (right - left), //
									 0, -1 / (up - down), -up / (up - down),       //
									 0, 0, -1});
}

} // namespace

Placement toPlacement(const XrPosef &pose) { return {glm::normalize(toGlm(pose.orientation)), toGlm(pose.position)}; }

Placement layerInOrigin(const EyeAtLine &eye, bool headLocked, const XrPosef &inFrame)
{
	const Placement place = toPlacement(inFrame);
	return headLocked ? combine(eye.head, place) : place;
}

std::array<EyeAtLine, 2> eyesAtLine(const PanelInputs &inputs, double fraction)
{
	std::array<EyeAtLine, 2> eyes;
	for (size_t e = 0; e < 2; ++e) {
		eyes[e].view = between(inputs.top[e].viewInOrigin, inputs.bottom[e].viewInOrigin, fraction);
		eyes[e].head = between(inputs.top[e].headInOrigin, inputs.bottom[e].headInOrigin, fraction);
	}
	const glm::dvec3 middle = (eyes[0].view.position + eyes[1].view.position) / 2.0;
	for (EyeAtLine &eye : eyes) {
		eye.ahead = eye.head.orientation * glm::dvec3(0, 0, -1);
		eye.planeDistance = std::max(nearest, inputs.passthroughDistance - glm::dot(eye.view.position - middle, eye.ahead));
	}
	return eyes;
}

glm::dmat3 cameraMatrix(const EyeAtLine &eye, const XrPosef &cameraInOrigin)
{
	return directionToCv * toPlanePoint(eye, toPlacement(cameraInOrigin));
}

glm::dmat3 directionMatrix(const EyeAtLine &eye) { return glm::mat3_cast(eye.view.orientation) * tangentsToDirection; }

glm::dmat3 projectionMatrix(const EyeAtLine &eye, bool headLocked, const ProjectionView &view)
{
	return toUv(view.fov) * toPlanePoint(eye, layerInOrigin(eye, headLocked, view.viewInFrame));
}

DeepProjection deepProjection(const EyeAtLine &eye, bool headLocked, const ProjectionView &view)
{
	const Placement drawn = layerInOrigin(eye, headLocked, view.viewInFrame);
	const glm::dmat3 toImage = toUv(view.fov) * glm::mat3_cast(glm::conjugate(drawn.orientation));
	return {toImage * directionMatrix(eye), toImage * (eye.view.position - drawn.position)};
}

double distanceFrom(const EyeAtLine &eye, bool headLocked, const QuadView &quad)
{
	const Placement place = layerInOrigin(eye, headLocked, quad.quadInFrame);
	return (glm::conjugate(place.orientation) * (eye.view.position - place.position)).z;
}

std::optional<glm::dmat3> quadMatrix(const EyeAtLine &eye, bool headLocked, const QuadView &quad)
{
	const Placement place = layerInOrigin(eye, headLocked, quad.quadInFrame);
	const glm::dmat3 toQuad = glm::mat3_cast(glm::conjugate(place.orientation));
	const glm::dvec3 from = toQuad * (eye.view.position - place.position);
	if (!(from.z > 0)) return std::nullopt;
	// The ray from + t d meets z = 0 where t = from.z / -d.z: there x = (from.x w + from.z d.x) / w with w = -d.z.
	const glm::dmat3 toHit = glm::transpose(glm::dmat3{                                                                   //
													   from.z / quad.size.width, 0, -(from.x / quad.size.width + 0.5),    //
													   0, -from.z / quad.size.height, -(0.5 - from.y / quad.size.height), //
													   0, 0, -1});
	return toHit * toQuad * glm::mat3_cast(eye.view.orientation) * tangentsToDirection;
}

} // namespace arift
