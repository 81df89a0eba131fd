// What a projection, an unprojection, a whole image of rays and a shader fit cost on the CPU.
#include "runtime/optics/camera_model.h"
#include "runtime/optics/lens_model.h"
#include "runtime/optics/pixel_rays.h"
#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

namespace arift
{
namespace
{

CameraModel model(int64_t index)
{
	switch (index) {
	case 0:
		return CameraModel(752, 480, OCam{{-206.517, 0, 2.207161e-3, -4.879622e-6, 1.865656e-8}, {}, 241.8, 394.55, 1.0003, 2e-4, 2e-4});
	case 1: return CameraModel(752, 480, OCam{{}, {712.870100, 580.959756, 188.838455, 105.465531, 27.232993, 2.433748}, 236.646, 394.136});
	case 2: return CameraModel(752, 480, KannalaBrandt{420.3184, 420.5, 393.1, 236.6, {-0.0047, 0.0229, -0.00648, 0.00159}});
	case 3: return CameraModel(752, 480, Mei{1.9, 1250, 1245, 380, 236, {-0.21, 0.14, 0.0011, -0.0008}});
	case 4: return CameraModel(752, 480, RadTan{458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}});
	default: return CameraModel(512, 512, DoubleSphere{-0.2996, 0.5733, 158.28, 158.28, 254.97, 256.88});
	}
}

void label(benchmark::State &state, const CameraModel &camera)
{
	const auto *ocam = std::get_if<OCam>(&camera.parameters());
	state.SetLabel(ocam && ocam->direct.empty() ? "ocam by its inverse" : camera.name());
}

void project(benchmark::State &state)
{
	const CameraModel camera = model(state.range(0));
	label(state, camera);
	glm::dvec3 direction(0.3, -0.2, 1);
	for (auto _ : state) {
		direction.x = -direction.x;
		benchmark::DoNotOptimize(camera.project(direction));
	}
}
BENCHMARK(project)->DenseRange(0, 5);

void unproject(benchmark::State &state)
{
	const CameraModel camera = model(state.range(0));
	label(state, camera);
	glm::dvec2 pixel(500, 100);
	for (auto _ : state) {
		pixel.x = 700 - pixel.x;
		benchmark::DoNotOptimize(camera.unproject(pixel));
	}
}
BENCHMARK(unproject)->DenseRange(0, 5);

void allPixelRays(benchmark::State &state)
{
	const CameraModel camera = model(state.range(0));
	label(state, camera);
	for (auto _ : state) benchmark::DoNotOptimize(pixelRays(camera));
}
BENCHMARK(allPixelRays)->DenseRange(0, 5)->Unit(benchmark::kMillisecond);

void cameraFit(benchmark::State &state)
{
	const CameraModel camera = model(state.range(0));
	label(state, camera);
	for (auto _ : state) benchmark::DoNotOptimize(fitForShader(camera));
}
BENCHMARK(cameraFit)->DenseRange(0, 5)->Unit(benchmark::kMillisecond);

void lensFit(benchmark::State &state)
{
	const LensModel lens(SplineLens{});
	for (auto _ : state) benchmark::DoNotOptimize(fitForShader(lens));
}
BENCHMARK(lensFit)->Unit(benchmark::kMillisecond);

void lensPixel(benchmark::State &state)
{
	const LensModel lens(SplineLens{});
	glm::dvec2 tangents(0.5, 0.4);
	for (auto _ : state) {
		tangents.y = -tangents.y;
		benchmark::DoNotOptimize(lens.pixel(Eye::left, Channel::blue, tangents));
	}
}
BENCHMARK(lensPixel);

} // namespace
} // namespace arift
