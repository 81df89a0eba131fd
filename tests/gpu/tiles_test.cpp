// Which tiles are drawn with what, and the matrices behind it: without a GPU.
#include "runtime/compositor/reprojection.h"
#include "runtime/compositor/tiles.h"
#include <gtest/gtest.h>
#include <map>

namespace arift
{
namespace
{

/// 640 x 400 pixels; tangents -1..1 and -0.625..0.625.
TileGrid plainGrid(double radius = 1e9)
{
	return TileGrid({0, 0, 640, 400}, {320, 200}, radius, [](glm::dvec2 p) { return glm::dvec2((p.x - 320) / 320, (200 - p.y) / 320); });
}
/// u = (x - left) / (right - left), v likewise downwards.
MatrixByBand window(double left, double right, double up, double down)
{
	const glm::dmat3 m =
		glm::transpose(glm::dmat3{1 / (right - left), 0, -left / (right - left), 0, -1 / (up - down), up / (up - down), 0, 0, 1});
	return {m, m, m};
}

/// Of a layer that has content everywhere.
FrameVector<Cover> covered(const TileGrid &grid, const MatrixByBand &m, Content content = Content::some)
{
	return coverage(grid, m, {0, 0}, [=](auto, auto) { return content; });
}

/// How often each pixel is drawn, by blend.
std::map<Blend, std::vector<int>> painted(const FrameVector<TileDraw> &draws)
{
	std::map<Blend, std::vector<int>> counts;
	for (const TileDraw &draw : draws) {
		auto &count = counts[draw.blend];
		count.resize(640 * 400);
		for (const PixelRect &rect : draw.rects)
			for (int y = rect.y0; y < rect.y1; ++y)
				for (int x = rect.x0; x < rect.x1; ++x) ++count[size_t(y) * 640 + size_t(x)];
	}
	return counts;
}

TEST(TileGrid, coversTheCircleAndLittleElse)
{
	const TileGrid grid = plainGrid(150);
	int pixels = 0;
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) {
			const PixelRect tile = grid.tile(column, row);
			if (tile.x0 < tile.x1) pixels += (tile.x1 - tile.x0) * (tile.y1 - tile.y0);
		}
	EXPECT_GT(pixels, M_PI * 150 * 150);
	EXPECT_LT(pixels, M_PI * 150 * 150 * 1.25);
}

TEST(Coverage, isExactInTheMiddleAndCarefulAtEdges)
{
	const TileGrid grid = plainGrid();
	const auto cover = covered(grid, window(-0.5, 0.5, 0.3, -0.3));
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) {
			const auto least = glm::min(grid.corner(column, row), grid.corner(column + 1, row + 1));
			const auto most = glm::max(grid.corner(column, row), grid.corner(column + 1, row + 1));
			const bool touches = most.x > -0.5 && least.x < 0.5 && most.y > -0.3 && least.y < 0.3;
			const bool inside = least.x >= -0.5 && most.x <= 0.5 && least.y >= -0.3 && most.y <= 0.3;
			const Cover found = cover[size_t(row * grid.columns() + column)];
			EXPECT_FALSE(touches && found == Cover::none);
			EXPECT_FALSE(!inside && found == Cover::fully);
		}
	EXPECT_EQ(cover[size_t(grid.rows() / 2 * grid.columns() + grid.columns() / 2)], Cover::fully);
	EXPECT_EQ(cover.front(), Cover::none);
}

TEST(Coverage, aBorderWithinTheImageIsNotItsInside)
{
	const TileGrid grid = plainGrid();
	const auto within = [&](double border) {
		return coverage(grid, window(-0.8, 0.8, 0.6, -0.6), {border, border}, [](auto, auto) { return Content::some; });
	};
	const auto none = within(0), some = within(0.2);
	int fewer = 0;
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) {
			const size_t i = size_t(row * grid.columns() + column);
			fewer += none[i] != some[i];
			if (some[i] != Cover::fully) continue;
			for (const glm::dvec2 t : {grid.corner(column, row), grid.corner(column + 1, row + 1)}) {
				EXPECT_LT(std::abs(t.x / 1.6), 0.5 - 0.2);
				EXPECT_LT(std::abs(t.y / 1.2), 0.5 - 0.2);
			}
		}
	EXPECT_GT(fewer, 20);
}

TEST(PlanDraws, everyPixelIsReplacedOnceAndEachFurtherLayerBlended)
{
	const TileGrid grid = plainGrid();
	const std::array layers{covered(grid, window(-2, 2, 2, -2)), covered(grid, window(-2, 0, 2, -2))};
	const auto counts = painted(planDraws(grid, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, layers));
	for (const int count : counts.at(Blend::replace)) ASSERT_EQ(count, 1);
	EXPECT_EQ(counts.at(Blend::over)[200 * 640 + 10], 1);
	EXPECT_EQ(counts.at(Blend::over)[200 * 640 + 600], 0);
	EXPECT_FALSE(counts.contains(Blend::add));
}

