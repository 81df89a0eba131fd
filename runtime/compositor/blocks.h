// PanelInputs in the shaders' terms: the numbers of every draw. Pure functions.
#pragma once
#include "runtime/compositor/panel_inputs.h"
#include "runtime/compositor/panel_optics.h"
#include "runtime/compositor/reprojection.h"
#include "shaders/panel_blocks.h"
#include <optional>

namespace arift
{

/// A camera image older than this when it is shown says so: it is dimmed and framed in amber. (Without an image there is a calm pattern.)
constexpr XrDuration staleAge = 250 * millisecond;

/// Both eyes at the top of every band and at the bottom of the last.
using EyesByBand = std::array<std::array<EyeAtLine, 2>, bandCount + 1>;
EyesByBand eyesByBand(const PanelInputs &inputs, const TileGrid &grid, uint32_t height);

/// The camera image an eye shows; null where there is none the Rig knows how to show.
const CameraView *cameraOf(const PanelInputs &inputs, const PanelOptics &optics, size_t eye);

struct EyeDraw {
	const PanelInputs &inputs;
	const PanelOptics &optics;
	const ViewGeometry &geometry;
	const TileGrid &grid;
	size_t eye;
};
/// `camera`: cameraMatrix() by band, or directionMatrix() without a camera.
shaders::EyeBlock eyeBlock(const EyeDraw &draw, uint32_t band, const MatrixByBand &camera);

/// Whether what is drawn with them makes sense.
bool isFinite(const MatrixByBand &matrices);

/// What a shader interpolates within a band.
shaders::MatrixByLine byLine(const MatrixByBand &m, uint32_t band);

/// The layer's uv matrices by band; nothing where this eye does not see it.
std::optional<MatrixByBand> layerMatrices(const PanelLayer &layer, size_t eye, const EyesByBand &eyes);
const LayerTexture &textureOf(const PanelLayer &layer, size_t eye);
/// `width` and `height` of the whole image, texels.
shaders::LayerBlock layerBlock(const PanelLayer &layer, size_t eye, uint32_t band, const MatrixByBand &uv, uint32_t width, uint32_t height);

/// What a layer that is keyed out has besides, and a whole passthrough layer.
void addKey(shaders::LayerBlock &block, const KeyedOut &keyed);
shaders::LayerBlock passthroughBlock(const PassthroughStyle &style);

} // namespace arift
