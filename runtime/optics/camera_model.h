// How a camera maps directions to pixels: OCam, Kannala-Brandt, Mei, radtan and double sphere behind one face.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace arift
{

/// OCamCalib (Scaramuzza 2006). Polynomials lowest order first; centre and stretch in OCamCalib's own (row, column) frame, 0-based.
/// The direct polynomial is the truth; `inverse` is what the file said and only compared with it. Cameras published by their inverse
/// polynomial alone (the original ARift's) leave `direct` empty: then the inverse is the truth.
struct OCam {
	std::vector<double> direct;  ///< z(rho), pixels; empty where only the inverse is known
	std::vector<double> inverse; ///< rho(theta), theta = atan(z/n) in [-pi/2, pi/2]; may be empty where `direct` is not
	double centreRow = 0, centreColumn = 0;
	double c = 1, d = 0, e = 0; ///< row = c x + d y + centreRow, column = e x + y + centreColumn
};
/// Kannala & Brandt 2006: r = a + k1 a^3 + k2 a^5 + k3 a^7 + k4 a^9 with a the angle off the axis.
struct KannalaBrandt {
	double fx, fy, cx, cy;
	std::array<double, 4> k;
};
/// Mei & Rives 2007, distortion k1 k2 p1 p2 on the normalised plane.
struct Mei {
	double xi, fx, fy, cx, cy;
	std::array<double, 4> k;
};
/// Pinhole with radial-tangential distortion k1 k2 p1 p2 (OpenCV's first four).
struct RadTan {
	double fx, fy, cx, cy;
	std::array<double, 4> k;
};
/// Usenko, Demmel & Cremers 2018.
struct DoubleSphere {
	double xi, alpha, fx, fy, cx, cy;
};

using CameraParameters = std::variant<OCam, KannalaBrandt, Mei, RadTan, DoubleSphere>;

/// Immutable. Directions are in the CV frame (x right, y down, z forward), any length; pixels have integer coordinates at their centres,
/// (0, 0) being the first texel of the first row.
class CameraModel
{
public:
	/// Throws InputError where the numbers are no camera: not monotone over the image, centre outside, wrong size.
	CameraModel(uint32_t width, uint32_t height, CameraParameters parameters, double maxAngle = 0);

	uint32_t width() const { return width_; }
	uint32_t height() const { return height_; }
	const CameraParameters &parameters() const { return parameters_; }
	const char *name() const;
	/// Radians off the axis up to which the model holds (given, or where the projection stops being one-to-one or leaves the image's far
	/// corner).
	double maxAngle() const { return maxAngle_; }

	/// Nothing beyond maxAngle. May lie outside the image.
	std::optional<glm::dvec2> project(const glm::dvec3 &direction) const;
	/// Unit direction; nothing where no direction maps to the pixel.
	std::optional<glm::dvec3> unproject(const glm::dvec2 &pixel) const;
	/// The radial curve: radius of a direction `angle` off the axis (0 to maxAngle) on the model's own plane, before tangential distortion,
	/// stretch and centre. Pixels for OCam, focal lengths for the others.
	double radius(double angle) const;

private:
	uint32_t width_, height_;
	CameraParameters parameters_;
	double maxAngle_;
	double maxRadius_ = 0;
};

/// The same camera in the form the shaders evaluate, with q the direction and u = |q|:
///   m = q.xy / u * G(q.z / u)            G: polynomial in (cosine - cosineCentre) * cosineScale, lowest order first, or `table`
///   t = q.xy / (q.z + xi u)              only where tangential != 0
///   pixel = centre + affine * (m + tangential(t))     tangential(t) = (2 p1 tx ty + p2 (r2 + 2 tx2), p1 (r2 + 2 ty2) + 2 p2 tx ty)
struct ShaderCamera {
	static constexpr size_t maxCoefficients = 16;
	std::array<float, maxCoefficients> g{};
	uint32_t coefficients = 0; ///< 0: use `table`
	float cosineCentre = 0, cosineScale = 1;
	float cosineLimit = 0; ///< of maxAngle: less is unseen
	glm::vec2 centre{};
	glm::mat2 affine{1}; ///< column-major as in GLSL
	std::array<float, 2> tangential{};
	float xi = 0;
	/// G over the angle off the axis, atan2(|q.xy|, q.z), linear from 0 (first) to maxAngle (last); empty where the polynomial is good
	/// enough.
	std::vector<float> table;
	double residual = 0; ///< largest difference to the model inside the image, pixels, measured when fitted
};
/// The shortest polynomial whose residual inside the image is at most `tolerance` pixels; else a table of 1024 entries, doubled up to 16384
/// until it is; else whichever of all these is best.
ShaderCamera fitForShader(const CameraModel &camera, double tolerance = 0.004);

/// Reads OCamCalib's calib_results.txt. Throws InputError with file, line and value. An inverse polynomial that disagrees with the direct
/// one by more than half a pixel is warned about and otherwise ignored.
CameraModel readOCamFile(const std::string &file);

} // namespace arift
