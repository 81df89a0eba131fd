// The DK1's lens: panel pixel -> direction the eye sees it in, per colour channel. Facts and test vectors: LibOVR 0.2.5 and 0.3.2-0.5.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace arift
{

/// LibOVR 0.3.2 and later: Catmull-Rom spline of ten segments over r^2, interpolated between three tables by eye relief.
struct SplineLens {
	double eyeRelief = 0.010; /**< metres, 0.00776 to 0.01776 */
};
/// LibOVR 0.2.x: r (K0 + K1 r^2 + K2 r^4 + K3 r^6), eye to screen 41 mm.
struct PolynomialLens {
	std::array<double, 4> k{1.0, 0.22, 0.24, 0.0};
};

/// The DK1's: pixels and metres (its firmware's display info).
struct PanelGeometry {
	uint32_t width = 1280, height = 800;
	double widthMetres = 0.14976, heightMetres = 0.0936;
	double lensSeparation = 0.0635;
};

enum class Eye : uint32_t { left, right };
enum class Channel : uint32_t { red, green, blue };

/// Immutable. Panel coordinates: pixels of the whole panel, (0, 0) the top left corner, pixel centres at +0.5. Tangents: x right, y up, of
/// the angle from the eye's axis (OpenXR: direction (x, y, -1)).
class LensModel
{
public:
	using Panel = PanelGeometry;
	explicit LensModel(SplineLens lens, Panel panel = {});
	explicit LensModel(PolynomialLens lens, Panel panel = {});

	const Panel &panel() const { return panel_; }
	glm::dvec2 tangents(Eye eye, Channel channel, glm::dvec2 pixel) const;
	/// The panel pixel that shows this direction, if the lens shows it on that eye's half.
	std::optional<glm::dvec2> pixel(Eye eye, Channel channel, glm::dvec2 tangents) const;
	/// Panel pixels of the eye's lens axis.
	glm::dvec2 centre(Eye eye) const;
	/// Linear size of a radian at the lens axis, panel pixels per unit tangent.
	double pixelsPerTangent() const;
	/// Tangents of the default field of view (left, right, up, down), all positive, by LibOVR 0.4's rule for the eye relief and the given
	/// interpupillary distance.
	struct Fov {
		double left, right, up, down;
	};
	Fov fov(Eye eye, double interpupillaryDistance = 0.064) const;

	/// tangent_green = lensVector * D(|lensVector|^2), lensVector = (pixel - centre) / pixelsPerTangent with y up; red and blue are
	/// tangent_green * (a + b |lensVector|^2).
	double scale(double r2) const;
	std::array<double, 2> chromatic(Channel channel) const;
	/// The largest |lensVector|^2 that is drawn: the lens circle, whose rim is where the default field of view reaches furthest.
	double maxR2() const;

private:
	std::array<double, 11> k_{}; ///< spline
	double maxRadius2_ = 0;
	std::optional<PolynomialLens> polynomial_;
	Panel panel_;
	double eyeRelief_ = 0.010;
};

/// D(r^2) as a polynomial in r^2, lowest order first, for the shaders. `residual`: largest difference inside maxR2 of what the shader's
/// single precision makes of it, in panel pixels there (the tangent's error divided by the lens's local magnification).
struct ShaderLens {
	static constexpr size_t maxCoefficients = 16;
	std::array<float, maxCoefficients> d{};
	uint32_t coefficients = 0;
	double residual = 0;
};
/// The shortest polynomial whose residual is at most `tolerance`, else the best. The spline's ten segments have kinks: about 0.1 is
/// reached.
ShaderLens fitForShader(const LensModel &lens, double tolerance = 0.05);

} // namespace arift
