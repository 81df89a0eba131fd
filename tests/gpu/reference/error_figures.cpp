#include "tests/gpu/reference/error_figures.h"
#include <Eigen/LU>
#include <algorithm>
#include <cstdio>

namespace arift::reference
{

std::optional<double> panelError(const Mapping &mapping, int eye, int channel, const Eigen::Vector2d &pixel, const Eigen::Vector2d &wanted,
								 const Eigen::Vector2d &shown)
{
	constexpr double step = 0.125;
	const auto right = mapping(eye, channel, pixel + Eigen::Vector2d(step, 0)),
			   left = mapping(eye, channel, pixel - Eigen::Vector2d(step, 0));
	const auto down = mapping(eye, channel, pixel + Eigen::Vector2d(0, step)), up = mapping(eye, channel, pixel - Eigen::Vector2d(0, step));
	if (!right || !left || !down || !up) return std::nullopt;
	Eigen::Matrix2d texelsPerPixel;
	texelsPerPixel << (*right - *left) / (2 * step), (*down - *up) / (2 * step);
	return (texelsPerPixel.inverse() * (shown - wanted)).norm();
}

double ErrorFigures::share(double bound) const
{
	return double(std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= bound; })) / double(errors.size());
}

double ErrorFigures::quantile(double q) const
{
	if (errors.empty()) return 0;
	std::vector<double> sorted = errors;
	const auto at = sorted.begin() + std::ptrdiff_t(q * double(sorted.size() - 1));
	std::nth_element(sorted.begin(), at, sorted.end());
	return *at;
}

std::string ErrorFigures::text() const
{
	char line[160];
	std::snprintf(line, sizeof line, "median %.4f  99.5%% %.4f  max %.4f px  within 0.25: %.3f %%  (%zu places, %zu faded)", quantile(0.5),
				  quantile(0.995), largest(), 100 * share(0.25), errors.size(), faded);
	return line;
}

} // namespace arift::reference
