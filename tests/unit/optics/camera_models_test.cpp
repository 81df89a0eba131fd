// Every camera model by the same rules, and each against its paper's equations written out plainly.
#include "runtime/base/error.h"
#include "runtime/optics/camera_model.h"
#include "runtime/optics/pixel_rays.h"
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace arift
{
namespace
{

const OCam wideOCam{{-206.517, 0, 2.207161e-3, -4.879622e-6, 1.865656e-8}, {}, 241.800066, 394.552874, 1.00033, 2.19e-4, 2.57e-4};
const OCam shearedOCam{{-209.2007, 0.002, 2.13741e-3, -4.22036e-6, 1.77146e-8}, {}, 243.49, 392.22, 0.9996, -0.0335, 0.0332};
const OCam inverseOCam{
	{}, {712.870100, 580.959756, 188.838455, 105.465531, 27.232993, 2.433748}, 236.646089, 394.135741, 1.000052, 6e-5, -3.2e-5};
const KannalaBrandt narrowKannala{420.3184, 420.5, 393.1, 236.6, {-0.00470755, 0.02290896, -0.00648108, 0.00159332}};
const KannalaBrandt wideKannala{190.978, 190.973, 254.93, 256.9, {0.0034824, 0.0007150, -0.0020532, 0.00020294}};
const Mei moderateMei{1.9, 1250, 1245, 380, 236, {-0.21, 0.14, 0.0011, -0.0008}};
const Mei flatMei{0.5, 400, 401, 376, 240, {-0.1, 0.01, 0, 0}};
const RadTan eurocRadTan{458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}};
const RadTan decentredRadTan{520, 515, 330, 250, {-0.2, 0.05, 0.012, -0.009}};
const DoubleSphere wideDoubleSphere{-0.2996, 0.5733, 158.28, 158.28, 254.97, 256.88};

struct Case {
	const char *label;
	const char *name;
	uint32_t width, height;
	CameraParameters parameters;
};
std::ostream &operator<<(std::ostream &out, const Case &c) { return out << c.label; }

class EveryCameraModel : public testing::TestWithParam<Case>
{
protected:
	CameraModel camera{GetParam().width, GetParam().height, GetParam().parameters};

	glm::dvec3 direction(double angle, double azimuth) const
	{
		return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
	}
};

TEST_P(EveryCameraModel, SeesEveryPixelAndProjectsItsRayBackOntoIt)
{
	double worst = 0;
	for (uint32_t row = 0; row < camera.height(); row += row + 8 < camera.height() ? 7 : 1)
		for (uint32_t column = 0; column < camera.width(); column += column + 8 < camera.width() ? 7 : 1) {
			const glm::dvec2 pixel(column, row);
			const auto ray = camera.unproject(pixel);
			ASSERT_TRUE(ray) << "column " << column << " row " << row;
			ASSERT_NEAR(glm::length(*ray), 1, 1e-12);
			const auto back = camera.project(*ray * 3.7);
			ASSERT_TRUE(back) << "column " << column << " row " << row;
			worst = std::max(worst, glm::length(*back - pixel));
		}
	EXPECT_LT(worst, 1e-8);
}

TEST_P(EveryCameraModel, UnprojectsWhatItProjects)
{
	double worst = 0;
	for (int i = 1; i <= 40; ++i)
		for (int j = 0; j < 24; ++j) {
			const glm::dvec3 wanted = direction(camera.maxAngle() * 0.9 * i / 40, j * std::numbers::pi / 12);
			const auto pixel = camera.project(wanted);
			ASSERT_TRUE(pixel);
			const auto ray = camera.unproject(*pixel);
			ASSERT_TRUE(ray) << i << " " << j;
			worst = std::max(worst, glm::length(*ray - wanted));
		}
	EXPECT_LT(worst, 1e-10);
}

TEST_P(EveryCameraModel, EndsAtItsMaximumAngle)
{
	EXPECT_GT(camera.maxAngle(), 0.7);
	EXPECT_TRUE(camera.project(direction(camera.maxAngle() - 1e-6, 0.3)));
	EXPECT_FALSE(camera.project(direction(camera.maxAngle() + 1e-6, 0.3)));
	EXPECT_FALSE(camera.project({0, 0, -1}));
	EXPECT_FALSE(camera.unproject({-3e4, 1e4}));
	double last = -1;
	for (int i = 0; i <= 200; ++i) {
		const double radius = camera.radius(camera.maxAngle() * i / 200);
		EXPECT_GT(radius, last);
		last = radius;
	}
}

TEST_P(EveryCameraModel, LooksAlongItsAxisAtItsCentreAndKeepsTheSides)
{
	const glm::dvec2 centre = camera.project({0, 0, 1}).value();
	EXPECT_NEAR(glm::length(camera.unproject(centre).value() - glm::dvec3(0, 0, 1)), 0, 1e-9);
	const double angle = camera.maxAngle() * 0.8;
	EXPECT_GT(camera.project(direction(angle, 0))->x, centre.x + 100);
	EXPECT_LT(camera.project(direction(angle, std::numbers::pi))->x, centre.x - 100);
	EXPECT_GT(camera.project(direction(angle, std::numbers::pi / 2))->y, centre.y + 100);
}

TEST_P(EveryCameraModel, HoldsUpToASmallerGivenAngle)
{
	const CameraModel smaller(camera.width(), camera.height(), camera.parameters(), 0.5);
	EXPECT_NEAR(smaller.maxAngle(), 0.5, 1e-3);
	EXPECT_FALSE(smaller.project(direction(0.51, 1)));
	EXPECT_LT(glm::length(smaller.project(direction(0.49, 1)).value() - camera.project(direction(0.49, 1)).value()), 1e-9);
	EXPECT_FALSE(smaller.unproject({0, 0}));
}

TEST_P(EveryCameraModel, NamesItself) { EXPECT_STREQ(camera.name(), GetParam().name); }

INSTANTIATE_TEST_SUITE_P(Models, EveryCameraModel,
						 testing::Values(Case{"OCamWide", "ocam", 752, 480, wideOCam}, Case{"OCamSheared", "ocam", 754, 480, shearedOCam},
										 Case{"OCamByItsInverse", "ocam", 752, 480, inverseOCam},
										 Case{"KannalaBrandt", "kannala_brandt", 752, 480, narrowKannala},
										 Case{"KannalaBrandtBeyond90Degrees", "kannala_brandt", 512, 512, wideKannala},
										 Case{"Mei", "mei", 752, 480, moderateMei}, Case{"MeiBelowOne", "mei", 752, 480, flatMei},
										 Case{"RadTan", "radtan", 752, 480, eurocRadTan},
										 Case{"RadTanDecentred", "radtan", 640, 480, decentredRadTan},
										 Case{"DoubleSphere", "double_sphere", 512, 512, wideDoubleSphere}),
						 [](const auto &instance) { return std::string(instance.param.label); });

using Equations = std::function<glm::dvec2(glm::dvec3)>;

/// OpenCV's p1, p2 on top of a radial factor.
glm::dvec2 brown(glm::dvec2 t, const std::array<double, 4> &k)
{
	const double r2 = t.x * t.x + t.y * t.y, radial = 1 + k[0] * r2 + k[1] * r2 * r2;
	return {t.x * radial + 2 * k[2] * t.x * t.y + k[3] * (r2 + 2 * t.x * t.x),
			t.y * radial + k[2] * (r2 + 2 * t.y * t.y) + 2 * k[3] * t.x * t.y};
}

void expectEquations(const CameraModel &camera, const Equations &equations)
{
	for (const glm::dvec3 direction : {glm::dvec3(0.1, 0, 1), {0, 0.2, 1}, {-0.4, 0.25, 1}, {0.5, -0.3, 1}, {-0.6, -0.35, 2}}) {
		const glm::dvec2 found = camera.project(direction).value(), expected = equations(direction);
		EXPECT_NEAR(found.x, expected.x, 1e-9);
		EXPECT_NEAR(found.y, expected.y, 1e-9);
	}
}

TEST(CameraEquations, KannalaBrandt)
{
	const auto &c = wideKannala;
	expectEquations(CameraModel(512, 512, c), [&](glm::dvec3 p) {
		const double r = std::hypot(p.x, p.y), a = std::atan2(r, p.z);
		const double d = a + c.k[0] * std::pow(a, 3) + c.k[1] * std::pow(a, 5) + c.k[2] * std::pow(a, 7) + c.k[3] * std::pow(a, 9);
		return glm::dvec2(c.fx * d * p.x / r + c.cx, c.fy * d * p.y / r + c.cy);
	});
}

TEST(CameraEquations, Mei)
{
	const auto &c = moderateMei;
	expectEquations(CameraModel(752, 480, c), [&](glm::dvec3 p) {
		const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z), z = p.z / length + c.xi;
		const glm::dvec2 d = brown({p.x / length / z, p.y / length / z}, c.k);
		return glm::dvec2(c.fx * d.x + c.cx, c.fy * d.y + c.cy);
	});
}

