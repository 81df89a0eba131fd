// Differences between two mappings of the panel, in panel pixels.
#pragma once
#include "tests/gpu/reference/reference_panel.h"
#include <functional>
#include <string>
#include <vector>

namespace arift::reference
{

/// (eye, channel, panel pixel) -> texel.
using Mapping = std::function<std::optional<Eigen::Vector2d>(int, int, const Eigen::Vector2d &)>;

/// `shown` is where a panel pixel looked, `wanted` where `mapping` says it must look: their difference in texels divided by how many
/// texels a panel pixel spans there, direction by direction.
std::optional<double> panelError(const Mapping &mapping, int eye, int channel, const Eigen::Vector2d &pixel, const Eigen::Vector2d &wanted,
								 const Eigen::Vector2d &shown);

struct ErrorFigures {
	std::vector<double> errors; ///< panel pixels
	size_t expected = 0;        ///< places that must show the picture alone
	size_t faded = 0;           ///< those of them that did not

	double share(double bound) const; ///< of errors that are at most `bound`
	double quantile(double q) const;
	double largest() const { return quantile(1); }
	std::string text() const;
};

} // namespace arift::reference
