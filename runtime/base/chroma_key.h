// What a colour key is: shared by whoever asks for one and whoever applies it.
#pragma once
#include <array>

namespace arift
{

/// Which colour of an application's picture stands for the world behind it. Distances are between encoded values, in luma (a quarter of
/// it) and chroma (Rec. 709).
struct ChromaKey {
	std::array<float, 3> colour{0, 1, 0}; ///< sRGB encoded
	float tolerance = 0.15f;              ///< nearer than this: the world alone
	float softness = 0.1f;                ///< from there on to the layer alone
	bool operator==(const ChromaKey &) const = default;
};

} // namespace arift
