// What an application submits as the compositor draws it.
#include "runtime/service/layers.h"
#include "runtime/service/swapchains.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

ipc::Submission submissionOf(ipc::LayerType type, uint32_t rowsGoUp)
{
	ipc::Submission submission;
	submission.layerCount = 1;
	submission.rowsGoUp = rowsGoUp;
	ipc::Layer &layer = submission.layers[0];
	layer.type = type;
	layer.width = 2;
	layer.height = 0.5f;
	for (ipc::LayerView &view : layer.views) view.fov = {-0.8f, 0.7f, 0.6f, -0.5f};
	return submission;
}

std::vector<PanelLayer> layersOf(const ipc::Submission &submission) { return contentOf(submission, 1)->layers; }

TEST(Layers, AViewWhoseRowsGoUpIsTurnedOver)
{
	const auto down = contentOf(submissionOf(ipc::LayerType::projection, 0), 1),
			   up = contentOf(submissionOf(ipc::LayerType::projection, 1), 1);
	for (size_t eye = 0; eye < 2; ++eye) {
		const XrFovf &usual = down->layers[0].projection[eye]->fov, &turned = up->layers[0].projection[eye]->fov;
		EXPECT_EQ(usual.angleUp, 0.6f);
		EXPECT_EQ(usual.angleDown, -0.5f);
		EXPECT_EQ(turned.angleUp, -0.5f) << "the image's first row is the view's lowest";
		EXPECT_EQ(turned.angleDown, 0.6f);
		EXPECT_EQ(turned.angleLeft, usual.angleLeft);
		EXPECT_EQ(turned.angleRight, usual.angleRight);
	}
}

TEST(Layers, AViewsDepthIsSaidOfItWhereItHasAny)
{
	ipc::Submission submission = submissionOf(ipc::LayerType::projection, 0);
	submission.layers[0].views[1].depth = {{.swapchain = 7, .image = 2, .arrayIndex = 3, .x = 4, .y = 5, .width = 6, .height = 8}, 10, -9};
	const PanelLayer layer = layersOf(submission)[0];
	EXPECT_FALSE(layer.projection[0]->depth);
	ASSERT_TRUE(layer.projection[1]->depth);
	const ViewDepth &depth = *layer.projection[1]->depth;
	EXPECT_EQ(depth.texture.image, imageKey(7, 2));
	EXPECT_EQ(depth.texture.arrayIndex, 3u);
	EXPECT_EQ(depth.texture.rect.offset.y, 5);
	EXPECT_EQ(depth.texture.rect.extent.width, 6);
	EXPECT_EQ(depth.inverseBias, 10);
	EXPECT_EQ(depth.inverseScale, -9);
}

TEST(Layers, ADepthTestIsTheLayersAndItsRangeTheViews)
{
	ipc::Submission submission = submissionOf(ipc::LayerType::projection, 0);
	submission.layers[0].views[1].depth = {.image = {.swapchain = 7}, .testedFrom = 0.5f, .testedTo = 3};
	EXPECT_FALSE(layersOf(submission)[0].depthTest);
	submission.layers[0].depthTest = {.given = 1, .compareOp = 4, .writes = 1};
	const PanelLayer layer = layersOf(submission)[0];
	ASSERT_TRUE(layer.depthTest);
	EXPECT_EQ(layer.depthTest->compare, VK_COMPARE_OP_GREATER);
	EXPECT_TRUE(layer.depthTest->writes);
	EXPECT_EQ(layer.projection[1]->depth->testedFrom, 0.5f);
	EXPECT_EQ(layer.projection[1]->depth->testedTo, 3);
}

TEST(Layers, AQuadWhoseRowsGoUpIsTurnedOver)
{
	const auto down = contentOf(submissionOf(ipc::LayerType::quad, 0), 1), up = contentOf(submissionOf(ipc::LayerType::quad, 1), 1);
	EXPECT_EQ(down->layers[0].quad[0]->size.height, 0.5f);
	EXPECT_EQ(up->layers[0].quad[0]->size.height, -0.5f);
	EXPECT_EQ(up->layers[0].quad[0]->size.width, 2.0f);
}

TEST(Layers, ACurvedLayerWhoseRowsGoUpIsTurnedOver)
{
	for (const auto type : {ipc::LayerType::cylinder, ipc::LayerType::equirect}) {
		ipc::Submission submission = submissionOf(type, 0);
		submission.layers[0].curved = {1.5f, {0.5f, 0.25f}, {2, -3}};
		const CurvedView down = *layersOf(submission)[0].curved[1];
		submission.rowsGoUp = 1;
		const CurvedView up = *layersOf(submission)[0].curved[0];
		EXPECT_EQ(down.surface, type == ipc::LayerType::cylinder ? Surface::cylinder : Surface::sphere);
		EXPECT_EQ(down.radius, 1.5f);
		EXPECT_EQ(down.uvAhead.y, 0.25f);
		EXPECT_EQ(down.uvPerUnit.y, -3);
		EXPECT_EQ(up.uvAhead.y, 0.75f) << "the image's first row is the layer's lowest";
		EXPECT_EQ(up.uvPerUnit.y, 3);
		EXPECT_EQ(up.uvPerUnit.x, 2);
	}
}

TEST(Layers, ACubeIsTheSameForEveryGraphicsApi)
{
	ipc::Submission submission = submissionOf(ipc::LayerType::cube, 1);
	submission.layers[0].eyes = 2;
	submission.layers[0].views[0].pose.orientation = {0, 1, 0, 0};
	submission.layers[0].views[0].image.arrayIndex = 3;
	const auto layers = layersOf(submission);
	EXPECT_FALSE(layers[0].cube[0]);
	EXPECT_EQ(layers[0].cube[1]->orientationInFrame.y, 1);
	EXPECT_EQ(layers[0].cube[1]->texture.arrayIndex, 3u);
}

TEST(Layers, ScaleBiasAndFactorsAreTheLayers)
{
	ipc::Submission submission = submissionOf(ipc::LayerType::quad, 0);
	submission.layers[0].colorScale.g = 0.5f;
	submission.layers[0].colorBias.a = 0.25f;
	EXPECT_FALSE(layersOf(submission)[0].factors);
	submission.layers[0].blend = {1, 2, 3, 1, 0};
	const auto layers = layersOf(submission);
	EXPECT_EQ(layers[0].colorScale.g, 0.5f);
	EXPECT_EQ(layers[0].colorBias.a, 0.25f);
	EXPECT_EQ(layers[0].factors->sourceColor, XR_BLEND_FACTOR_SRC_ALPHA_FB);
	EXPECT_EQ(layers[0].factors->keptColor, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB);
	EXPECT_EQ(layers[0].factors->sourceAlpha, XR_BLEND_FACTOR_ONE_FB);
	EXPECT_EQ(layers[0].factors->keptAlpha, XR_BLEND_FACTOR_ZERO_FB);
}

} // namespace
} // namespace arift
