// What one simulated camera image costs on one core; the bar is 6 ms for 752 x 480. With ARIFT_PICTURE_FOLDER set it also writes one
// de-mosaiced picture of the room per view as PPM, to look at.
#include "drivers/synthetic/motion.h"
#include "drivers/synthetic/renderer.h"
#include "tests/unit/drivers/support.h"
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

using namespace arift;
using namespace arift::synthetic;

namespace
{

std::shared_ptr<const Scene> room()
{
	static const auto scene = std::make_shared<const Scene>(makeRoom());
	return scene;
}

/// Half-size picture: each 2 x 2 cell of the Bayer pattern becomes a pixel, sRGB encoded.
void writePicture(const std::string &file, std::span<const std::byte> raw, uint32_t width, uint32_t height)
{
	std::ofstream out(file, std::ios::binary);
	out << "P6\n" << width / 2 << " " << height / 2 << "\n255\n";
	const auto encoded = [](double linear) { return char(std::lround(255 * std::pow(linear / 255, 1 / 2.2))); };
	const auto at = [&](uint32_t x, uint32_t y) { return std::to_integer<int>(raw[size_t(y) * width + x]); };
	for (uint32_t y = 0; y + 1 < height; y += 2)
		for (uint32_t x = 0; x + 1 < width; x += 2)
			out << encoded(at(x + 1, y)) << encoded((at(x, y) + at(x + 1, y + 1)) / 2.0) << encoded(at(x, y + 1));
}

void image(benchmark::State &state, double yawDegrees, double pitchDegrees, bool withMarkers, const char *name)
{
	std::vector<Marker> markers;
	if (withMarkers) markers = {{{0, 0, -0.4}, 0.012}, {{0.2, 0.1, -1}, 0.03}, {{-0.4, 0.2, -2}, 0.06}, {{0.5, 0.3, -5}, 0.15}};
	Renderer renderer(room(), markers, test::PlainLens{}.geometry(), {.noise = true});
	const glm::dquat head = rotationOf({0, yawDegrees * M_PI / 180, 0}) * rotationOf({pitchDegrees * M_PI / 180, 0, 0});
	std::vector<std::byte> pixels(752 * 480);
	uint64_t count = 0;
	for (auto _ : state) renderer.draw(head, {0, 0, 0}, count++, pixels);
	if (const char *folder = std::getenv("ARIFT_PICTURE_FOLDER")) writePicture(std::string(folder) + "/" + name + ".ppm", pixels, 752, 480);
}

void scene(benchmark::State &state)
{
	for (auto _ : state) benchmark::DoNotOptimize(makeRoom());
}

} // namespace

BENCHMARK_CAPTURE(image, ahead, 0, -10, false, "ahead")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(image, table, 0, -35, false, "table")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(image, left, 50, -5, false, "left")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(image, right, -50, -5, false, "right")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(image, behind, 180, -5, false, "behind")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(image, markers, 0, 0, true, "markers")->Unit(benchmark::kMillisecond);
BENCHMARK(scene)->Unit(benchmark::kMillisecond);
