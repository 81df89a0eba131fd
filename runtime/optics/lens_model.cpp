#include "runtime/optics/lens_model.h"
#include "runtime/base/error.h"
#include "runtime/optics/invert.h"
#include "runtime/optics/lens_spline.h"
#include "runtime/optics/lens_tables.h"
#include <algorithm>
#include <glm/geometric.hpp>

namespace arift
{

namespace
{

double metresPerTangent(bool polynomial) { return polynomial ? dk1::polynomialMetresPerTangent : dk1::splineMetresPerTangent; }

void checkPanel(const PanelGeometry &panel)
{
	if (panel.width < 2 || panel.height < 1 || panel.width > 16384 || panel.height > 16384)
		throw InputError("panel of {} x {} pixels, expected at most 16384 each", panel.width, panel.height);
	if (!(panel.widthMetres > 0.01 && panel.widthMetres < 1 && panel.heightMetres > 0.01 && panel.heightMetres < 1))
		throw InputError("panel of {} x {} m, expected 0.01 to 1 each", panel.widthMetres, panel.heightMetres);
	if (!(panel.lensSeparation > 0 && panel.lensSeparation < panel.widthMetres))
		throw InputError("lens separation {} m, expected within the panel's width of {} m", panel.lensSeparation, panel.widthMetres);
}

/// |lensVector| of the panel's corner that is furthest from a lens axis.
double furthestRadius(const LensModel &lens)
{
	const auto &panel = lens.panel();
	const glm::dvec2 centre = lens.centre(Eye::left);
	return glm::length(glm::dvec2(std::max(centre.x, panel.width / 2.0 - centre.x), panel.height / 2.0)) / lens.pixelsPerTangent();
}

} // namespace

LensModel::LensModel(SplineLens lens, Panel panel) : panel_(panel), eyeRelief_(lens.eyeRelief)
{
	checkPanel(panel);
	if (!(lens.eyeRelief > 0 && lens.eyeRelief < 0.1)) throw InputError("eye relief {} m, expected 0 to 0.1", lens.eyeRelief);
	const dk1::LensSpline spline = dk1::splineAt(lens.eyeRelief);
	k_ = spline.k;
	maxRadius2_ = spline.maxRadius2;
}

LensModel::LensModel(PolynomialLens lens, Panel panel) : polynomial_(lens), panel_(panel)
{
	checkPanel(panel);
	const double furthest = furthestRadius(*this);
	double last = 0;
	for (int i = 1; i <= 256; ++i) {
		const double r = furthest * i / 256, tangent = r * scale(r * r);
		if (!(tangent > last)) throw InputError("lens polynomial does not rise at {:.0f} % of the panel's far corner", 100.0 * i / 256);
		last = tangent;
	}
}

double LensModel::pixelsPerTangent() const { return panel_.width / panel_.widthMetres * metresPerTangent(polynomial_.has_value()); }

glm::dvec2 LensModel::centre(Eye eye) const
{
	const double offset = panel_.lensSeparation / 2 / panel_.widthMetres * panel_.width;
	return {panel_.width / 2.0 + (eye == Eye::left ? -offset : offset), panel_.height / 2.0};
}

double LensModel::scale(double r2) const
{
	if (!polynomial_) return dk1::evaluate({k_, maxRadius2_}, r2).value;
	// LibOVR 0.2.5 measures r in half widths of an eye's part of the panel
	const double unit = dk1::polynomialMetresPerTangent / (panel_.widthMetres / 4);
	return horner<double>(polynomial_->k, r2 * unit * unit);
}

std::array<double, 2> LensModel::chromatic(Channel channel) const
{
	if (!polynomial_) return {dk1::splineChromatic[size_t(channel)], 0};
	const double unit = dk1::polynomialMetresPerTangent / (panel_.widthMetres / 4);
	const auto [a, b] = dk1::polynomialChromatic[size_t(channel)];
	return {a, b * unit * unit};
}

glm::dvec2 LensModel::tangents(Eye eye, Channel channel, glm::dvec2 pixel) const
{
	const glm::dvec2 offset = (pixel - centre(eye)) / pixelsPerTangent();
	const double r2 = glm::dot(offset, offset);
	const auto [a, b] = chromatic(channel);
	return glm::dvec2(offset.x, -offset.y) * (scale(r2) * (a + b * r2));
}

std::optional<glm::dvec2> LensModel::pixel(Eye eye, Channel channel, glm::dvec2 tangents) const
{
	const double wanted = glm::length(tangents);
	if (wanted == 0) return centre(eye);
	const std::array<double, 2> colour = chromatic(channel);
	const auto tangentOf = [&](double r) { return r * scale(r * r) * (colour[0] + colour[1] * r * r); };
	const double furthest = furthestRadius(*this);
	if (!(wanted <= tangentOf(furthest))) return {};
	const auto residual = [&](double r) -> ValueAndSlope {
		constexpr double h = 1e-6;
		return {tangentOf(r) - wanted, (tangentOf(r + h) - tangentOf(r - h)) / (2 * h)};
	};
	const double r = solveRising(residual, 0, furthest, std::min(wanted, furthest / 2));
	const glm::dvec2 pixel = centre(eye) + glm::dvec2(tangents.x, -tangents.y) * (r / wanted * pixelsPerTangent());
	const double middle = panel_.width / 2.0, slack = 1e-9;
	const double low = eye == Eye::left ? 0 : middle, high = eye == Eye::left ? middle : panel_.width;
	if (pixel.x < low - slack || pixel.x > high + slack || pixel.y < -slack || pixel.y > panel_.height + slack) return {};
	return pixel;
}

LensModel::Fov LensModel::fov(Eye eye, double interpupillaryDistance) const
{
	// How far the eye sits outwards of the lens axis; negative: inwards.
	const double outwards = (interpupillaryDistance - panel_.lensSeparation) / 2;
	const double relief = std::max(eyeRelief_, dk1::leastEyeRelief);
	const auto throughLens = [&](double shift) {
		const double straight = (dk1::lensRadius + shift) / relief;
		const double turned = (dk1::lensRadius + shift + dk1::eyeballRadius * dk1::eyeTurnSine + dk1::extraRotation) /
							  (relief + dk1::eyeballRadius * (1 - dk1::eyeTurnCosine));
		return std::max(straight, turned);
	};
	const auto onPanel = [&](glm::dvec2 edge) {
		double widest = 0;
		for (int step = 1; step <= 10; ++step) {
			const glm::dvec2 at = centre(Eye::left) + (edge - centre(Eye::left)) * (step / 10.0);
			const glm::dvec2 tangent = tangents(Eye::left, Channel::green, at);
			widest = std::max({widest, std::abs(tangent.x), std::abs(tangent.y)});
		}
		return widest;
	};
	const glm::dvec2 axis = centre(Eye::left);
	const double outer = std::min(throughLens(-outwards), onPanel({0, axis.y}));
	const double inner = std::min(throughLens(outwards), onPanel({panel_.width / 2.0, axis.y}));
	const double up = std::min(throughLens(0), onPanel({axis.x, 0}));
	const double down = std::min(throughLens(0), onPanel({axis.x, double(panel_.height)}));
	return eye == Eye::left ? Fov{outer, inner, up, down} : Fov{inner, outer, up, down};
}

double LensModel::maxR2() const
{
	const Fov widest = fov(Eye::left);
	const double rim = std::max({widest.left, widest.right, widest.up, widest.down});
	const auto residual = [&](double r) -> ValueAndSlope {
		constexpr double h = 1e-6;
		const auto tangentOf = [&](double at) { return at * scale(at * at); };
		return {tangentOf(r) - rim, (tangentOf(r + h) - tangentOf(r - h)) / (2 * h)};
	};
	const double furthest = furthestRadius(*this);
	const double r = solveRising(residual, 0, furthest, furthest / 2);
	return r * r;
}

} // namespace arift
