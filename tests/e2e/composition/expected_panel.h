// What the panel must show of a composition: every pixel looked up in every layer by the second account of the optics, and blended in
// double precision. It shares no code with the runtime.
#pragma once
#include "tests/e2e/composition/compositions.h"
#include "tests/gpu/reference/reference_panel.h"

namespace arift::e2e
{

/// The head at rest, seen from the eyes, over nothing.
class ExpectedPanel
{
public:
	ExpectedPanel(const Composition &composition, const reference::RigNumbers &rig);

	/// sRGB encoded, 0..255, of a place on the panel; nothing beyond the field of view and the lens' rim.
	std::optional<std::array<double, 3>> at(const Eigen::Vector2d &pixel) const;
	/// Whether something else is seen less than a pixel from there: a pixel may show either.
	bool isAtAnEdge(const Eigen::Vector2d &pixel) const;

private:
	/// Linear light, multiplied by alpha, and alpha.
	struct Light {
		double value, alpha;
	};
	struct Place {
		const Part *part;
		int arrayLayer; ///< faces included
		Eigen::Vector2d texel;
	};
	double encodedAt(const Eigen::Vector2d &pixel, int eye, int channel) const;
	std::optional<Place> placeIn(const Layer &layer, const Eigen::Vector2d &pixel, int eye, int channel) const;
	Light lightOf(const Layer &layer, const Place &place, int channel) const;

	const Composition &composition_;
	reference::PanelReference reference_;
	reference::Situation now_;
	std::array<reference::Window, 2> windows_;
};

} // namespace arift::e2e
