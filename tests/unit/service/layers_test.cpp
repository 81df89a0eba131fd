// What an application submits as the compositor draws it.
#include "runtime/service/layers.h"
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

TEST(Layers, AQuadWhoseRowsGoUpIsTurnedOver)
{
	const auto down = contentOf(submissionOf(ipc::LayerType::quad, 0), 1), up = contentOf(submissionOf(ipc::LayerType::quad, 1), 1);
	EXPECT_EQ(down->layers[0].quad[0]->size.height, 0.5f);
	EXPECT_EQ(up->layers[0].quad[0]->size.height, -0.5f);
	EXPECT_EQ(up->layers[0].quad[0]->size.width, 2.0f);
}

} // namespace
} // namespace arift
