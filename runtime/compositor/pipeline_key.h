// What tells the renderer's pipelines apart.
#pragma once
#include "runtime/compositor/panel_inputs.h"
#include "runtime/compositor/panel_optics.h"
#include <compare>

namespace arift
{

/// The shader's `background` constant.
enum class Background : uint32_t { none, pattern, camera, unseen };

/// How the cameras' image is drawn: as what lies behind layers, or as a passthrough layer over what is there.
enum class Look : uint32_t { backdrop, faded, styled };

/// Which part of a layer is drawn, in the shader's terms. Tested: what its depth test lets through. Outside: what is outside the range in
/// which it is tested.
enum class Depth : uint32_t { unused, tested, outside };

/// What else a layer, or what is below it, is multiplied by when it is drawn over that: nothing, the alpha below, or the rest to 1.
enum class ByAlphaBelow : uint32_t { no, alpha, rest };
struct AlphaBelowFactors {
	ByAlphaBelow sourceColor{}, keptColor{}, sourceAlpha{}, keptAlpha{};
	auto operator<=>(const AlphaBelowFactors &) const = default; // NOLINT(modernize-use-nullptr): its zero is no pointer
};

struct PipelineKey {
	Blend blend = Blend::replace;
	Background background = Background::none;
	uint32_t camera = 0;  ///< whose lens; 0 without a camera
	bool encoded = false; ///< the camera's values are sRGB encoded
	Cover layer = Cover::none;
	bool layerEncoded = false; ///< the layer's texels are sRGB encoded
	bool throughLens = true;
	Look look = Look::backdrop;
	bool keyed = false;              ///< a colour of the layer stands for what is behind it
	Surface surface = Surface::none; ///< what the layer lies on, where surface.frag draws it
	Depth depth = Depth::unused;
	VkCompareOp compare = VK_COMPARE_OP_ALWAYS; ///< tested: the layer's distance, and the one that is there
	bool writesDepth = false;
	AlphaBelowFactors byAlphaBelow;
	auto operator<=>(const PipelineKey &) const = default; // NOLINT(modernize-use-nullptr): its zero is no pointer
};

/// What is drawn day after day: both cameras with linear values, layers of sRGB encoded texels, through the lens.
std::vector<PipelineKey> usualKeys(const PanelOptics &optics);

} // namespace arift