TEST(CameraEquations, RadTan)
{
	const auto &c = decentredRadTan;
	expectEquations(CameraModel(640, 480, c), [&](glm::dvec3 p) {
		const glm::dvec2 d = brown({p.x / p.z, p.y / p.z}, c.k);
		return glm::dvec2(c.fx * d.x + c.cx, c.fy * d.y + c.cy);
	});
}

TEST(CameraEquations, DoubleSphere)
{
	const auto &c = wideDoubleSphere;
	expectEquations(CameraModel(512, 512, c), [&](glm::dvec3 p) {
		const double d1 = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
		const double d2 = std::sqrt(p.x * p.x + p.y * p.y + (c.xi * d1 + p.z) * (c.xi * d1 + p.z));
		const double n = c.alpha * d2 + (1 - c.alpha) * (c.xi * d1 + p.z);
		return glm::dvec2(c.fx * p.x / n + c.cx, c.fy * p.y / n + c.cy);
	});
}

/// OCamCalib's own words: [x; y] = A^-1 (m - centre), z = f(rho), z backwards.
TEST(CameraEquations, OCamUnprojection)
{
	const auto &c = shearedOCam;
	const CameraModel camera(754, 480, c);
	for (const glm::dvec2 pixel : {glm::dvec2(10, 20), {700, 33}, {402, 470}, {333.3, 222.2}}) {
		const double row = pixel.y - c.centreRow, column = pixel.x - c.centreColumn, determinant = c.c - c.d * c.e;
		const double x = (row - c.d * column) / determinant, y = (-c.e * row + c.c * column) / determinant, rho = std::hypot(x, y);
		double z = 0;
		for (size_t i = 0; i < c.direct.size(); ++i) z += c.direct[i] * std::pow(rho, double(i));
		const glm::dvec3 expected = glm::normalize(glm::dvec3(y, x, -z));
		EXPECT_LT(glm::length(camera.unproject(pixel).value() - expected), 1e-12);
	}
}

