// What the renderer takes from the Rig, once: lens and cameras in the shaders' form, and where each eye lies in the image drawn.
#pragma once
#include "runtime/compositor/tiles.h"
#include "runtime/optics/rig.h"

namespace arift
{

struct PanelCamera {
	ShaderCamera form;
	uint32_t width = 0, height = 0;
	double maxAngle = 0;        ///< radians off the axis
	double texelsPerRadian = 1; ///< at the edge of the image
};

/// ShaderCamera's G at the cosine of an angle off the axis (0 to maxAngle).
double gainAt(const PanelCamera &camera, double cosine);

struct PanelOptics {
	explicit PanelOptics(const Rig &rig);

	LensModel lens;
	ShaderLens shaderLens;
	bool redItself = false;           ///< red does not follow from green and blue
	std::vector<PanelCamera> cameras; ///< at most two
	uint32_t cameraCoefficients = 0;  ///< of every camera's polynomial; 0: all of them use tables of equal size
	uint32_t tableSize = 1;
	bool tangential = false;
	double interpupillaryDistance;
};

/// How the pixels of an image become directions.
struct ViewGeometry {
	bool throughLens = true;
	uint32_t width = 0, height = 0;
	struct Eye {
		PixelRect area;
		glm::dvec2 axis{0};     ///< pixel of the tangents (0, 0)
		glm::dvec2 perPixel{0}; ///< lens vector (through the lens) or tangents per pixel; y negative: tangents point up
		double radius = 1e9;    ///< pixels from the axis: nothing is drawn beyond
	};
	std::array<Eye, 2> eyes;
};
/// The panel itself: each eye on its half, inside the lens circle and a soft rim of three pixels around it.
ViewGeometry panelGeometry(const PanelOptics &optics);
/// Both eyes side by side at the default field of view, each as wide as half the panel, before the lens correction.
ViewGeometry eyesGeometry(const PanelOptics &optics);
TileGrid makeGrid(const PanelOptics &optics, const ViewGeometry &geometry, size_t eye);

constexpr double rimPixels = 3;

/// The shader's numbers (panel.frag, from constant id 8 on, in this order) that follow from the Rig alone.
struct PanelNumbers {
	std::array<float, 16> distortion{}; ///< D(r^2), lowest order first
	float largestR2 = 0, rimScale = 0;  ///< the circle, and 1 / the width of its soft rim in r^2
	float fillScale = 0;                ///< r^2 times this is 1 at the rim, where the fill is darkest
	std::array<float, 2> blue{}, red{}; ///< tangents = green's (first + second r^2)
	std::array<float, 2> redFromBlue{}; ///< red's texel = green's + (blue's - green's) (first + second r^2)
	// ShaderCamera:
	std::array<float, 16> gain{};
	std::array<float, 2> centre{};
	float cosineCentre = 0, cosineScale = 0;
	std::array<float, 4> affine{};
	std::array<float, 3> tangential{};                    ///< p1, p2, xi
	float tableScale = 0;                                 ///< 1 / angle at the end of the table
	float leastCosine = 0, cosineFade = 0, texelFade = 0; ///< of the largest angle; 1 / fading width in cosines and in texels
	std::array<float, 2> image{};                         ///< texels
};
/// `camera`: index into PanelOptics::cameras; beyond its end: no camera.
PanelNumbers numbersFor(const PanelOptics &optics, const ViewGeometry &geometry, size_t camera);

} // namespace arift
