// Cost of PanelRenderer::render by what there is to draw: original rig, raw Bayer of 752x480, layers of 1122x1553 per eye in sRGB.
#include "runtime/compositor/panel_renderer.h"
#include "runtime/gpu/handles.h"
#include "runtime/optics/rig.h"
#include <benchmark/benchmark.h>
#include <cmath>

namespace arift
{
namespace
{

constexpr uint32_t viewWidth = 1122, viewHeight = 1553;

/// Layers of this are drawn everywhere, those of transparent black nowhere.
const vk::ClearColorValue translucent(std::array{0.05f, 0.1f, 0.2f, 0.5f});

void fill(gpu::Device &device, const gpu::SharedImage &shared, const vk::ClearColorValue &colour)
{
	using Access = vk::AccessFlagBits;
	using Layout = vk::ImageLayout;
	using Stage = vk::PipelineStageFlagBits;
	gpu::Device::Handles &gpu = device.handles();
	const auto boundary = Layout(gpu::boundaryLayout(VkFormat(shared.spec().format)));
	const vk::ImageSubresourceRange all{vk::ImageAspectFlagBits::eColor, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
	gpu.runOnce([&](const vk::raii::CommandBuffer &commands) {
		commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
								 vk::ImageMemoryBarrier{{},
														Access::eTransferWrite,
														boundary,
														Layout::eTransferDstOptimal,
														VK_QUEUE_FAMILY_EXTERNAL,
														gpu.queueFamily,
														shared.image(),
														all});
		commands.clearColorImage(shared.image(), Layout::eTransferDstOptimal, colour, all);
		commands.pipelineBarrier(Stage::eTransfer, Stage::eBottomOfPipe, {}, {}, {},
								 vk::ImageMemoryBarrier{Access::eTransferWrite,
														{},
														Layout::eTransferDstOptimal,
														boundary,
														gpu.queueFamily,
														VK_QUEUE_FAMILY_EXTERNAL,
														shared.image(),
														all});
	});
}

struct Scene {
	Scene() : rig(readRig(ARIFT_RIG)), renderer(device, rig)
	{
		renderer.warmUp();
		gpu::ImageSpec spec{.format = VK_FORMAT_R8G8B8A8_SRGB,
							.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
							.width = viewWidth,
							.height = viewHeight,
							.arrayLayers = 2};
		spec.inRows = gpu::canLieInRows(device.identity().deviceType, spec) ? 1 : 0;
		views.emplace(device, spec);
		fill(device, *views, translucent);
		renderer.addImage(1, views->image(), spec, views->rows());
		for (size_t e = 0; e < 2; ++e) {
			const CameraModel &model = rig.cameras[e].model;
			CameraFrame frame{.sequence = 1,
							  .format = PixelFormat::bayerRggb8,
							  .width = model.width(),
							  .height = model.height(),
							  .stride = model.width(),
							  .buffer = makeHostFrameBuffer(size_t(model.width()) * model.height())};
			for (size_t i = 0; i < frame.buffer->bytes().size(); ++i) frame.buffer->bytes()[i] = std::byte(i * 7919 % 251);
			inputs.cameras[e] = CameraView{.frame = frame, .cameraInOrigin = rig.cameras[e].cameraInHead, .lens = uint32_t(e)};
			inputs.top[e] = inputs.bottom[e] = {rig.eyeInHead[e], identityPose};
			const XrQuaternionf turned = rotationAbout({0, 1, 0}, 0.05);
			inputs.bottom[e].viewInOrigin.orientation = turned;
		}
	}
	void addProjection(bool opaque)
	{
		PanelLayer &layer = inputs.layers.emplace_back();
		layer.flags = opaque ? 0 : XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
		for (uint32_t e = 0; e < 2; ++e) {
			const auto fov = rig.lens.fov(Eye(e), rig.interpupillaryDistance);
			const XrFovf angles{-float(std::atan(fov.left)), float(std::atan(fov.right)), float(std::atan(fov.up)),
								-float(std::atan(fov.down))};
			layer.projection[e] = ProjectionView{rig.eyeInHead[e], angles, {1, e, {{0, 0}, {int32_t(viewWidth), int32_t(viewHeight)}}}};
		}
	}
	/// Of an askew wall half a metre to a few metres away, drawn for eyes that were `moved` metres further to the left.
	void addDeepProjection(float moved)
	{
		depths.emplace(device, gpu::ImageSpec{.format = VK_FORMAT_D32_SFLOAT,
											  .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
											  .width = viewWidth,
											  .height = viewHeight,
											  .arrayLayers = 2});
		std::vector<float> values(size_t(viewWidth) * viewHeight);
		for (size_t i = 0; i < values.size(); ++i) values[i] = 0.02f + 0.18f * float(i % viewWidth) / float(viewWidth);
		for (uint32_t e = 0; e < 2; ++e) depths->write(e, std::as_bytes(std::span(values)));
		renderer.addImage(2, depths->image(), depths->spec());
		addProjection(false);
		for (uint32_t e = 0; e < 2; ++e) {
			auto &view = inputs.layers.back().projection[e];
			view->viewInFrame.position.x -= moved;
			view->depth = ViewDepth{{2, e, view->texture.rect}, 0, 10};
		}
	}
	void addQuad(float size, float x)
	{
		PanelLayer &layer = inputs.layers.emplace_back();
		layer.flags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
		for (auto &quad : layer.quad) quad = QuadView{{identityOrientation, {x, 0, -1}}, {size, size}, {1, 0, {{0, 0}, {512, 512}}}};
	}
	void render()
	{
		for (auto &camera : inputs.cameras)
			if (camera) ++camera->frame.sequence;
		renderer.render(inputs);
	}

