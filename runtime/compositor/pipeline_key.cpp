#include "runtime/compositor/pipeline_key.h"

namespace arift
{

namespace
{

/// What can lie behind layers.
std::vector<PipelineKey> backdrops(const PanelOptics &optics)
{
	std::vector<PipelineKey> keys{{.background = Background::pattern}, {.background = Background::unseen}};
	for (uint32_t camera = 0; camera < optics.cameras.size(); ++camera)
		keys.push_back({.background = Background::camera, .camera = camera});
	return keys;
}

} // namespace

std::vector<PipelineKey> usualKeys(const PanelOptics &optics)
{
	std::vector<PipelineKey> keys{{}, {.blend = Blend::clear}};
	for (PipelineKey key : backdrops(optics)) {
		keys.push_back(key);
		// A layer over everything is drawn with what is behind it.
		if (key.background != Background::pattern) {
			keys.push_back(key);
			keys.back().layer = Cover::fully;
			keys.back().layerEncoded = true;
		}
		keys.push_back(key);
		keys.back().blend = Blend::under;
		// As a layer: what the cameras do not see is the same picture's fill.
		for (const Look look : {Look::faded, Look::styled}) {
			if (key.background == Background::unseen) break;
			keys.push_back(key);
			keys.back().blend = Blend::over;
			keys.back().look = look;
		}
	}
	for (const Cover cover : {Cover::fully, Cover::opaque}) keys.push_back({.layer = cover, .layerEncoded = true});
	for (const Cover cover : {Cover::fully, Cover::partly}) keys.push_back({.blend = Blend::over, .layer = cover, .layerEncoded = true});
	keys.push_back({.blend = Blend::over, .layer = Cover::partly, .layerEncoded = true, .keyed = true});
	// Layers that are not plain are drawn over what is there.
	for (const Surface surface : {Surface::flat, Surface::cylinder, Surface::sphere, Surface::cube})
		keys.push_back({.blend = Blend::over, .layer = Cover::partly, .surface = surface});
	return keys;
}

} // namespace arift
