#include "tests/e2e/composition/expected_panel.h"
#include <algorithm>
#include <cmath>

namespace arift::e2e
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr double halfPupils = 0.032; ///< metres
constexpr double alike = 4;          ///< of 255: a pixel's neighbours may differ by as much where nothing has an edge

double linearOf(double code)
{
	const double v = code / 255;
	return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double encoded(double light)
{
	return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(std::min(light, 1.0), 1 / 2.4) - 0.055);
}

reference::Placement placed(const Pose &pose)
{
	const Vector3d axis(pose.axis[0], pose.axis[1], pose.axis[2]);
	return {Eigen::Quaterniond(Eigen::AngleAxisd(pose.angle, axis.normalized())), {pose.position[0], pose.position[1], pose.position[2]}};
}

/// Angles multiplied, as tangents.
reference::Window narrowed(const reference::Window &window, double scale)
{
	const auto tangent = [&](double t) { return std::tan(std::atan(t) * scale); };
	return {tangent(window.left), tangent(window.right), tangent(window.up), tangent(window.down)};
}

/// What is drawn is a circle that reaches as far as the field of view does anywhere.
double rimOf(const reference::Window &window) { return std::max({-window.left, window.right, window.up, -window.down}); }

struct Extent {
	int width, height;
};
Extent extentOf(const Part &part, const Image &image)
{
	return part.width > 0 ? Extent{part.width, part.height} : Extent{image.width, image.height};
}

reference::Situation atRest()
{
	reference::Situation now;
	now.viewOffset = 0;
	for (const int eye : {0, 1}) now.eyeInHead[size_t(eye)].place = {eye == 0 ? -halfPupils : halfPupils, 0, 0};
	return now;
}

} // namespace

ExpectedPanel::ExpectedPanel(const Composition &composition, const reference::RigNumbers &rig)
	: composition_(composition),
	  reference_(reference::Lens::spline(rig.eyeRelief), rig.cameras),
	  now_(atRest()),
	  windows_{reference::fieldOfView(0, rig.eyeRelief), reference::fieldOfView(1, rig.eyeRelief)}
{
}

std::optional<std::array<double, 3>> ExpectedPanel::at(const Vector2d &pixel) const
{
	const int eye = pixel.x() < 640 ? 0 : 1;
	if (reference_.lens().tangents(eye, 1, pixel).norm() > rimOf(windows_[size_t(eye)])) return std::nullopt;
	std::array<double, 3> shown{};
	for (int channel = 0; channel < 3; ++channel) {
		if (!windows_[size_t(eye)].holds(reference_.lens().tangents(eye, channel, pixel))) return std::nullopt;
		shown[size_t(channel)] = encodedAt(pixel, eye, channel);
	}
	return shown;
}

bool ExpectedPanel::isAtAnEdge(const Vector2d &pixel) const
{
	const int eye = pixel.x() < 640 ? 0 : 1;
	for (int channel = 0; channel < 3; ++channel) {
		const double here = encodedAt(pixel, eye, channel);
		for (const double down : {-1, 0, 1})
			for (const double right : {-1, 0, 1})
				if (std::abs(encodedAt(pixel + Vector2d(right, down), eye, channel) - here) > alike) return true;
	}
	return false;
}

/// OpenXR 1.1, "Composition Layer Blending", in OPAQUE mode: layers over black, bottom first.
double ExpectedPanel::encodedAt(const Vector2d &pixel, int eye, int channel) const
{
	double light = 0;
	for (const Layer &layer : composition_.layers) {
		if (!layer.eyes[size_t(eye)]) continue;
		const auto place = placeIn(layer, pixel, eye, channel);
		if (!place) continue;
		const Light own = lightOf(layer, *place, channel);
		light = own.value + light * (1 - own.alpha);
	}
	return encoded(light);
}

std::optional<ExpectedPanel::Place> ExpectedPanel::placeIn(const Layer &layer, const Vector2d &pixel, int eye, int channel) const
{
	const Part &part = layer.shape == Shape::projection && eye == 1 ? layer.rightPart : layer.part;
	const Image &image = composition_.images[part.image];
	const auto [width, height] = extentOf(part, image);
	const reference::Placement inHead = placed(layer.spaceInView).holding(placed(layer.poseInSpace));
	std::optional<Vector2d> texel;
	switch (layer.shape) {
	case Shape::projection: {
		const reference::ProjectionPicture picture{now_.eyeInHead[size_t(eye)], narrowed(windows_[size_t(eye)], layer.angleScale), width,
												   height};
		texel = reference_.projectionTexel(now_, picture, true, eye, channel, pixel);
		if (texel && layer.isMirrored) texel->x() = width - 1 - texel->x();
		if (texel && layer.isUpsideDown) texel->y() = height - 1 - texel->y();
		break;
	}
	case Shape::quad:
		texel = reference_.quadTexel(now_, {inHead, layer.width, layer.height, width, height}, true, eye, channel, pixel);
		break;
	case Shape::cylinder:
	case Shape::equirect:
		texel = reference_.curvedTexel(now_,
									   {inHead, layer.radius, layer.across, layer.shape == Shape::cylinder ? layer.aspect : 0, layer.upper,
										layer.lower, width, height},
									   true, eye, channel, pixel);
		break;
	case Shape::cube: {
		const auto met = reference_.cubeTexel(now_, {inHead.turn, width}, true, eye, channel, pixel);
		return Place{&part, met.face, met.texel};
	}
	}
	if (!texel) return std::nullopt;
	return Place{&part, part.arrayLayer, *texel};
}

/// Between the four texels around a place, in light; those at a part's edges reach beyond it.
ExpectedPanel::Light ExpectedPanel::lightOf(const Layer &layer, const Place &place, int channel) const
{
	const Image &image = composition_.images[place.part->image];
	const auto [width, height] = extentOf(*place.part, image);
	const Vector2d base(std::floor(place.texel.x()), std::floor(place.texel.y())), between = place.texel - base;
	double light = 0, alpha = 0;
	for (const int down : {0, 1})
		for (const int right : {0, 1}) {
			const int column = std::clamp(int(base.x()) + right, 0, width - 1), row = std::clamp(int(base.y()) + down, 0, height - 1);
			const auto texel = texelOf(image, place.part->column + column, place.part->row + row, place.arrayLayer);
			const double weight = (right ? between.x() : 1 - between.x()) * (down ? between.y() : 1 - between.y());
			light += weight * linearOf(texel[size_t(channel)]);
			alpha += weight * texel[3] / 255.0;
		}
	if (!layer.hasAlpha) alpha = 1;
	// XR_KHR_composition_layer_color_scale_bias applies to straight colours.
	const bool multiplied = layer.hasAlpha && layer.isMultiplied;
	const double straight = multiplied ? (alpha > 0 ? light / alpha : 0) : light;
	const double colour = std::max(0.0, straight * layer.scale[size_t(channel)] + layer.bias[size_t(channel)]);
	const double scaled = std::clamp(alpha * layer.scale[3] + layer.bias[3], 0.0, 1.0);
	return {colour * scaled, scaled};
}

} // namespace arift::e2e
