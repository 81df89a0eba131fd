#include "runtime/compositor/blocks.h"
#include <algorithm>
#include <cmath>

namespace arift
{

namespace
{

/// What no camera sees: a dim blue-grey, near the darkest a room's walls get, so that the images' edge is no edge of the world.
constexpr glm::vec3 calm{0.018f, 0.021f, 0.026f};
constexpr glm::vec3 amber{0.16f, 0.07f, 0.008f};
constexpr float staleWeight = 0.6f;

shaders::MatrixByLine byLine(const MatrixByBand &m, uint32_t band)
{
	shaders::MatrixByLine block{};
	for (int column = 0; column < 3; ++column) {
		block.first[column] = glm::vec4(glm::dvec4(m[band][column], 0));
		block.change[column] = glm::vec4(glm::dvec4(m[band + 1][column] - m[band][column], 0));
	}
	return block;
}

/// Where red is in the two-by-two cell: column, row.
glm::vec2 redOf(PixelFormat format)
{
	switch (format) {
	case PixelFormat::bayerGrbg8: return {1, 0};
	case PixelFormat::bayerGbrg8: return {0, 1};
	case PixelFormat::bayerBggr8: return {1, 1};
	default: return {0, 0};
	}
}

void describePlanes(shaders::EyeBlock &block, const CameraFrame &frame)
{
	if (!isBayer(frame.format)) {
		const glm::vec2 perTexel(1.0f / float(frame.width), 1.0f / float(frame.height));
		block.plane = {perTexel.x, perTexel.y, 1, 0};
		block.planeOffset[0] = {perTexel.x / 2, perTexel.y / 2, 0, 0};
		return;
	}
	// A half plane holds every second texel of every second row: its texel i is the image's 2 i + where.
	const glm::vec2 size(float(frame.width / 2), float(frame.height / 2)), red = redOf(frame.format);
	const auto offset = [&](float x, float y) { return (0.5f - glm::vec2(x, y) / 2.0f) / size; };
	const glm::vec2 r = offset(red.x, red.y), firstGreen = offset(1 - red.x, red.y);
	const glm::vec2 secondGreen = offset(red.x, 1 - red.y), b = offset(1 - red.x, 1 - red.y);
	block.plane = {0.5f / size.x, 0.5f / size.y, 1 - red.x, red.x};
	block.planeOffset[0] = {r.x, r.y, firstGreen.x, firstGreen.y};
	block.planeOffset[1] = {secondGreen.x, secondGreen.y, b.x, b.y};
}

void describeCamera(shaders::EyeBlock &block, const CameraView &view)
{
	const float dark = float(view.blackLevel), range = 1 / std::max(1 - dark, 1e-3f);
	block.colour = {view.whiteBalance[0] * range, view.whiteBalance[1] * range, view.whiteBalance[2] * range, dark};
	describePlanes(block, view.frame);
}

bool isFinite(const MatrixByBand &matrices)
{
	for (const glm::dmat3 &m : matrices)
		for (int column = 0; column < 3; ++column)
			for (int row = 0; row < 3; ++row)
				if (!std::isfinite(m[column][row]) || std::abs(m[column][row]) > 1e9) return false;
	return true;
}

} // namespace

std::array<std::array<EyeAtLine, 2>, bandCount + 1> eyesByBand(const PanelInputs &inputs, const TileGrid &grid, uint32_t height)
{
	std::array<std::array<EyeAtLine, 2>, bandCount + 1> eyes;
	for (uint32_t band = 0; band <= bandCount; ++band)
		eyes[band] = eyesAtLine(inputs, (grid.bandBegin(band) - 0.5) / std::max(height - 1.0, 1.0));
	return eyes;
}

const CameraView *cameraOf(const PanelInputs &inputs, const PanelOptics &optics, size_t eye)
{
	const auto &view = inputs.cameras[eye];
	if (!view || !view->frame.buffer || view->lens >= optics.cameras.size()) return nullptr;
	const PanelCamera &camera = optics.cameras[view->lens];
	const CameraFrame &frame = view->frame;
	const size_t row = size_t(frame.width) * bytesPerPixel(frame.format);
	if (frame.width != camera.width || frame.height != camera.height || frame.stride < row || frame.width < 2 || frame.height < 2)
		return nullptr;
	return frame.buffer->bytes().size() >= size_t(frame.stride) * (frame.height - 1) + row ? &*view : nullptr;
}

shaders::EyeBlock eyeBlock(const EyeDraw &draw, uint32_t band, const MatrixByBand &camera)
{
	shaders::EyeBlock block{};
	const glm::dvec2 axis = draw.geometry.eyes[draw.eye].axis;
	const double begin = draw.grid.bandBegin(band), end = draw.grid.bandBegin(band + 1);
	block.lines = {begin, 1 / (end - begin), axis.x, axis.y};
	block.camera = byLine(camera, band);
	const CameraView *view = cameraOf(draw.inputs, draw.optics, draw.eye);
	const bool stale = view && draw.inputs.displayTime - view->frame.midExposure > staleAge;
	if (view) {
		describeCamera(block, *view);
		block.weight.x = std::clamp(view->weight, 0.0f, 1.0f) * (stale ? staleWeight : 1.0f);
	}
	const float hides = draw.inputs.blendMode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE ? 0.0f : 1.0f;
	block.fill = glm::vec4(stale ? amber : calm, hides);
	return block;
}

std::optional<MatrixByBand> layerMatrices(const PanelLayer &layer, size_t eye,
										  const std::array<std::array<EyeAtLine, 2>, bandCount + 1> &eyes)
{
	MatrixByBand matrices;
	for (uint32_t band = 0; band <= bandCount; ++band) {
		if (layer.projection[eye]) {
			matrices[band] = projectionMatrix(eyes[band][eye], layer.headLocked, *layer.projection[eye]);
		} else if (layer.quad[eye]) {
			const auto matrix = quadMatrix(eyes[band][eye], layer.headLocked, *layer.quad[eye]);
			if (!matrix) return std::nullopt;
			matrices[band] = *matrix;
		} else {
			return std::nullopt;
		}
	}
	return isFinite(matrices) ? std::optional(matrices) : std::nullopt;
}

const LayerTexture &textureOf(const PanelLayer &layer, size_t eye)
{
	return layer.projection[eye] ? layer.projection[eye]->texture : layer.quad[eye]->texture;
}

bool isOpaque(const PanelLayer &layer) { return !(layer.flags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT); }

shaders::LayerBlock layerBlock(const PanelLayer &layer, size_t eye, uint32_t band, const MatrixByBand &uv, uint32_t width, uint32_t height)
{
	const LayerTexture &texture = textureOf(layer, eye);
	const glm::dvec2 size(width, height), corner(texture.rect.offset.x, texture.rect.offset.y);
	const glm::dvec2 extent(texture.rect.extent.width, texture.rect.extent.height);
	const glm::dvec2 least = (corner + 0.5) / size, most = (corner + extent - 0.5) / size;
	const bool multiply = !isOpaque(layer) && (layer.flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT);
	shaders::LayerBlock block{};
	block.uv = byLine(uv, band);
	block.rect = {corner.x / size.x, corner.y / size.y, extent.x / size.x, extent.y / size.y};
	block.inside = {least.x, least.y, most.x, most.y};
	block.uv.first[0].w = float(texture.arrayIndex);
	block.uv.first[1].w = isOpaque(layer) ? 0 : 1;
	block.uv.first[2].w = multiply ? 1 : 0;
	return block;
}

} // namespace arift