/// The original ARift's cameras: published inverse polynomials, correct world2cam in double precision. Direction -> column, row.
TEST(GoldenVectors, OriginalARift)
{
	const CameraModel left(752, 480,
						   OCam{{},
								{1329.80078899012, 5555.49279942498, 17467.33371991807, 35202.72074605963, 47009.73643667896,
								 43383.42090721455, 27558.36619048961, 11502.39951453818, 2829.42249820711, 309.43828391667},
								211.9393300155207,
								354.6241749915297,
								1.000374008613590,
								-9.611375125204626e-05,
								-1.127978103886716e-04});
	const CameraModel right(752, 480, inverseOCam);
	const struct {
		glm::dvec3 direction;
		glm::dvec2 left, right;
	} vectors[] = {
		{{0, 0, 1}, {354.6242, 211.9393}, {394.1357, 236.6461}},       {{0.1, 0, 1}, {396.4778, 211.9353}, {436.0269, 236.6486}},
		{{0, 0.1, 1}, {354.6195, 253.8086}, {394.1344, 278.5395}},     {{-0.5, 0.25, 1}, {162.0234, 308.2888}, {202.4578, 332.4770}},
		{{0.5, -0.25, 1}, {547.2249, 115.5898}, {585.8137, 140.8152}}, {{1, 0.3, 1}, {680.4669, 309.7007}, {720.6696, 334.6319}},
		{{-1, -0.3, 1}, {28.7815, 114.1780}, {67.6019, 138.6603}},
	};
	for (const auto &v : vectors) {
		EXPECT_LT(glm::length(left.project(v.direction).value() - v.left), 1e-3);
		EXPECT_LT(glm::length(right.project(v.direction).value() - v.right), 1e-3);
	}
	// Fields of view of the published images: to the far corner.
	EXPECT_NEAR(left.maxAngle() * 180 / std::numbers::pi, 64.5, 0.1);
	EXPECT_NEAR(right.maxAngle() * 180 / std::numbers::pi, 62.0, 0.1);
}

/// The Kannala-Brandt fit of the right camera differs from it by at most 0.003 px: two models that know nothing of each other agree.
TEST(GoldenVectors, KannalaBrandtFitOfTheRightCamera)
{
	const CameraModel ocam(752, 480, OCam{{}, inverseOCam.inverse, 236.646089, 394.135741, 1, 0, 0});
	const CameraModel kannala(752, 480, KannalaBrandt{420.3184, 420.3184, 394.135741, 236.646089, narrowKannala.k});
	for (double angle = 0.02; angle < 1.08; angle += 0.02) {
		const glm::dvec3 direction(std::sin(angle) * 0.8, std::sin(angle) * -0.6, std::cos(angle));
		EXPECT_LT(glm::length(ocam.project(direction).value() - kannala.project(direction).value()), 0.005);
	}
}

