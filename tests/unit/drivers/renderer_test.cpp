// What a simulated camera image shows: things where they are, markers to a tenth of a pixel, raw values as a sensor gives them.
#include "drivers/synthetic/motion.h"
#include "drivers/synthetic/renderer.h"
#include "tests/unit/drivers/support.h"
#include <algorithm>
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::synthetic;

namespace
{

const std::shared_ptr<const Scene> &room()
{
	static const auto scene = std::make_shared<const Scene>(makeRoom());
	return scene;
}

std::vector<std::byte> draw(const CameraGeometry &geometry, const std::vector<Marker> &markers, const SensorSettings &sensor,
							const HeadState &head = {}, uint64_t image = 0)
{
	std::vector<std::byte> pixels(size_t(geometry.width) * geometry.height);
	Renderer(room(), markers, geometry, sensor).draw(head.orientation, head.position, image, pixels);
	return pixels;
}

constexpr SensorSettings grey{.format = PixelFormat::grey8};

int at(const std::vector<std::byte> &pixels, uint32_t width, uint32_t x, uint32_t y)
{
	return std::to_integer<int>(pixels[size_t(y) * width + x]);
}

constexpr struct {
	PixelFormat format;
	uint32_t redX, redY;
} patterns[] = {
	{PixelFormat::bayerRggb8, 0, 0}, {PixelFormat::bayerGrbg8, 1, 0}, {PixelFormat::bayerGbrg8, 0, 1}, {PixelFormat::bayerBggr8, 1, 1}};

/// Centroid of the red disc, every pixel seen in red: each Bayer pattern gives a quarter of them. Counts the black surround and no farther.
glm::dvec2 centroid(const test::PlainLens &lens, const CameraGeometry &geometry, const Marker &marker, const HeadState &head,
					glm::dvec2 near, double radius)
{
	glm::dvec2 sum{0};
	double weight = 0;
	for (const auto &pattern : patterns) {
		const auto pixels = draw(geometry, {marker}, {.format = pattern.format}, head);
		for (uint32_t y = pattern.redY; y < lens.height; y += 2)
			for (uint32_t x = pattern.redX; x < lens.width; x += 2) {
				if (glm::length(glm::dvec2{x, y} - near) > radius) continue;
				sum += double(at(pixels, lens.width, x, y)) * glm::dvec2{x, y};
				weight += at(pixels, lens.width, x, y);
			}
	}
	return sum / weight;
}

} // namespace

TEST(Renderer, AMarkerLiesWhereItsDirectionProjects)
{
	struct Case {
		Marker marker;
		HeadState head;
	};
	const auto turned = [](double yaw, double pitch) {
		return HeadState{rotationOf({0, yaw, 0}) * rotationOf({pitch, 0, 0}), {0.01, -0.02, 0.03}, {}, {}, {}};
	};
	const Case cases[] = {{{{0, 0, -1}, 0.02}, {}},
						  {{{0.3, -0.2, -2}, 0.05}, {}},
						  {{{-0.05, 0.1, -0.4}, 0.008}, {}},
						  {{{1, 0.5, -5}, 0.12}, {}},
						  {{{0.2, 0.1, -1}, 0.02}, turned(0.3, 0)},
						  {{{-0.3, 0.3, -1.5}, 0.04}, turned(0.1, 0.1)}};
	const XrPosef upsideDown{rotationAbout({0, 0, 1}, M_PI), {0.032f, 0.01f, -0.08f}};
	double worst = 0;
	for (const bool isEquidistant : {false, true}) {
		const XrPosef mount = isEquidistant ? upsideDown : identityPose;
		const test::PlainLens lens{.width = 320, .height = 240, .focalLength = 210, .isEquidistant = isEquidistant};
		const CameraGeometry geometry = lens.geometry(mount);
		for (const Case &c : cases) {
			const glm::dvec3 inHead = glm::conjugate(c.head.orientation) * (c.marker.position - c.head.position);
			const glm::dvec3 inCamera = glm::conjugate(toGlm(mount.orientation)) * (inHead - toGlm(mount.position));
			const glm::dvec2 expected = lens.project({inCamera.x, -inCamera.y, -inCamera.z});
			const double extent = 1.8 * lens.focalLength * c.marker.radius / glm::length(inCamera);
			const double error = glm::length(centroid(lens, geometry, c.marker, c.head, expected, extent) - expected);
			EXPECT_LT(error, 0.1) << c.marker.position.x << " " << c.marker.position.y << " " << c.marker.position.z << " "
								  << isEquidistant;
			worst = std::max(worst, error);
		}
	}
	std::printf("[ FIGURE   ] marker centroid: worst %.3f px\n", worst);
}