	gpu::Device device;
	Rig rig;
	std::optional<gpu::SharedImage> views, depths;
	PanelRenderer renderer;
	PanelInputs inputs;
};

template <typename SetUp> void measure(benchmark::State &state, SetUp setUp)
{
	Scene scene;
	setUp(scene);
	for (int warm = 0; warm < 3; ++warm) scene.render();
	for (auto _ : state) scene.render();
}

void nothing(benchmark::State &state)
{
	measure(state, [](Scene &scene) { scene.inputs.cameras = {}; });
}
void cameraOnly(benchmark::State &state)
{
	measure(state, [](Scene &) {});
}
void cameraAndSmallQuad(benchmark::State &state)
{
	measure(state, [](Scene &scene) { scene.addQuad(0.3f, 0); });
}
void cameraAndEmptyLayer(benchmark::State &state)
{
	measure(state, [](Scene &scene) {
		fill(scene.device, *scene.views, {});
		scene.addProjection(false);
	});
}
void cameraAndFullLayer(benchmark::State &state)
{
	measure(state, [](Scene &scene) { scene.addProjection(false); });
}
/// The argument: tenths of a millimetre that the eyes have moved.
void cameraAndDeepLayer(benchmark::State &state)
{
	measure(state, [&](Scene &scene) { scene.addDeepProjection(float(state.range(0)) * 1e-4f); });
}
void opaqueLayer(benchmark::State &state)
{
	measure(state, [](Scene &scene) {
		scene.inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
		scene.addProjection(true);
	});
}
void cameraFullLayerAndFourQuads(benchmark::State &state)
{
	measure(state, [](Scene &scene) {
		scene.addProjection(false);
		for (int i = 0; i < 4; ++i) scene.addQuad(0.3f, 0.35f * float(i) - 0.5f);
	});
}
/// No worse than linear: cost against the number of layers, with content and hidden behind the viewer.
void layers(benchmark::State &state, double ahead)
{
	measure(state, [&](Scene &scene) {
		for (int64_t i = 0; i < state.range(0); ++i) {
			scene.addQuad(0.2f, 0.02f * float(i % 16) - 0.15f);
			for (auto &quad : scene.inputs.layers.back().quad) quad->quadInFrame.position.z = float(-ahead);
		}
	});
}
/// The same panel, images of one to four times as many texels.
void imageSize(benchmark::State &state)
{
	measure(state, [&](Scene &scene) {
		scene.addProjection(false);
		for (auto &view : scene.inputs.layers.back().projection) {
			view->texture.rect.extent.width /= int32_t(state.range(0));
			view->texture.rect.extent.height /= int32_t(state.range(0));
		}
	});
}
void makeRenderer(benchmark::State &state)
{
	gpu::Device device;
	const Rig rig = readRig(ARIFT_RIG);
	for ([[maybe_unused]] auto _ : state) PanelRenderer(device, rig).warmUp();
}

#define ARIFT_FRAME_BENCHMARK(name) BENCHMARK(name)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
ARIFT_FRAME_BENCHMARK(nothing);
ARIFT_FRAME_BENCHMARK(cameraOnly);
ARIFT_FRAME_BENCHMARK(cameraAndSmallQuad);
ARIFT_FRAME_BENCHMARK(cameraAndEmptyLayer);
ARIFT_FRAME_BENCHMARK(cameraAndFullLayer);
ARIFT_FRAME_BENCHMARK(cameraAndDeepLayer)->Arg(0)->Arg(5)->Arg(15)->Arg(50)->Arg(150)->Arg(400);
ARIFT_FRAME_BENCHMARK(opaqueLayer);
ARIFT_FRAME_BENCHMARK(cameraFullLayerAndFourQuads);
ARIFT_FRAME_BENCHMARK(makeRenderer);
#define ARIFT_LAYER_BENCHMARK(name, ahead)                                                                                                 \
	BENCHMARK_CAPTURE(layers, name, ahead)                                                                                                 \
		->RangeMultiplier(4)                                                                                                               \
		->Range(1, 64)                                                                                                                     \
		->Unit(benchmark::kMillisecond)                                                                                                    \
		->UseRealTime()                                                                                                                    \
		->MeasureProcessCPUTime()
ARIFT_LAYER_BENCHMARK(shown, 1.0);
ARIFT_LAYER_BENCHMARK(hidden, -1.0);
ARIFT_FRAME_BENCHMARK(imageSize)->Arg(1)->Arg(2)->Arg(4);

} // namespace
} // namespace arift
