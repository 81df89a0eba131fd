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

/// Made of unit length. What came of unit quaternions is nearly, but for rounding: one step of Newton's method then does without a root.
inline XrQuaternionf normalized(const XrQuaternionf &q)
{
	const float squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
	if (std::abs(squared - 1) > 1e-3f) return toXr(glm::normalize(toGlm(q)));
	const float scale = 1.5f - 0.5f * squared; // within 4e-7
	return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

/// In the precision of its operands: within 3e-7 of their lengths.
inline XrVector3f rotate(const XrQuaternionf &q, const XrVector3f &v)
{
	const XrVector3f axis{q.x, q.y, q.z}, twice = cross(axis, v) * 2.0f;
	return v + twice * q.w + cross(axis, twice);
}
/// As long as `a` times `b`: who multiplies on and on makes the product normalized() at times.
inline XrQuaternionf operator*(const XrQuaternionf &a, const XrQuaternionf &b)
{
	return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
			a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
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
	const double squared = glm::dot(rotationVector, rotationVector) / 4; // half the angle, squared
	if (squared < 0.25) { // up to a radian: the series of sine and cosine, exact within 1e-13, in steps that do not wait for each other
		const double s = squared, s2 = s * s;
		const double scale = (1. / 2 - s * (1. / 12)) + s2 * ((1. / 240 - s * (1. / 10080)) + s2 * (1. / 725760 - s * (1. / 79833600)));
		const double cosine =
			(1 - s * (1. / 2)) + s2 * ((1. / 24 - s * (1. / 720)) + s2 * ((1. / 40320 - s * (1. / 3628800)) + s2 * (1. / 479001600)));
		return {cosine, rotationVector.x * scale, rotationVector.y * scale, rotationVector.z * scale};
	}
	const double half = std::sqrt(squared), scale = std::sin(half) / (2 * half);
	return {std::cos(half), rotationVector.x * scale, rotationVector.y * scale, rotationVector.z * scale};
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
