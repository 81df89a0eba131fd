// Where a panel pixel's ray meets the camera image and each layer, as 3x3 matrices over its tangents. Pure functions in double precision.
// All of them take (x, y, 1) with x, y the tangents seen (x right, y up): direction (x, y, -1) in the view's frame.
#pragma once
#include "runtime/compositor/panel_inputs.h"
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

namespace arift
{

struct Placement {
	glm::dquat orientation{1, 0, 0, 0};
	glm::dvec3 position{0};
};
Placement toPlacement(const XrPosef &pose);

/// One eye at the instant at which one panel line is seen, in the origin frame.
struct EyeAtLine {
	Placement view, head;
	/// The passthrough plane: its unit normal away from the viewer, and its distance from the view along it.
	glm::dvec3 ahead{0, 0, -1};
	double planeDistance = 1;
};
/// Both eyes at `fraction` of the panel's height between the centres of its first and its last line.
std::array<EyeAtLine, 2> eyesAtLine(const PanelInputs &inputs, double fraction);

/// A place in a layer's frame.
Placement layerInOrigin(const EyeAtLine &eye, bool headLocked, const XrPosef &inFrame);
/// To the direction in a camera's frame (x right, y down, z forward; any length) in which the camera saw what lies on the passthrough
/// plane.
glm::dmat3 cameraMatrix(const EyeAtLine &eye, const XrPosef &cameraInOrigin);
/// To the direction in the origin's frame, with no plane between.
glm::dmat3 directionMatrix(const EyeAtLine &eye);
/// To (u w, v w, w) of what lies on the passthrough plane, u and v in 0..1 over the sub-image (v down), w > 0 in front of the view it was
/// drawn for.
glm::dmat3 projectionMatrix(const EyeAtLine &eye, bool headLocked, const ProjectionView &view);
/// As projectionMatrix(), of what is seen where the view's depth says: (direction (x, y, 1) + offset / distance), with the distance along
/// the ray, metres ahead of the eye.
struct DeepProjection {
	glm::dmat3 direction{1};
	glm::dvec3 offset{0};
};
DeepProjection deepProjection(const EyeAtLine &eye, bool headLocked, const ProjectionView &view);
/// How far an eye is in front of a quad's plane, metres: 1 / (distance ahead of the eye of what quadMatrix() meets) = w / this.
double distanceFrom(const EyeAtLine &eye, bool headLocked, const QuadView &quad);
/// The same for a quad, met where it stands; nothing for an eye behind it.
std::optional<glm::dmat3> quadMatrix(const EyeAtLine &eye, bool headLocked, const QuadView &quad);

} // namespace arift
