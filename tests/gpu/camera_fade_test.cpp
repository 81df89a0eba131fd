#include "runtime/compositor/camera_fade.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

PanelInputs shown(XrTime time, std::optional<uint32_t> left, std::optional<uint32_t> right)
{
	PanelInputs inputs{.displayTime = time};
	if (left) inputs.cameras[0] = CameraView{.frame = {}, .cameraInOrigin = identityPose, .lens = *left};
	if (right) inputs.cameras[1] = CameraView{.frame = {}, .cameraInOrigin = identityPose, .lens = *right};
	return inputs;
}

TEST(CameraFade, aReplacementComesSoftlyAndTheOtherEyeStays)
{
	CameraFade fade;
	const auto weights = [&](PanelInputs inputs) {
		fade.apply(inputs);
		return std::array{inputs.cameras[0] ? inputs.cameras[0]->weight : -1, inputs.cameras[1] ? inputs.cameras[1]->weight : -1};
	};
	EXPECT_EQ(weights(shown(1 * second, 0, 1)), (std::array{0.0f, 0.0f}));
	EXPECT_EQ(weights(shown(1 * second + CameraFade::duration / 2, 0, 1)), (std::array{0.5f, 0.5f}));
	EXPECT_EQ(weights(shown(2 * second, 0, 1)), (std::array{1.0f, 1.0f}));
	EXPECT_EQ(weights(shown(3 * second, 1, 1)), (std::array{0.0f, 1.0f})) << "the left eye now sees the right camera";
	EXPECT_EQ(weights(shown(4 * second, 1, 1)), (std::array{1.0f, 1.0f}));
	EXPECT_EQ(weights(shown(5 * second, 1, std::nullopt)), (std::array{1.0f, -1.0f}));
	EXPECT_EQ(weights(shown(6 * second, 1, 1)), (std::array{1.0f, 0.0f})) << "and comes back as softly";
}

} // namespace
} // namespace arift
