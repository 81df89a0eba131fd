// The DK1's lens against vectors worked out from LibOVR's own algorithms (0.2.5 and 0.3.2 to 0.5.0.1) in double precision.
#include "runtime/base/error.h"
#include "runtime/optics/lens_model.h"
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arift
{
namespace
{

const LensModel spline(SplineLens{0.010});
const LensModel polynomial(PolynomialLens{});

struct FieldOfView {
	double relief, up, left, right, width, height;
};

TEST(SplineLens, DefaultFieldOfViewByEyeRelief)
{
	const FieldOfView table[] = {
		{0.007760465, 2.63870, 2.34653, 0.96164, 1202, 1917}, {0.010, 2.13826, 2.11709, 0.97074, 1122, 1553},
		{0.012, 1.82856, 1.81046, 0.97928, 1013, 1328},       {0.012760465, 1.73312, 1.71596, 0.98235, 980, 1259},
		{0.017, 1.34247, 1.32918, 1.00185, 847, 975},         {0.017760465, 1.29030, 1.27752, 1.00534, 829, 937},
	};
	for (const auto &row : table) {
		const LensModel lens(SplineLens{row.relief});
		const LensModel::Fov left = lens.fov(Eye::left), right = lens.fov(Eye::right);
		EXPECT_NEAR(left.up, row.up, 6e-6) << row.relief;
		EXPECT_NEAR(left.down, row.up, 6e-6) << row.relief;
		EXPECT_NEAR(left.left, row.left, 6e-6) << row.relief;
		EXPECT_NEAR(left.right, row.right, 6e-6) << row.relief;
		EXPECT_EQ(std::lround(lens.pixelsPerTangent() * (left.left + left.right)), std::lround(row.width)) << row.relief;
		EXPECT_EQ(std::lround(lens.pixelsPerTangent() * (left.up + left.down)), std::lround(row.height)) << row.relief;
		EXPECT_EQ(right.left, left.right);
		EXPECT_EQ(right.right, left.left);
	}
}

TEST(SplineLens, ScreenLimitedTangents)
{
	const glm::dvec2 axis = spline.centre(Eye::left);
	EXPECT_NEAR(spline.tangents(Eye::left, Channel::green, {0, axis.y}).x, -2.48654, 6e-6);
	EXPECT_NEAR(spline.tangents(Eye::left, Channel::green, {640, axis.y}).x, 0.97074, 6e-6);
	EXPECT_NEAR(spline.tangents(Eye::left, Channel::green, {axis.x, 0}).y, 3.72386, 6e-6);
}

TEST(SplineLens, InterpolatedTable)
{
	const double table[] = {1, 1.048902, 1.109269, 1.190407, 1.306574, 1.482371, 1.771810, 2.275287, 2.933040, 3.732022, 4.669676};
	for (int i = 0; i <= 10; ++i) EXPECT_NEAR(spline.scale(i / 10.0 * 1.188617 * 1.188617), table[i], 1e-5) << i;
	const double d[][2] = {{.05, 1.016843}, {.25, 1.093704}, {.5, 1.247027}, {.75, 1.556254},
						   {1, 2.321131},   {1.2, 3.310006}, {2, 8.566725}};
	for (const auto &[r2, expected] : d) EXPECT_NEAR(spline.scale(r2), expected, 6e-7) << r2;
}

TEST(SplineLens, PixelVectorsPerChannel)
{
	EXPECT_NEAR(spline.pixelsPerTangent(), 363.248, 5e-4);
	const struct {
		Eye eye;
		double column, row, x, yDown;
	} table[] = {
		{Eye::left, 320, 400, -.13330, .00138},  {Eye::left, 639, 399, .96742, -.00179}, {Eye::left, 0, 399, -2.47064, -.00336},
		{Eye::left, 100, 600, -1.31171, .98085}, {Eye::left, 320, 0, -.45924, -3.81172}, {Eye::right, 320, 400, .13610, .00139},
	};
	for (const auto &v : table) {
		const glm::dvec2 pixel(v.column + 0.5 + (v.eye == Eye::right ? 640 : 0), v.row + 0.5);
		const glm::dvec2 green = spline.tangents(v.eye, Channel::green, pixel);
		EXPECT_NEAR(green.x, v.x, 6e-6);
		EXPECT_NEAR(green.y, -v.yDown, 6e-6);
		EXPECT_LT(glm::length(spline.tangents(v.eye, Channel::red, pixel) - green * 0.994), 1e-12);
		EXPECT_LT(glm::length(spline.tangents(v.eye, Channel::blue, pixel) - green * 1.014), 1e-12);
	}
}

/// Tangent at a distance from the lens centre on the panel, millimetres: both generations side by side.
TEST(BothLenses, TangentsByDistanceOnThePanel)
{
	const double reliefs[] = {0.007760465, 0.010, 0.012760465, 0.017760465};
	const struct {
		double millimetres, polynomial, spline[4];
	} table[] = {
		{5, .12244, {.11823, .11820, .11817, .11813}},          {10, .24803, {.23987, .23968, .23941, .23988}},
		{20, .52796, {.50916, .50875, .50878, .51466}},         {30, .90745, {.87189, .87926, .88764, .90592}},
		{37.44, 1.33323, {1.39099, 1.41363, 1.44768, 1.52077}}, {43.13, 1.80368, {2.34653, 2.48654, 2.66183, 3.27179}},
	};
	for (const auto &row : table) {
		const auto tangent = [&](const LensModel &lens) {
			return -lens.tangents(Eye::left, Channel::green, lens.centre(Eye::left) - glm::dvec2(row.millimetres / 0.117, 0)).x;
		};
		EXPECT_NEAR(tangent(polynomial), row.polynomial, 6e-6) << row.millimetres;
		for (int i = 0; i < 4; ++i)
			EXPECT_NEAR(tangent(LensModel(SplineLens{reliefs[i]})), row.spline[i], 6e-6) << row.millimetres << " " << i;
	}
}

/// LibOVR 0.2.5's shader speaks in texture coordinates of a target scaled by S; its vectors are taken back to tangents the way it makes
/// them.
TEST(PolynomialLens, TextureVectorsPerChannel)
{
	constexpr double s = 1.714606, lensCentre = 0.287994;
	const struct {
		double column, row, uv[3][2];
	} table[] = {
		{0, 399, {{.00358, .49938}, {.00091, .49938}, {-.00311, .49937}}},
		{320, 400, {{.26604, .50036}, {.26595, .50037}, {.26564, .50037}}},
		{639, 399, {{.44499, .49954}, {.44607, .49953}, {.44829, .49953}}},
		{320, 0, {{.24571, -.06147}, {.24527, -.06733}, {.24468, -.07527}}},
		{100, 600, {{.10283, .72154}, {.10126, .72341}, {.09865, .72654}}},
	};
	for (const auto &v : table)
		for (const Channel channel : {Channel::red, Channel::green, Channel::blue}) {
			const glm::dvec2 tangent = polynomial.tangents(Eye::left, channel, {v.column + 0.5, v.row + 0.5});
			const auto [u, w] = v.uv[size_t(channel)];
			EXPECT_NEAR(lensCentre + 0.25 / s * tangent.x / (0.03744 / 0.041), u, 6e-6);
			EXPECT_NEAR(0.5 - 0.4 / s * tangent.y / (0.03744 / 0.041), w, 6e-6);
		}
}

TEST(BothLenses, PixelIsTheInverseOfTangents)
{
	for (const LensModel &lens : {spline, polynomial})
		for (const Eye eye : {Eye::left, Eye::right})
			for (const Channel channel : {Channel::red, Channel::green, Channel::blue}) {
				double worst = 0;
				for (double y = 0.5; y < 800; y += 20.3)
					for (double x = 0.5; x < 640; x += 19.7) {
						const glm::dvec2 pixel(x + (eye == Eye::right ? 640 : 0), y);
						const auto back = lens.pixel(eye, channel, lens.tangents(eye, channel, pixel));
						ASSERT_TRUE(back) << x << " " << y;
						worst = std::max(worst, glm::length(*back - pixel));
					}
				EXPECT_LT(worst, 1e-8);
				EXPECT_EQ(lens.pixel(eye, channel, {0, 0}).value(), lens.centre(eye));
			}
}

TEST(BothLenses, ShowNothingBeyondAnEyesHalf)
{
	for (const LensModel &lens : {spline, polynomial}) {
		EXPECT_FALSE(lens.pixel(Eye::left, Channel::green, {1.1, 0}));
		EXPECT_TRUE(lens.pixel(Eye::right, Channel::green, {1.1, 0}));
		EXPECT_FALSE(lens.pixel(Eye::right, Channel::green, {-1.1, 0}));
		EXPECT_FALSE(lens.pixel(Eye::right, Channel::green, {0, 100}));
	}
}

TEST(BothLenses, TheLensCircleReachesTheFieldOfView)
{
	for (const LensModel &lens : {spline, polynomial}) {
		const double r = std::sqrt(lens.maxR2());
		EXPECT_NEAR(r * lens.scale(r * r), lens.fov(Eye::left).up, 1e-9);
	}
	EXPECT_NEAR(std::sqrt(spline.maxR2()), 0.982, 1e-3);
}

TEST(BothLenses, RefuseWhatIsNoLens)
{
	EXPECT_THROW(LensModel(SplineLens{0}), InputError);
	EXPECT_THROW(LensModel(SplineLens{std::nan("")}), InputError);
	EXPECT_THROW(LensModel(PolynomialLens{{1, -0.9, 0, 0}}), InputError);
	PanelGeometry panel;
	panel.lensSeparation = 0.2;
	EXPECT_THROW(LensModel(SplineLens{}, panel), InputError);
	panel = {};
	panel.width = 0;
	EXPECT_THROW(LensModel(SplineLens{}, panel), InputError);
}

} // namespace
} // namespace arift
