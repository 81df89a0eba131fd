#include "runtime/service/presentation.h"
#include <algorithm>
#include <tuple>

namespace arift
{

namespace
{

constexpr XrCompositionLayerFlags sourceAlpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;

bool isPlain(const PassthroughStyle &style) { return style.opacity >= 1 && !style.isChanged(); }
bool isInvisible(const PassthroughStyle &style) { return style.opacity <= 0 && style.edge.a <= 0; }
/// Of a map nobody knows how opaque it is.
bool hidesAll(const PassthroughStyle &style) { return style.opacity >= 1 && !style.map; }

/// Two layers without anything between that show the same picture everywhere equally opaque are one that is more so.
bool isMerged(PanelLayer &below, const PassthroughStyle &style)
{
	if (!below.passthrough || below.passthrough->map || style.map) return false;
	const auto pictureOf = [](const PassthroughStyle &each) {
		return std::tuple(each.brightness, each.contrast, each.saturation, each.edge.a > 0);
	};
	if (style.edge.a > 0 || pictureOf(*below.passthrough) != pictureOf(style)) return false;
	float &opacity = below.passthrough->opacity;
	opacity = 1 - (1 - opacity) * (1 - style.opacity);
	return true;
}

/// An opaque layer's alpha is what the opacity says, whatever its image holds.
void fade(PanelLayer &layer, float opacity)
{
	if (opacity >= 1) return;
	if (layer.hasAlpha()) {
		layer.colorScale.a *= opacity;
		layer.colorBias.a *= opacity;
		return;
	}
	layer.flags |= sourceAlpha | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
	layer.colorScale.a = 0;
	layer.colorBias.a = opacity;
}

/// Black was below the lowest layer: whatever alpha its premultiplied image has, nobody could see it, and applications leave there what
/// they like.
void ignoreAlpha(PanelLayer &lowest)
{
	if (!(lowest.flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT)) lowest.flags &= ~sourceAlpha;
}

} // namespace

void addPassthrough(FrameContent &content, const Presentation &presentation, uint32_t number)
{
	const PassthroughPlace &place = presentation.passthrough.at(number);
	// Where light is added to the world, the world is seen already.
	const bool isSeen = presentation.passthroughRuns && place.shown && content.blendMode != XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
	if (!isSeen || isInvisible(place.style)) return;
	if (hidesAll(place.style)) {
		content.layers.clear();
		content.hidesOthers = true;
		content.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	}
	if (isPlain(place.style) || (!content.layers.empty() && isMerged(content.layers.back(), place.style))) return;
	const auto isPassthrough = [](const PanelLayer &layer) { return layer.passthrough.has_value(); };
	if (std::ranges::count_if(content.layers, isPassthrough) >= ptrdiff_t(ipc::maxPassthroughLayers)) return;
	content.layers.push_back({.passthrough = place.style});
}

void force(FrameContent &content, const Presentation &presentation)
{
	const ForcedPassthrough &forced = presentation.forced;
	if (forced.mode == ipc::Forced::off) return;
	const bool overBlack = content.blendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE && !presentation.overlay;
	content.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	for (PanelLayer &layer : content.layers) {
		if (layer.passthrough) continue;
		if (forced.mode == ipc::Forced::chroma && overBlack && &layer == &content.layers.front()) ignoreAlpha(layer);
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
