// What a panel pixel must show: pixel -> direction at that line's display time -> point in the room -> texel. For tests; double precision.
#pragma once
#include "tests/gpu/reference/reference_camera.h"
#include "tests/gpu/reference/reference_lens.h"
#include "tests/gpu/reference/reference_motion.h"
#include <array>
#include <optional>
#include <span>

namespace arift::reference
{

/// Tangents of a view's edges, signed as in OpenXR's XrFovf: left and down are negative.
struct Window {
	double left, right, up, down;
	bool holds(const Eigen::Vector2d &t) const { return t.x() >= left && t.x() <= right && t.y() >= down && t.y() <= up; }
};

/// The field of view that LibOVR 0.4 gives the DK1 at this eye relief (metres), symmetric between the eyes, pupils 64 mm apart.
Window fieldOfView(int eye, double eyeRelief);

/// One panel image's circumstances. Times in seconds from the instant at which the panel's middle (line 399.5) is seen.
struct Situation {
	ConstantTurn motion;
	std::array<Placement, 2> eyeInHead, cameraInHead;
	std::array<double, 2> exposure{-0.04, -0.04}; ///< middle of the exposure of each eye's camera image
	double viewOffset = 1;                        ///< 0: seen from the eyes, 1: from where the cameras were
	double passthroughDistance = 2;               ///< metres from the midpoint of both views to the plane on which the room is thought

	/// When the pixel row whose centre is at panel coordinate `y` is seen: 20.25 us per line.
	static double timeAt(double y) { return (y - 0.5 - 399.5) * 20.25e-6; }
	Placement camera(int eye) const { return motion.head(exposure[size_t(eye)]).holding(cameraInHead[size_t(eye)]); }
	Placement view(int eye, double time) const;
	/// Where the ray with these tangents meets the passthrough plane; nothing where it does not.
	std::optional<Eigen::Vector3d> passthroughPoint(int eye, double time, const Eigen::Vector2d &tangents) const;
};

/// A layer's image on the panel. `frame` of a head-locked layer is the head when the line is seen.
struct ProjectionPicture {
	Placement viewInFrame;
	Window window;
	int width, height;
};
struct QuadPicture {
	Placement quadInFrame;
	double metresWide, metresHigh;
	int width, height;
};

/// A flat thing in the room that a projection picture shows: x right, y up, seen from both sides.
struct Facet {
	Placement inFrame;
	double halfWide, halfHigh; ///< metres; may be infinite
};
/// What of a scene a panel pixel shows, and where a picture that was drawn of it from elsewhere has that.
struct SceneTexel {
	size_t facet;
	Eigen::Vector2d texel;
	bool drawn; ///< else the picture has another facet there, which was in front of it
};

/// Seen from inside; the centre of a cylinder's picture and the middle of a sphere's equator lie ahead of their centre, on its -z.
struct CurvedPicture {
	Placement centreInFrame;
	double radius;       ///< metres; 0: infinitely far away
	double across;       ///< radians from the left edge to the right one
	double aspect;       ///< cylinder: width along the arc / height; 0: a sphere
	double upper, lower; ///< sphere: elevation of the upper and of the lower edge
	int width, height;
};
/// A cube map infinitely far away.
struct CubePicture {
	Eigen::Quaterniond turnInFrame;
	int size; ///< texels of a face in each direction
};
/// Where a direction meets a cube map: Vulkan 1.3, "Cube Map Face Selection" and "Cube Map Coordinate Transformation".
struct CubeTexel {
	int face; ///< +x, -x, +y, -y, +z, -z
	Eigen::Vector2d texel;
};

/// The first facet that a ray meets, and where along it; nothing where it meets none.
struct Met {
	size_t facet;
	double along; ///< in lengths of the direction
};
std::optional<Met> firstMet(std::span<const Facet> facets, const Eigen::Vector3d &from, const Eigen::Vector3d &direction);
/// 1 / distance ahead of the view, per metre, of what a picture shows at a place between 0 and its width and height; 0: nothing.
double inverseDistance(const ProjectionPicture &picture, std::span<const Facet> facets, double column, double row);

/// All answers are (column, row) with integers at texel centres; nothing where the picture is not met.
class PanelReference
{
public:
	PanelReference(const Lens &lens, const std::array<Camera, 2> &cameras) : lens_(lens), cameras_(cameras) {}

	const Lens &lens() const { return lens_; }
	std::optional<Eigen::Vector2d> cameraTexel(const Situation &now, int eye, int channel, const Eigen::Vector2d &pixel) const;
	std::optional<Eigen::Vector2d> projectionTexel(const Situation &now, const ProjectionPicture &picture, bool headLocked, int eye,
												   int channel, const Eigen::Vector2d &pixel) const;
	std::optional<Eigen::Vector2d> quadTexel(const Situation &now, const QuadPicture &picture, bool headLocked, int eye, int channel,
											 const Eigen::Vector2d &pixel) const;
	std::optional<Eigen::Vector2d> curvedTexel(const Situation &now, const CurvedPicture &picture, bool headLocked, int eye, int channel,
											   const Eigen::Vector2d &pixel) const;
	/// Nothing where no facet is met, or where the picture does not reach.
	std::optional<SceneTexel> sceneTexel(const Situation &now, const ProjectionPicture &picture, std::span<const Facet> facets,
										 bool headLocked, int eye, int channel, const Eigen::Vector2d &pixel) const;
	CubeTexel cubeTexel(const Situation &now, const CubePicture &picture, bool headLocked, int eye, int channel,
						const Eigen::Vector2d &pixel) const;

private:
	/// A ray of a panel pixel in the frame of the origin or, where it is head-locked, of the head.
	struct Ray {
		Eigen::Vector3d from, direction;
	};
	Ray rayOf(const Situation &now, bool headLocked, int eye, int channel, const Eigen::Vector2d &pixel) const;

	Lens lens_;
	std::array<Camera, 2> cameras_;
};

} // namespace arift::reference
