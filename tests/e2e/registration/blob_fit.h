// Finds the markers in a panel picture: red discs that the cameras saw, blue ones that the application drew, each on black.
#pragma once
#include "tests/e2e/common/private_service.h"
#include "tests/gpu/reference/reference_lens.h"
#include <vector>

namespace arift::e2e
{

/// A disc of one colour. Its place is the centroid of its light in tangent space, the lens undone for that colour.
struct Spot {
	Eigen::Vector2d tangents = Eigen::Vector2d::Zero();
	double peak = 0; ///< linear light, 0 to 1
};

/// Discs of `channel` (0 red, 2 blue) in the half of `eye` that are whole, alone on black ground and without green.
std::vector<Spot> findSpots(const PanelPicture &picture, const reference::Lens &lens, int eye, int channel);

/// Two spots of one eye that belong together.
struct Pair {
	int eye = 0;
	Spot real, hologram;
	/// From the real thing to its hologram, panel pixels of the green channel (x right, y down).
	Eigen::Vector2d error = Eigen::Vector2d::Zero();
};
/// Pairs every real disc with the nearest hologram within `reach` (tangents); those without one are counted in `lonely`.
std::vector<Pair> pairSpots(const reference::Lens &lens, int eye, const std::vector<Spot> &real, const std::vector<Spot> &holograms,
							double reach, size_t &lonely);

} // namespace arift::e2e
