// Fits the radial curve in the form the shaders evaluate.
#include "runtime/optics/models.h"
#include "runtime/optics/polynomial.h"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace arift
{

namespace
{

constexpr size_t firstTable = 1024, largestTable = 16384;
constexpr size_t fitSamples = 600, checkSamples = 6007;

/// G(cos) = radius / sin; on the axis its limit, taken a little beside it.
double gain(const CameraModel &camera, double angle)
{
	const double a = std::max(angle, 1e-6 * camera.maxAngle());
	return camera.radius(a) / std::sin(a);
}

/// As the shader does it: everything in single precision.
float evaluated(const ShaderCamera &form, double maxAngle, double angle)
{
	const float cosine = float(std::cos(angle));
	if (form.coefficients > 0)
		return horner(std::span<const float>(form.g).first(form.coefficients), (cosine - form.cosineCentre) * form.cosineScale);
	const float last = float(form.table.size() - 1);
	const float at = std::clamp(float(angle) * (last / float(maxAngle)), 0.0f, last);
	const size_t index = std::min(size_t(at), form.table.size() - 2);
	return form.table[index] + (form.table[index + 1] - form.table[index]) * (at - float(index));
}

double stretch(const CameraModel &camera)
{
	const glm::dmat2 affine = std::visit([](const auto &model) { return models::plane(model).affine; }, camera.parameters());
	return std::max(glm::length(affine[0]), glm::length(affine[1]));
}

double measured(const CameraModel &camera, const ShaderCamera &form)
{
	double worst = 0;
	for (size_t i = 0; i <= checkSamples; ++i) {
		const double angle = camera.maxAngle() * double(i) / checkSamples;
		worst = std::max(worst, std::abs(double(evaluated(form, camera.maxAngle(), angle)) * std::sin(angle) - camera.radius(angle)));
	}
	return worst * stretch(camera);
}

ShaderCamera frameOf(const CameraModel &camera)
{
	const models::Plane plane = std::visit([](const auto &model) { return models::plane(model); }, camera.parameters());
	ShaderCamera form;
	const double limit = std::cos(camera.maxAngle());
	form.cosineCentre = float((1 + limit) / 2);
	form.cosineScale = float(2 / (1 - limit));
	form.cosineLimit = float(limit);
	form.centre = plane.centre;
	form.affine = plane.affine;
	form.tangential = {float(plane.tangential[0]), float(plane.tangential[1])};
	form.xi = float(plane.xi);
	return form;
}

std::vector<FitSample> samplesOf(const CameraModel &camera, const ShaderCamera &form)
{
	std::vector<FitSample> samples;
	for (size_t i = 0; i < fitSamples; ++i) {
		const double angle = camera.maxAngle() * (double(i) + 0.5) / fitSamples;
		const double x = (std::cos(angle) - double(form.cosineCentre)) * double(form.cosineScale);
		samples.push_back({x, gain(camera, angle), std::sin(angle)});
	}
	return samples;
}

ShaderCamera withTable(const CameraModel &camera, ShaderCamera form, size_t size)
{
	form.coefficients = 0;
	form.g = {};
	form.table.resize(size);
	for (size_t i = 0; i < size; ++i)
		form.table[i] = float(gain(camera, camera.maxAngle() * (i == 0 ? 0.5 : double(i)) / double(size - 1)));
	form.residual = measured(camera, form);
	return form;
}

} // namespace

ShaderCamera fitForShader(const CameraModel &camera, double tolerance)
{
	ShaderCamera form = frameOf(camera), best;
	const std::vector<FitSample> samples = samplesOf(camera, form);
	best.residual = std::numeric_limits<double>::infinity();
	for (size_t size = 3; size <= ShaderCamera::maxCoefficients; ++size) {
		const std::vector<double> coefficients = fitPolynomial(samples, size);
		std::copy(coefficients.begin(), coefficients.end(), form.g.begin());
		form.coefficients = uint32_t(size);
		form.residual = measured(camera, form);
		if (form.residual <= tolerance) return form;
		if (form.residual < best.residual) best = form;
	}
	for (size_t size = firstTable; size <= largestTable; size *= 2) {
		ShaderCamera table = withTable(camera, form, size);
		if (table.residual < best.residual) best = std::move(table);
		if (best.residual <= tolerance) break;
	}
	return best;
}

} // namespace arift