TEST(PlanDraws, anOpaqueLayerOverAWholeTileLeavesNothingBelow)
{
	const TileGrid grid = plainGrid();
	const std::array layers{covered(grid, window(-2, 2, 2, -2)), covered(grid, window(-2, 2, 2, -2), Content::opaque)};
	for (const TileDraw &draw : planDraws(grid, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, layers)) {
		EXPECT_EQ(draw.layer, 1);
		EXPECT_EQ(draw.behind, Behind::nothing);
		EXPECT_EQ(draw.cover, Cover::opaque);
	}
}

TEST(PlanDraws, aLayersEdgesAreDrawnApartFromItsInside)
{
	const TileGrid grid = plainGrid();
	const std::array layers{covered(grid, window(-0.5, 0.5, 0.3, -0.3))};
	std::map<Cover, int> pixels;
	for (const TileDraw &draw : planDraws(grid, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, layers))
		for (const PixelRect &rect : draw.rects) {
			pixels[draw.cover] += rect.width() * rect.height();
			EXPECT_EQ(draw.layer, draw.cover == Cover::none ? -1 : 0);
		}
	EXPECT_GT(pixels[Cover::none], 0);
	EXPECT_GT(pixels[Cover::partly], 0);
	EXPECT_GT(pixels[Cover::fully], 0);
	EXPECT_EQ(pixels[Cover::opaque], 0);
}

TEST(PlanDraws, addedLightComesLast)
{
	const TileGrid grid = plainGrid();
	const FrameVector<Cover> everywhere = covered(grid, window(-2, 2, 2, -2));
	const std::array layers{everywhere, everywhere, everywhere};
	const auto draws = planDraws(grid, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE, layers);
	std::vector<std::pair<Blend, int>> order;
	for (const TileDraw &draw : draws)
		if (draw.band == 0) order.emplace_back(draw.blend, draw.layer);
	EXPECT_EQ(order, (std::vector<std::pair<Blend, int>>{{Blend::replace, 0}, {Blend::over, 1}, {Blend::over, 2}, {Blend::add, -1}}));
	for (const TileDraw &draw : draws) EXPECT_EQ(draw.behind, draw.blend == Blend::add ? Behind::camera : Behind::nothing);
}

TEST(PlanDraws, theCameraIsAskedOnlyWhereItSees)
{
	const TileGrid grid = plainGrid();
	FrameVector<bool> seen(size_t(grid.rows() * grid.columns()));
	for (size_t i = 0; i < seen.size(); ++i) seen[i] = int(i) % grid.columns() < 5;
	const std::array layers{covered(grid, window(-2, 2, 2, -2))};
	for (const TileDraw &draw : planDraws(grid, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, layers, seen))
		for (const PixelRect &rect : draw.rects)
			EXPECT_EQ(draw.behind, rect.x0 < 5 * TileGrid::tileWidth ? Behind::camera : Behind::unseen);
}

TEST(PlanDraws, withoutEnvironmentOrLayersAllIsDrawnBlack)
{
	const auto draws = planDraws(plainGrid(), XR_ENVIRONMENT_BLEND_MODE_OPAQUE, {});
	for (const TileDraw &draw : draws) {
		EXPECT_EQ(draw.layer, -1);
		EXPECT_EQ(draw.behind, Behind::nothing);
	}
	const auto counts = painted(draws);
	for (const int count : counts.at(Blend::replace)) ASSERT_EQ(count, 1);
}

TEST(PlanDraws, theCircleIsDrawnInFewRectangles)
{
	// Its middle is one of them: rectangles of one row of tiles would be shaded by a fifth more.
	const TileGrid grid = plainGrid(190);
	int largest = 0, all = 0;
	size_t count = 0;
	for (const TileDraw &draw : planDraws(grid, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, {}))
		for (const PixelRect &rect : draw.rects) {
			largest = std::max(largest, rect.width() * rect.height());
			all += rect.width() * rect.height();
			++count;
		}
	EXPECT_GT(largest, all / 4); // half of a band
	EXPECT_LT(count, 40u);
}

// ---- blocks

TEST(BlockSet, comesBackAsRectanglesThatCoverItOnceTheLargestFirst)
{
	constexpr int width = BlockSet::width, height = BlockSet::height;
	BlockSet blocks({640, 0, 640 + 20 * width, 10 * height});
	// A cross with a hole in its middle, added twice.
	const std::array rects{PixelRect{640 + 4 * width, 0, 640 + 8 * width, 4 * height},
						   PixelRect{640 + 4 * width, 5 * height, 640 + 8 * width, 10 * height},
						   PixelRect{640, 4 * height, 640 + 20 * width, 5 * height}};
	for (int twice = 0; twice < 2; ++twice)
		for (const PixelRect &rect : rects) blocks.add(rect);
	const auto found = blocks.takeRects();
	int area = 0;
	for (const PixelRect &rect : found) {
		area += rect.width() * rect.height();
		EXPECT_LE(rect.width() * rect.height(), found.front().width() * found.front().height());
	}
	EXPECT_EQ(area, (4 * 9 + 20) * width * height);
	EXPECT_EQ(found.size(), 3u);
	EXPECT_EQ(found.front().x0, 640 + 4 * width); // the upright, through the bar
	EXPECT_EQ(found.front().height(), 10 * height);
	EXPECT_TRUE(blocks.takeRects().empty());
}