TEST(Renderer, AMarkerIsPureRedOnBlackInTheBayerPattern)
{
	const test::PlainLens lens;
	const std::vector<Marker> marker{{{0, 0, -1}, 0.05}};
	for (const auto &pattern : patterns) {
		const auto pixels = draw(lens.geometry(), marker, {.format = pattern.format});
		for (uint32_t y = 236; y < 244; y++)
			for (uint32_t x = 372; x < 380; x++)
				EXPECT_EQ(at(pixels, 752, x, y), (x & 1) == pattern.redX && (y & 1) == pattern.redY ? 240 : 0) << x << " " << y;
		EXPECT_EQ(at(pixels, 752, 375 + 30, 240), 0) << "the black disc around it";
		EXPECT_GT(at(pixels, 752, 375 + 50, 240), 20) << "the wall behind";
	}
}

TEST(Renderer, ShowsTheRoomFromWhereTheCameraIs)
{
	// one ray at a time: the nearest things along known lines, by their atlas values
	const auto lookAlong = [](const glm::vec3 &direction, const glm::dvec3 &from) {
		CameraGeometry geometry{
			.width = 16, .height = 16, .rays = std::vector<XrVector3f>(256, cvFromXr(toXr(glm::dvec3(glm::normalize(direction)))))};
		return at(draw(geometry, {}, grey, {{1, 0, 0, 0}, from, {}, {}, {}}), 16, 8, 8);
	};
	const int lamp = lookAlong({0, 0.95f, -2.1f}, {0, 0, 0});
	EXPECT_GE(lamp, 250) << "the lamp under the ceiling";
	EXPECT_LT(lookAlong({0.5f, 0.95f, -1.0f}, {0, 0, 0}), lamp) << "the ceiling beside it";
	const int screen = lookAlong({0.3f, -0.95f, -5.05f}, {0, 0, 0});
	const int closer = lookAlong({0.3f, -0.95f, -2.05f}, {0, 0, -3.0});
	const int wall = lookAlong({-0.5f, -0.55f, -5.2f}, {0, 0, 0});
	EXPECT_NEAR(screen, closer, 4) << "the television from two places, a texel apart at most";
	EXPECT_GT(std::abs(screen - wall), 20) << "the wall beside it";
}

TEST(Renderer, TilesSeeEveryBoxTheirRaysMeet)
{
	// the culled image equals that of single-ray tiles, whose cones hold one direction
	const test::PlainLens lens{.width = 752, .height = 480};
	const CameraGeometry geometry = lens.geometry();
	const HeadState head{rotationOf({0, 0.3, 0}) * rotationOf({-0.4, 0, 0}), {0.1, 0, 0}, {}, {}, {}};
	const auto image = draw(geometry, {}, grey, head);
	for (uint32_t y = 3; y < 480; y += 59)
		for (uint32_t x = 5; x < 752; x += 61) {
			const CameraGeometry single{.width = 16, .height = 16, .rays = std::vector<XrVector3f>(256, geometry.rays[y * 752 + x])};
			EXPECT_EQ(at(draw(single, {}, grey, head), 16, 0, 0), at(image, 752, x, y)) << x << " " << y;
		}
}

