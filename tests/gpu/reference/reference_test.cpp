// The reference against published numbers: nothing is measured with a ruler that has not been checked itself.
#include "tests/gpu/reference/reference_panel.h"
#include <gtest/gtest.h>

using namespace arift::reference;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// LibOVR 0.4 at 10 mm eye relief: pixel centre -> tangents of green; y down there.
TEST(ReferenceLens, SplineMeetsPublishedTangents)
{
	const Lens lens = Lens::spline(0.010);
	struct {
		int eye;
		double x, y, tx, ty;
	} const vectors[] = {{0, 320, 400, -.13330, .00138},
						 {0, 639, 399, .96742, -.00179},
						 {0, 0, 399, -2.47064, -.00336},
						 {0, 100, 600, -1.31171, .98085},
						 {0, 320, 0, -.45924, -3.81172}};
	for (const auto &v : vectors) {
		const Vector2d t = lens.tangents(v.eye, 1, {v.x + 0.5, v.y + 0.5});
		EXPECT_NEAR(t.x(), v.tx, 1e-5);
		EXPECT_NEAR(-t.y(), v.ty, 1e-5);
	}
	const Vector2d right = lens.tangents(1, 1, {960.5, 400.5});
	EXPECT_NEAR(right.x(), .13610, 1e-5);
	EXPECT_NEAR(lens.tangents(1, 0, {960.5, 400.5}).x() / right.x(), 0.994, 1e-12);
	EXPECT_NEAR(lens.tangents(1, 2, {960.5, 400.5}).x() / right.x(), 1.014, 1e-12);
}

// LibOVR 0.2.5: texture coordinates of the 1280x800 target for a scale of 1.714606.
TEST(ReferenceLens, PolynomialMeetsPublishedTextureCoordinates)
{
	const Lens lens = Lens::polynomial();
	struct {
		double x, y;
		double u[3], v[3];
	} const vectors[] = {
		{0, 399, {.00358, .00091, -.00311}, {.49938, .49938, .49937}},  {320, 400, {.26604, .26595, .26564}, {.50036, .50037, .50037}},
		{639, 399, {.44499, .44607, .44829}, {.49954, .49954, .49953}}, {320, 0, {.24571, .24527, .24468}, {-.06147, -.06733, -.07527}},
		{100, 600, {.10283, .10126, .09865}, {.72154, .72341, .72654}},
	};
	const double perUnit = 0.041 / (0.14976 / 4), lensCentre = (0.5 + 0.5 * 0.151976) * 0.5, scale = 0.5 / (2 * 1.714606);
	for (const auto &vector : vectors)
		for (int channel = 0; channel < 3; ++channel) {
			const Vector2d theta = lens.tangents(0, channel, {vector.x + 0.5, vector.y + 0.5}) * perUnit;
			EXPECT_NEAR(lensCentre + scale * theta.x(), vector.u[channel], 2e-5);
			EXPECT_NEAR(0.5 - theta.y() * 0.8 / (2 * 1.714606), vector.v[channel], 2e-5);
		}
}

TEST(ReferenceLens, PixelUndoesTangents)
{
	for (const Lens &lens : {Lens::spline(0.010), Lens::spline(0.0155), Lens::polynomial()})
		for (int channel = 0; channel < 3; ++channel) {
			const Vector2d pixel(501.25, 212.75);
			const auto back = lens.pixel(0, channel, lens.tangents(0, channel, pixel));
			ASSERT_TRUE(back);
			EXPECT_LT((*back - pixel).norm(), 1e-6);
		}
}

TEST(ReferenceLens, FieldOfViewIsTheSdks)
{
	const Window left = fieldOfView(0, 0.010);
	EXPECT_NEAR(-left.left, 2.11709, 1e-4);
	EXPECT_NEAR(left.right, 0.97074, 1e-4);
	EXPECT_NEAR(left.up, 2.13826, 1e-4);
}

// The right camera of the original ARift: its inverse polynomial is the published one, the direct one was fitted to it.
TEST(ReferenceCamera, BothPolynomialsMeetPublishedProjections)
{
	Camera direct;
	direct.width = 752;
	direct.height = 480;
	direct.centreRow = 236.646089;
	direct.centreColumn = 394.135741;
	direct.c = 1.000052;
	direct.d = 0.000060;
	direct.e = -0.000032;
	Camera inverse = direct;
	direct.direct = {-420.365226, 0, 8.10936128e-4, -4.21029727e-8, 9.21330502e-11};
	inverse.inverse = {712.870100, 580.959756, 188.838455, 105.465531, 27.232993, 2.433748};
	struct {
		Vector3d cv;
		double column, row;
	} const vectors[] = {
		{{0, 0, 1}, 394.1357, 236.6461},       {{0.1, 0, 1}, 436.0269, 236.6486},     {{0, 0.1, 1}, 394.1344, 278.5395},
		{{-0.5, 0.25, 1}, 202.4578, 332.4770}, {{0.5, -0.25, 1}, 585.8137, 140.8152}, {{1, 0.3, 1}, 720.6696, 334.6319},
		{{-1, -0.3, 1}, 67.6019, 138.6603},
	};
	for (const auto &[camera, tolerance] : {std::pair{direct, 0.03}, {inverse, 0.001}})
		for (const auto &vector : vectors) {
			const Vector3d direction(vector.cv.x(), -vector.cv.y(), -vector.cv.z());
			const auto texel = camera.see(direction);
			ASSERT_TRUE(texel);
			EXPECT_NEAR(texel->x(), vector.column, tolerance);
			EXPECT_NEAR(texel->y(), vector.row, tolerance);
			EXPECT_LT((camera.look(*texel) - direction.normalized()).norm(), 1e-5);
			EXPECT_FALSE(camera.see({0, 0, 1}));
		}
}

// A point on the passthrough plane is where a pinhole of the same place would put it, whoever looks.
TEST(ReferencePanel, PlaneIsPerpendicularAtItsDistance)
{
	Situation now;
	now.motion.rate = {0.3, 3.0, -0.2};
	now.eyeInHead[0].place = {-0.032, 0, 0};
	now.eyeInHead[1].place = {0.032, 0, 0};
	now.cameraInHead[0].place = {-0.032, 0.01, -0.08};
	now.cameraInHead[1].place = {0.035, 0.01, -0.07};
	now.viewOffset = 0.5;
	now.passthroughDistance = 1.5;
	const Vector3d middle = (now.view(0, 0.005).place + now.view(1, 0.005).place) / 2;
	const auto point = now.passthroughPoint(1, 0.005, {-0.4, 0.7});
	ASSERT_TRUE(point);
	EXPECT_NEAR((*point - middle).dot(now.motion.head(0.005).turn * Vector3d(0, 0, -1)), 1.5, 1e-12);
	const Vector3d seen = now.view(1, 0.005).in(*point);
	EXPECT_NEAR(seen.x() / -seen.z(), -0.4, 1e-12);
	EXPECT_NEAR(seen.y() / -seen.z(), 0.7, 1e-12);
}

} // namespace
