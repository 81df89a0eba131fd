// Which part of an eye's image a camera sees: the original's lenses cover about half of the DK1's view. Pure functions.
#pragma once
#include "runtime/compositor/panel_optics.h"
#include <optional>

namespace arift
{

/// Texel of a direction in the camera's frame (x right, y down, z forward; any length), integers at texel centres; nothing where the
/// direction is further off the axis than the lens sees. ShaderCamera's own formula.
std::optional<glm::dvec2> texelOf(const PanelCamera &camera, const glm::dvec3 &direction);

/// By tile, row by row: whether the camera may see something there, in any colour. Never false in error.
FrameVector<bool> seenTiles(const TileGrid &grid, const MatrixByBand &cameraMatrix, const PanelCamera &camera);

} // namespace arift