TEST(CameraModel, StopsWhereItsProjectionTurnsBack)
{
	// r (1 - 0.3 r^2) rises up to r = 1.054, 46.5 degrees: beyond the nearest edge, before the far corner.
	const CameraModel camera(752, 480, RadTan{400, 400, 376, 240, {-0.3, 0, 0, 0}});
	EXPECT_NEAR(std::tan(camera.maxAngle()), std::sqrt(1 / 0.9), 2e-3);
	EXPECT_FALSE(camera.unproject({0, 0}));
	EXPECT_TRUE(camera.unproject({376, 0}));
	EXPECT_TRUE(camera.project({1.05, 0, 1}));
	EXPECT_FALSE(camera.project({1.06, 0, 1}));
}

TEST(CameraModel, RefusesNumbersThatAreNoCamera)
{
	const auto ocam = [](auto change) {
		OCam camera = wideOCam;
		change(camera);
		return camera;
	};
	const double nan = std::nan("");
	const struct {
		const char *expected;
		uint32_t width, height;
		CameraParameters parameters;
		double maxAngle = 0;
	} table[] = {
		{"image size 0 x 480", 0, 480, wideOCam},
		{"image size 752 x 20000", 752, 20000, wideOCam},
		{"centre at column 394.5", 390, 480, wideOCam},
		{"centre at column", 752, 240, wideOCam},
		{"a0 = 206.5", 752, 480, ocam([](OCam &c) { c.direct[0] = 206.5; })},
		{"without polynomial", 752, 480, ocam([](OCam &c) { c.direct = {}; })},
		{"affine c = 1.2", 752, 480, ocam([](OCam &c) { c.c = 1.2; })},
		{"d = 0.2", 752, 480, ocam([](OCam &c) { c.d = 0.2; })},
		{"direct polynomial holds nan", 752, 480, ocam([&](OCam &c) { c.direct[2] = nan; })},
		{"12.871 px on the axis", 752, 480, OCam{{}, {725.740198, 580.959756, 188.838455, 105.465531, 27.232993, 2.433748}, 240, 376}},
		{"nearest edge", 752, 480, ocam([](OCam &c) {
			 c.direct = {-206, 0, -0.05};
		 })},
		{"focal lengths -1", 752, 480, KannalaBrandt{-1, 400, 376, 240, {}}},
		{"focal lengths 400", 752, 480, RadTan{400, 4000, 376, 240, {}}},
		{"distortion holds inf", 752, 480, RadTan{400, 400, 376, 240, {INFINITY, 0, 0, 0}}},
		{"nearest edge", 752, 480, KannalaBrandt{400, 400, 376, 240, {-2, 0, 0, 0}}},
		{"nearest edge", 752, 480, RadTan{100, 100, 376, 240, {-0.4, 0, 0, 0}}},
		{"xi = -1", 752, 480, Mei{-1, 400, 400, 376, 240, {}}},
		{"alpha = 1.5", 752, 480, DoubleSphere{0, 1.5, 400, 400, 376, 240}},
		{"xi = nan", 752, 480, DoubleSphere{nan, 0.5, 400, 400, 376, 240}},
		{"maximum angle 4", 752, 480, wideOCam, 4},
		{"turns back", 752, 480, RadTan{400, 400, 376, 240, {}}, 1.6},
		{"turns back", 752, 480, RadTan{400, 400, 376, 240, {-0.3, 0, 0, 0}}, 1},
	};
	for (const auto &row : table) try {
			const CameraModel camera(row.width, row.height, row.parameters, row.maxAngle);
			ADD_FAILURE() << "accepted, expected: " << row.expected;
		} catch (const InputError &error) {
			EXPECT_NE(std::string(error.what()).find(row.expected), std::string::npos) << error.what() << " | expected: " << row.expected;
		}
}

TEST(PixelRays, LieRowByRowAndAreZeroWhereNothingIsSeen)
{
	const CameraModel camera(752, 480, RadTan{400, 400, 376, 240, {-0.3, 0, 0, 0}});
	const std::vector<XrVector3f> rays = pixelRays(camera);
	ASSERT_EQ(rays.size(), 752u * 480u);
	const XrVector3f &corner = rays[0], &seen = rays[100 * 752 + 300];
	EXPECT_EQ(corner.x, 0);
	EXPECT_EQ(corner.y, 0);
	EXPECT_EQ(corner.z, 0);
	const glm::dvec2 pixel = camera.project({seen.x, seen.y, seen.z}).value();
	EXPECT_NEAR(pixel.x, 300, 1e-3);
	EXPECT_NEAR(pixel.y, 100, 1e-3);
}

} // namespace
} // namespace arift