TEST(Renderer, IsBlackWhereTheLensSeesNothing)
{
	CameraGeometry geometry = test::PlainLens{.width = 40, .height = 24, .focalLength = 30}.geometry();
	const SensorSettings sensor{.format = PixelFormat::grey8, .blackLevel = 0.1};
	const auto whole = draw(geometry, {}, sensor);
	for (uint32_t i = 0; i < geometry.rays.size(); i++)
		if (i % 40 < 20) geometry.rays[i] = {0, 0, 0};
	const auto half = draw(geometry, {}, sensor);
	for (uint32_t y = 0; y < 24; y++)
		for (uint32_t x = 0; x < 40; x++)
			EXPECT_EQ(at(half, 40, x, y), x < 20 ? 26 : at(whole, 40, x, y)) << "the black level of 0.1, or the room";
}

TEST(Renderer, NoiseGrowsWithTheSignalAndChangesWithTheImage)
{
	const CameraGeometry geometry = test::PlainLens{}.geometry();
	const auto clean = draw(geometry, {}, grey);
	const auto one = draw(geometry, {}, {.format = PixelFormat::grey8, .noise = true}, {}, 1);
	const auto other = draw(geometry, {}, {.format = PixelFormat::grey8, .noise = true}, {}, 2);
	double square[2] = {}, mean = 0;
	int count[2] = {}, same = 0;
	for (size_t i = 0; i < clean.size(); i++) {
		const int value = std::to_integer<int>(clean[i]), noisy = std::to_integer<int>(one[i]);
		same += one[i] == other[i];
		mean += double(noisy - value) / double(clean.size());
		if (value > 230 || value < 10) continue;
		const int bright = value > 80;
		square[bright] += double((noisy - value) * (noisy - value));
		count[bright]++;
	}
	ASSERT_GT(count[0], 1000);
	ASSERT_GT(count[1], 1000);
	const double dark = std::sqrt(square[0] / count[0]), bright = std::sqrt(square[1] / count[1]);
	EXPECT_GT(dark, 0.7);
	EXPECT_LT(bright, 2.4);
	EXPECT_GT(bright, 1.2 * dark);
	EXPECT_NEAR(mean, 0, 0.05);
	EXPECT_LT(same, int(clean.size()) / 2);
}

TEST(Renderer, SurvivesAnyPose)
{
	const CameraGeometry geometry = test::PlainLens{.width = 100, .height = 50, .focalLength = 20}.geometry();
	const glm::dvec3 places[] = {{0, -1.6, 0}, {100, 100, 100}, {-0.28, -0.2, -0.32}, {-2.9, 1, -5.2}, {NAN, 0, 0}};
	const std::vector<Marker> markers{{{0, 0, -1}, 0.1}};
	for (const glm::dvec3 &place : places)
		for (const double yaw : {0.0, M_PI / 2, 2.0}) {
			// Drawn over two values, the images differ where a pixel was left out.
			std::array<std::vector<std::byte>, 2> images;
			for (const unsigned before : {0u, 1u}) {
				images[before].assign(size_t(geometry.width) * geometry.height, std::byte(255 * before));
				Renderer(room(), markers, geometry, grey).draw(rotationOf({0, yaw, 0}), place, 0, images[before]);
			}
			EXPECT_EQ(images[0], images[1]) << place.x << " " << yaw;
			EXPECT_GT(std::ranges::max(images[0]), std::byte(0)) << "an image of something: " << place.x << " " << yaw;
		}
}

TEST(Renderer, TheRoomIsWhole)
{
	const Scene &scene = *room();
	ASSERT_EQ(scene.surfaces.size(), 6 * (1 + scene.boxes.size()));
	for (const auto &plane : scene.atlas) EXPECT_EQ(plane.size(), scene.atlas[0].size());
	for (const Surface &surface : scene.surfaces) EXPECT_LE(surface.base + surface.stride * surface.height, scene.atlas[0].size());
	double nearest = 10, farthest = 0;
	for (const Box &box : scene.boxes) {
		const double distance = glm::length(glm::max(glm::max(box.low, -box.high), glm::vec3(0)));
		nearest = std::min(nearest, distance);
		farthest = std::max(farthest, distance);
	}
	EXPECT_LT(nearest, 0.5);
	EXPECT_GT(nearest, 0.3);
	EXPECT_GT(farthest, 4.5);
}
