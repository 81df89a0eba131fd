// In which order the layers of several applications are drawn: the nearer ones over those farther away.
#pragma once
#include "runtime/compositor/panel_inputs.h"
#include <span>

namespace arift
{

/// Metres from the head to the nearest point of what a layer's image lies on; the greatest finite number where that says nothing of how
/// far away its holograms are (projections, cubes, spheres of infinite radius); infinity for the cameras' image.
double distanceOf(const PanelLayer &layer, const XrPosef &headInOrigin);

/// Appends every application's layers to `all`, each application's in their own order: again and again the farthest of those that are next,
/// of equally far ones that of the application named first. Takes memory only where `all` has too little, and for the frame.
void mergeByDistance(std::span<const std::span<const PanelLayer>> applications, const XrPosef &headInOrigin, std::vector<PanelLayer> &all);

} // namespace arift