TEST(BlockSet, endsWhereItsAreaEnds)
{
	BlockSet blocks({0, 0, 30, 50});
	blocks.add({0, 0, 30, 50});
	const auto found = blocks.takeRects();
	ASSERT_EQ(found.size(), 1u);
	EXPECT_EQ(found[0].x1, 30);
	EXPECT_EQ(found[0].y1, 50);
}

// ---- matrices

EyeAtLine eyeAt(glm::dvec3 position, double planeDistance = 2)
{
	EyeAtLine eye;
	eye.view.position = position;
	eye.planeDistance = planeDistance;
	return eye;
}
glm::dvec2 divided(const glm::dvec3 &h) { return {h.x / h.z, h.y / h.z}; }

TEST(Reprojection, aCameraBesideTheEyeSeesThePlaneShifted)
{
	// A point straight ahead on the plane, 2 m away; the camera is 10 cm to the right of the eye and 5 cm above.
	const glm::dvec3 q = cameraMatrix(eyeAt({0, 0, 0}), {identityOrientation, {0.1f, 0.05f, 0}}) * glm::dvec3(0, 0, 1);
	EXPECT_NEAR(q.x / q.z, -0.05, 1e-6);
	EXPECT_NEAR(q.y / q.z, 0.025, 1e-6); // down in the image
}

TEST(Reprojection, aTurnedCameraSeesDirectionsTurnedBack)
{
	const glm::dvec3 q = cameraMatrix(eyeAt({0, 0, 0}), {rotationAbout({0, 1, 0}, 0.3), {0, 0, 0}}) * glm::dvec3(0, 0, 1);
	EXPECT_NEAR(std::atan2(q.x, q.z), 0.3, 1e-6); // the camera looks left, so what is ahead is to its right
}

TEST(Reprojection, aLayerAtItsOwnPoseIsItsOwnPicture)
{
	const ProjectionView view{{identityOrientation, {0.03f, 0, 0}}, {-0.6f, 0.4f, 0.5f, -0.7f}, {}};
	const auto m = projectionMatrix(eyeAt({0.03, 0, 0}), false, view);
	for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0.3, 0.8)}) {
		const double x = glm::mix(std::tan(-0.6), std::tan(0.4), uv.x), y = glm::mix(std::tan(0.5), std::tan(-0.7), uv.y);
		const glm::dvec2 found = divided(m * glm::dvec3(x, y, 1));
		EXPECT_NEAR(found.x, uv.x, 1e-6);
		EXPECT_NEAR(found.y, uv.y, 1e-6);
	}
}

TEST(Reprojection, aQuadsCornersAreItsPicturesCorners)
{
	const QuadView quad{{rotationAbout({0, 1, 0}, 0.5), {0.2f, 0.1f, -1.5f}}, {0.4f, 0.3f}, {}};
	const glm::dvec3 eye{-0.03, 0.02, 0.01};
	const auto m = quadMatrix(eyeAt(eye), false, quad).value();
	for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0.5, 0.5)}) {
		const XrVector3f corner{float(uv.x - 0.5) * 0.4f, float(0.5 - uv.y) * 0.3f, 0};
		const glm::dvec3 ray = toGlm(quad.quadInFrame * corner) - eye;
		const glm::dvec3 h = m * glm::dvec3(ray.x / -ray.z, ray.y / -ray.z, 1);
		EXPECT_GT(h.z, 0);
		EXPECT_NEAR(divided(h).x, uv.x, 1e-5);
		EXPECT_NEAR(divided(h).y, uv.y, 1e-5);
	}
	EXPECT_FALSE(quadMatrix(eyeAt({0, 0, -5}), false, quad)) << "from behind";
}

TEST(Reprojection, thePlaneIsMeasuredFromTheMiddleOfBothViews)
{
	PanelInputs inputs;
	inputs.passthroughDistance = 2;
	for (size_t e = 0; e < 2; ++e) {
		const XrPosef view{identityOrientation, {e == 0 ? -0.03f : 0.03f, 0, e == 0 ? -0.2f : 0.0f}};
		inputs.top[e] = inputs.bottom[e] = {view, identityPose};
	}
	const auto eyes = eyesAtLine(inputs, 0.5);
	EXPECT_NEAR(eyes[0].planeDistance, 1.9, 1e-6);
	EXPECT_NEAR(eyes[1].planeDistance, 2.1, 1e-6);
}

} // namespace
} // namespace arift
