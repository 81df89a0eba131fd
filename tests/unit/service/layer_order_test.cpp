// Layers of several applications: the nearer ones over those farther away, each application's own in their order.
#include "runtime/compositor/layer_order.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

using Layers = std::vector<PanelLayer>;

/// Facing +z, its centre so far ahead of the origin.
PanelLayer quadAt(double ahead, uint64_t image = 1, XrExtent2Df size = {1, 1})
{
	PanelLayer layer;
	layer.quad[0] = QuadView{{identityPose.orientation, {0, 0, float(-ahead)}}, size, {.image = image}};
	return layer;
}

PanelLayer scene(uint64_t image)
{
	PanelLayer layer;
	layer.projection[0] = ProjectionView{identityPose, {}, {.image = image}};
	return layer;
}

std::vector<uint64_t> imagesOf(const Layers &layers)
{
	std::vector<uint64_t> images;
	for (const PanelLayer &layer : layers)
		images.push_back(layer.quad[0] ? layer.quad[0]->texture.image : layer.projection[0]->texture.image);
	return images;
}

std::vector<uint64_t> merged(const std::vector<Layers> &applications, const XrPosef &head = identityPose)
{
	const std::vector<std::span<const PanelLayer>> all(applications.begin(), applications.end());
	Layers layers;
	mergeByDistance(all, head, layers);
	return imagesOf(layers);
}

TEST(LayerDistance, IsToTheNearestPointOfAQuad)
{
	EXPECT_DOUBLE_EQ(distanceOf(quadAt(2), identityPose), 2);
	const XrPosef aside{identityPose.orientation, {3.5f, 0, -2 + 4.0f}};
	EXPECT_DOUBLE_EQ(distanceOf(quadAt(2), aside), 5) << "3 m beyond its edge, 4 m before its plane";
	EXPECT_DOUBLE_EQ(distanceOf(quadAt(2, 1, {7, 1}), aside), 4);
	const XrPosef above{identityPose.orientation, {0, 3.5f, -2 + 4.0f}};
	for (const float height : {1.0f, -1.0f}) EXPECT_DOUBLE_EQ(distanceOf(quadAt(2, 1, {1, height}), above), 5) << "rows that go up";
	PanelLayer locked = quadAt(2);
	locked.headLocked = true;
	EXPECT_DOUBLE_EQ(distanceOf(locked, aside), 2);
}

TEST(LayerDistance, IsToASurfaceFromInsideAndOutside)
{
	PanelLayer layer;
	layer.curved[1] = CurvedView{.surface = Surface::cylinder, .centreInFrame = {identityPose.orientation, {0, 7, -1}}, .radius = 3};
	EXPECT_DOUBLE_EQ(distanceOf(layer, identityPose), 2);
	EXPECT_DOUBLE_EQ(distanceOf(layer, {identityPose.orientation, {0, 0, 4}}), 2);
	layer.curved[1]->surface = Surface::sphere;
	EXPECT_DOUBLE_EQ(distanceOf(layer, {identityPose.orientation, {0, 7, -1.5f}}), 2.5);
	layer.curved[1]->radius = 0;
	EXPECT_GT(distanceOf(layer, identityPose), 1e9);
	EXPECT_EQ(distanceOf(layer, identityPose), distanceOf(scene(1), identityPose));
	PanelLayer world;
	world.passthrough.emplace();
	EXPECT_GT(distanceOf(world, identityPose), distanceOf(scene(1), identityPose));
}

TEST(LayerOrder, NearerOnesAreDrawnOverFartherOnes)
{
	EXPECT_EQ(merged({{quadAt(1, 11)}, {quadAt(3, 21)}, {quadAt(2, 31)}}), (std::vector<uint64_t>{21, 31, 11}));
	const XrPosef beyond{{0, 1, 0, 0}, {0, 0, -4}};
	EXPECT_EQ(merged({{quadAt(1, 11)}, {quadAt(3, 21)}, {quadAt(2, 31)}}, beyond), (std::vector<uint64_t>{11, 31, 21}));
}

TEST(LayerOrder, WithinAnApplicationItIsAsSubmitted)
{
	EXPECT_EQ(merged({{quadAt(1, 11), quadAt(5, 12)}, {quadAt(3, 21), quadAt(0.5, 22)}}), (std::vector<uint64_t>{21, 11, 12, 22}));
}

TEST(LayerOrder, ScenesLieBelowThingsWhosePlaceIsKnown)
{
	EXPECT_EQ(merged({{scene(11), quadAt(1, 12)}, {quadAt(2, 21)}, {scene(31)}}), (std::vector<uint64_t>{11, 31, 21, 12}));
	EXPECT_EQ(merged({{scene(11), scene(12)}, {scene(21)}}), (std::vector<uint64_t>{11, 12, 21})) << "nothing known: as they came";
	EXPECT_TRUE(merged({{}, {}}).empty());
}

} // namespace
} // namespace arift
