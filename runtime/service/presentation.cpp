#include "runtime/service/presentation.h"

namespace arift
{

namespace
{

constexpr XrCompositionLayerFlags sourceAlpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;

bool isPlain(const PassthroughStyle &style) { return style.opacity >= 1 && !style.isChanged(); }
bool isInvisible(const PassthroughStyle &style) { return style.opacity <= 0 && style.edge.a <= 0; }

/// An opaque layer's alpha is what the opacity says, whatever its image holds.
void fade(PanelLayer &layer, float opacity)
{
	if (opacity >= 1) return;
	if (layer.flags & sourceAlpha) {
		layer.colorScale.a *= opacity;
		layer.colorBias.a *= opacity;
		return;
	}
	layer.flags |= sourceAlpha | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
	layer.colorScale.a = 0;
	layer.colorBias.a = opacity;
}

} // namespace

void addPassthrough(FrameContent &content, const Presentation &presentation, uint32_t number)
{
	const PassthroughPlace &place = presentation.passthrough.at(number);
	// Where light is added to the world, the world is seen already.
	const bool isSeen = presentation.passthroughRuns && place.shown && content.blendMode != XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
	if (!isSeen || isInvisible(place.style)) return;
	if (!isPlain(place.style)) {
		content.layers.push_back({.passthrough = place.style});
		return;
	}
	content.layers.clear();
	content.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
}

void force(FrameContent &content, const ForcedPassthrough &forced)
{
	if (forced.mode == ipc::Forced::off) return;
	content.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	for (PanelLayer &layer : content.layers) {
		if (layer.passthrough) continue;
		if (forced.mode == ipc::Forced::alpha) layer.flags |= sourceAlpha;
		if (forced.mode == ipc::Forced::chroma)
			layer.key = {forced.key, forced.opacity};
		else
			fade(layer, forced.opacity);
	}
}

PassthroughStyle styleOf(const ipc::StylePassthrough &message)
{
	return {.opacity = message.opacity,
			.edge = message.edge,
			.brightness = message.brightness,
			.contrast = message.contrast,
			.saturation = message.saturation};
}

} // namespace arift
