#include "runtime/compositor/blocks.h"
#include "runtime/compositor/camera_sites.h"
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

/// Texels to sites of the frame's lattices (camera_sites.h).
void describeSites(shaders::EyeBlock &block, const CameraFrame &frame)
{
	const SiteImage image = siteImageOf(frame);
	const float plane = float(image.height);
	block.siteScale = {1, 0, float(image.width) - 1, plane * float(image.planes) - 1};
	if (image.planes == 1) return;
	block.siteScale.x = 0.5f;
	// The middle of both greens is the middle of the cell.
	const auto [redX, redY] = redOf(frame.format);
	block.siteOffset[0] = {-float(redX) / 2, -float(redY) / 2, -0.25f, plane - 0.25f};
	block.siteOffset[1] = {-float(1 - redX) / 2, 2 * plane - float(1 - redY) / 2, 0, 0};
}

void describeCamera(shaders::EyeBlock &block, const CameraView &view)
{
	const float dark = float(view.blackLevel), range = 1 / std::max(1 - dark, 1e-3f);
	block.colour = {view.whiteBalance[0] * range, view.whiteBalance[1] * range, view.whiteBalance[2] * range, dark};
	describeSites(block, view.frame);
}

} // namespace

bool isFinite(const MatrixByBand &matrices)
{
	for (const glm::dmat3 &m : matrices)
		for (int column = 0; column < 3; ++column)
			for (int row = 0; row < 3; ++row)
				if (!std::isfinite(m[column][row]) || std::abs(m[column][row]) > 1e9) return false;
	return true;
}

shaders::MatrixByLine byLine(const MatrixByBand &m, uint32_t band)
{
	shaders::MatrixByLine block{};
	for (int column = 0; column < 3; ++column) {
		block.first[column] = glm::vec4(glm::dvec4(m[band][column], 0));
		block.change[column] = glm::vec4(glm::dvec4(m[band + 1][column] - m[band][column], 0));
	}
	return block;
}

EyesByBand eyesByBand(const PanelInputs &inputs, const TileGrid &grid, uint32_t height)
{
	EyesByBand eyes;
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
		block.siteScale.y = std::clamp(view->weight, 0.0f, 1.0f) * (stale ? staleWeight : 1.0f);
	}
	const float hides = draw.inputs.blendMode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE ? 0.0f : 1.0f;
	block.fill = glm::vec4(stale ? amber : calm, hides);
	return block;
}

std::optional<MatrixByBand> layerMatrices(const PanelLayer &layer, size_t eye, const EyesByBand &eyes)
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
	if (layer.projection[eye]) return layer.projection[eye]->texture;
	if (layer.quad[eye]) return layer.quad[eye]->texture;
	return layer.curved[eye] ? layer.curved[eye]->texture : layer.cube[eye]->texture;
}

shaders::LayerBlock layerBlock(const PanelLayer &layer, size_t eye, uint32_t band, const MatrixByBand &uv, uint32_t width, uint32_t height)
{
	const LayerTexture &texture = textureOf(layer, eye);
	const glm::dvec2 corner(texture.rect.offset.x, texture.rect.offset.y), extent(texture.rect.extent.width, texture.rect.extent.height);
	const glm::dmat3 toTexel(extent.x, 0, 0, 0, extent.y, 0, corner.x - 0.5, corner.y - 0.5, 1);
	MatrixByBand texel;
	std::ranges::transform(uv, texel.begin(), [&](const glm::dmat3 &m) { return toTexel * m; });
	shaders::LayerBlock block{};
	block.texel = byLine(texel, band);
	block.bounds = {corner.x, corner.y, corner.x + extent.x - 1, corner.y + extent.y - 1};
	block.mode = {1.0f / float(width), 1.0f / float(height), layer.isOpaque() ? 1 : 0, layer.isStraight() ? 1 : 0};
	if (layer.key) addKey(block, *layer.key);
	return block;
}

void addKey(shaders::LayerBlock &block, const KeyedOut &keyed)
{
	const auto &[red, green, blue] = keyed.key.colour;
	const std::array first{red, green, blue};
	for (int column = 0; column < 3; ++column) block.texel.first[column].w = first[size_t(column)];
	const std::array change{keyed.key.tolerance, keyed.key.softness, keyed.opacity};
	for (int column = 0; column < 3; ++column) block.texel.change[column].w = change[size_t(column)];
}

shaders::LayerBlock passthroughBlock(const PassthroughStyle &style)
{
	shaders::LayerBlock block{};
	block.texel.first[0].w = style.map ? 1 : 0;
	block.bounds = {style.opacity, style.brightness, style.contrast, style.saturation};
	block.mode = {style.edge.r, style.edge.g, style.edge.b, style.edge.a};
	return block;
}

} // namespace arift
