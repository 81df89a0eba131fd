// The DK1's two official lens models, written a second time for tests: panel pixel -> tangents of the direction in which the eye sees it.
// Sources: LibOVR 0.3.2 - 0.5.0.1 (Catmull-Rom spline over r^2, three tables by eye relief) and LibOVR 0.2.5 (polynomial).
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

namespace arift::reference
{

/// Panel coordinates: pixels of the 1280x800 panel, (0, 0) its top left corner, pixel centres at +0.5. Tangents: x right, y up.
class Lens
{
public:
	/// `eyeRelief` in metres.
	static Lens spline(double eyeRelief);
	static Lens polynomial();

	/// `eye` 0 left, 1 right; `channel` 0 red, 1 green, 2 blue.
	Eigen::Vector2d tangents(int eye, int channel, const Eigen::Vector2d &pixel) const;
	/// The panel pixel that shows a direction; nothing where the iteration finds none.
	std::optional<Eigen::Vector2d> pixel(int eye, int channel, const Eigen::Vector2d &tangents) const;
	/// Where the lens' axis meets the panel.
	static Eigen::Vector2d axis(int eye);
	/// Squared distance from the lens' axis, in the units of the model's argument, over the largest that its table describes.
	double relativeRadius2(int eye, const Eigen::Vector2d &pixel) const;

private:
	/// Distance from the axis in the model's own units, x right and y up.
	Eigen::Vector2d fromAxis(int eye, const Eigen::Vector2d &pixel) const;
	double stretch(double r2) const;
	double colour(int channel, double r2) const;

	bool spline_ = true;
	double unit_ = 1; ///< panel pixels per unit of the model's argument
	double tangentPerUnit_ = 1;
	double end_ = 1; ///< argument r^2 at the end of the table
	std::array<double, 11> knots_{};
};

} // namespace arift::reference
