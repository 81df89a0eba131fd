// The ruler of the registration figures: discs painted into a panel picture at known directions must be found there.
#include "tests/e2e/registration/blob_fit.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace arift::e2e;
using arift::reference::Lens;
using Eigen::Vector2d;

namespace
{

/// Paints what a perfect headset shows of a disc around `centre` (tangents) in one colour, with 4x4 samples in a pixel.
void paint(PanelPicture &picture, const Lens &lens, int eye, int channel, const Vector2d &centre, double radius)
{
	for (int y = 0; y < 800; ++y)
		for (int x = eye * 640; x < eye * 640 + 640; ++x) {
			if ((lens.tangents(eye, channel, {x + 0.5, y + 0.5}) - centre).norm() > 3 * radius) continue;
			int inside = 0;
			for (int i = 0; i < 16; ++i)
				inside += (lens.tangents(eye, channel, {x + 0.125 + 0.25 * (i % 4), y + 0.125 + 0.25 * (i / 4)}) - centre).norm() < radius;
			const double v = inside / 16.0, encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
			picture.rgba[size_t(y * 1280 + x) * 4 + size_t(channel)] = uint8_t(std::lround(255 * encoded));
		}
}

PanelPicture blackPanel() { return {1280, 800, 0, std::vector<uint8_t>(1280 * 800 * 4)}; }

TEST(BlobFit, FindsAHologramWhereItWasPainted)
{
	const Lens lens = Lens::spline(0.010);
	for (const auto &[place, shift] : {std::pair{Vector2d(0.05, -0.1), Vector2d(0, 0)},
									   {Vector2d(-0.7, 0.4), Vector2d(0.004, -0.002)},
									   {Vector2d(-0.3, -0.5), Vector2d(-0.01, 0.01)}}) {
		PanelPicture picture = blackPanel();
		paint(picture, lens, 0, 0, place, 0.022);
		paint(picture, lens, 0, 2, place + shift, 0.022);
		size_t lonely = 0;
		const auto pairs = pairSpots(lens, 0, findSpots(picture, lens, 0, 0), findSpots(picture, lens, 0, 2), 0.1, lonely);
		ASSERT_EQ(pairs.size(), 1u);
		EXPECT_EQ(lonely, 0u);
		const Vector2d expected = *lens.pixel(0, 1, place + shift) - *lens.pixel(0, 1, place);
		EXPECT_LT((pairs[0].error - expected).norm(), 0.05) << "error found " << pairs[0].error.transpose();
		EXPECT_LT((*lens.pixel(0, 1, pairs[0].real.tangents) - *lens.pixel(0, 1, place)).norm(), 0.05);
	}
}

TEST(BlobFit, LeavesOutWhatTouchesLightOrTheEdge)
{
	const Lens lens = Lens::spline(0.010);
	PanelPicture picture = blackPanel();
	paint(picture, lens, 1, 0, lens.tangents(1, 0, {642, 400}), 0.022); // cut by the border between the eyes
	paint(picture, lens, 1, 0, {0.1, 0.1}, 0.022);
	paint(picture, lens, 1, 1, {0.1, 0.1}, 0.05); // green: a white thing, no marker
	EXPECT_TRUE(findSpots(picture, lens, 1, 0).empty());
	paint(picture, lens, 1, 0, {-0.3, 0.1}, 0.022);
	size_t lonely = 0;
	EXPECT_TRUE(pairSpots(lens, 1, findSpots(picture, lens, 1, 0), {}, 0.1, lonely).empty());
	EXPECT_EQ(lonely, 1u);
}

} // namespace
