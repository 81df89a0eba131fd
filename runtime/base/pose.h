// Pose arithmetic on OpenXR's own types: x right, y up, -z forward, right-handed, metres, radians.
// A pose named `aInB` maps points of frame a into frame b: bPoint = aInB * aPoint, and headInLocal * eyeInHead == eyeInLocal.
#pragma once
#include "runtime/base/xr.h"
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace arift
{

constexpr XrQuaternionf identityOrientation{0, 0, 0, 1};
constexpr XrPosef identityPose{identityOrientation, {0, 0, 0}};

inline glm::dvec3 toGlm(const XrVector3f &v) { return {v.x, v.y, v.z}; }
inline glm::dquat toGlm(const XrQuaternionf &q) { return {q.w, q.x, q.y, q.z}; }
inline XrVector3f toXr(const glm::dvec3 &v) { return {float(v.x), float(v.y), float(v.z)}; }
inline XrQuaternionf toXr(const glm::dquat &q) { return {float(q.x), float(q.y), float(q.z), float(q.w)}; }

inline XrVector3f operator+(const XrVector3f &a, const XrVector3f &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline XrVector3f operator-(const XrVector3f &a, const XrVector3f &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline XrVector3f operator*(const XrVector3f &a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline float dot(const XrVector3f &a, const XrVector3f &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(const XrVector3f &a) { return std::sqrt(dot(a, a)); }
inline XrVector3f cross(const XrVector3f &a, const XrVector3f &b)
{
	return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline XrVector3f rotate(const XrQuaternionf &q, const XrVector3f &v) { return toXr(toGlm(q) * toGlm(v)); }
inline XrQuaternionf operator*(const XrQuaternionf &a, const XrQuaternionf &b) { return toXr(glm::normalize(toGlm(a) * toGlm(b))); }
inline XrQuaternionf inverse(const XrQuaternionf &q) { return {-q.x, -q.y, -q.z, q.w}; }

inline XrPosef operator*(const XrPosef &bInC, const XrPosef &aInB)
{
	return {bInC.orientation * aInB.orientation, rotate(bInC.orientation, aInB.position) + bInC.position};
}
inline XrVector3f operator*(const XrPosef &aInB, const XrVector3f &aPoint) { return rotate(aInB.orientation, aPoint) + aInB.position; }
inline XrPosef inverse(const XrPosef &aInB)
{
	const XrQuaternionf orientation = inverse(aInB.orientation);
	return {orientation, rotate(orientation, aInB.position) * -1.0f};
}

/// The rotation by `rotationVector` (axis times angle, radians), exact for any length.
inline glm::dquat rotationOf(const glm::dvec3 &rotationVector)
{
	const double angle = glm::length(rotationVector);
	const double scale = angle > 1e-9 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48;
	return {std::cos(angle / 2), rotationVector.x * scale, rotationVector.y * scale, rotationVector.z * scale};
}
inline XrQuaternionf rotationAbout(const XrVector3f &axis, double angle) { return toXr(rotationOf(toGlm(axis) * angle)); }

/// Radians between two orientations, in [0, pi].
inline double angleBetween(const XrQuaternionf &a, const XrQuaternionf &b)
{
	const glm::dquat d = glm::conjugate(toGlm(a)) * toGlm(b);
	return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

/// The part of `orientation` that turns about the vertical: heading only, level.
inline XrQuaternionf headingOf(const XrQuaternionf &orientation)
{
	const double n = std::hypot(orientation.y, orientation.w);
	if (n < 1e-6) return identityOrientation;
	return {0, float(orientation.y / n), 0, float(orientation.w / n)};
}

/// The camera frame's axes (x right, y down, z forward) are OpenXR's turned half around x. Its own inverse.
inline XrVector3f cvFromXr(const XrVector3f &v) { return {v.x, -v.y, -v.z}; }
inline XrVector3f xrFromCv(const XrVector3f &v) { return cvFromXr(v); }

inline bool isFinite(const XrVector3f &v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline bool isFinite(const XrQuaternionf &q)
{
	return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}
/// OpenXR 1.1, "Quaternions": a unit quaternion within 1 %.
inline bool isValidPose(const XrPosef &pose)
{
	if (!isFinite(pose.position) || !isFinite(pose.orientation)) return false;
	const XrQuaternionf &q = pose.orientation;
	return std::abs(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w) - 1.0f) <= 0.01f;
}

} // namespace arift
