// What the shaders evaluate, in their single precision and by the headers' formulae, against the models in double precision.
#include "runtime/optics/rig.h"
#include "tests/common/shared_data.h"
#include "tests/unit/optics/scratch.h"
#include <cmath>
#include <glm/geometric.hpp>

namespace arift
{
namespace
{

float gain(const ShaderCamera &form, float maxAngle, glm::vec3 q, float u)
{
	if (form.coefficients > 0) {
		const float x = (q.z / u - form.cosineCentre) * form.cosineScale;
		float sum = 0;
		for (uint32_t i = form.coefficients; i-- > 0;) sum = sum * x + form.g[i];
		return sum;
	}
	const float angle = std::atan2(std::sqrt(q.x * q.x + q.y * q.y), q.z), last = float(form.table.size() - 1);
	const float at = std::min(angle / maxAngle * last, last);
	const size_t low = std::min(size_t(at), form.table.size() - 2);
	return form.table[low] * (1 - (at - float(low))) + form.table[low + 1] * (at - float(low));
}

glm::vec2 shaderProject(const ShaderCamera &form, float maxAngle, glm::vec3 q)
{
	const float u = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
	glm::vec2 m = glm::vec2(q.x, q.y) / u * gain(form, maxAngle, q, u);
	if (form.tangential[0] != 0 || form.tangential[1] != 0) {
		const glm::vec2 t = glm::vec2(q.x, q.y) / (q.z + form.xi * u);
		const float r2 = t.x * t.x + t.y * t.y, p1 = form.tangential[0], p2 = form.tangential[1];
		m += glm::vec2(2 * p1 * t.x * t.y + p2 * (r2 + 2 * t.x * t.x), p1 * (r2 + 2 * t.y * t.y) + 2 * p2 * t.x * t.y);
	}
	return form.centre + form.affine * m;
}

/// Largest distance between the pixel a ray comes from and where the shader looks for it, over the whole image.
double worstOverTheImage(const CameraModel &camera, const ShaderCamera &form)
{
	double worst = 0;
	for (uint32_t row = 0; row < camera.height(); row += 3)
		for (uint32_t column = 0; column < camera.width(); column += 3)
			if (const auto ray = camera.unproject({column, row})) {
				const glm::dvec2 found = shaderProject(form, float(camera.maxAngle()), glm::vec3(*ray) * 1.7f);
				worst = std::max(worst, glm::length(found - glm::dvec2(column, row)));
			}
	return worst;
}

TEST(ShaderCamera, MatchesTheShippedRig)
{
	const Rig rig = readRig(std::filesystem::path(ARIFT_SOURCE_DIR) / "calib/rigs/arift.toml");
	for (const RigCamera &camera : rig.cameras) {
		const ShaderCamera form = fitForShader(camera.model);
		EXPECT_GT(form.coefficients, 0u);
		EXPECT_LE(form.residual, 0.004);
		const double worst = worstOverTheImage(camera.model, form);
		RecordProperty("worst_px", std::to_string(worst));
		EXPECT_LE(worst, 0.005);
	}
}

TEST(ShaderCamera, MatchesEveryOtherModel)
{
	const CameraModel cameras[] = {
		CameraModel(512, 512, KannalaBrandt{190.978, 190.973, 254.93, 256.9, {0.0034824, 0.0007150, -0.0020532, 0.00020294}}),
		CameraModel(752, 480, Mei{1.9, 1250, 1245, 380, 236, {-0.21, 0.14, 0.0011, -0.0008}}),
		CameraModel(640, 480, RadTan{520, 515, 330, 250, {-0.2, 0.05, 0.012, -0.009}}),
		CameraModel(752, 480, RadTan{458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}}),
		CameraModel(512, 512, DoubleSphere{-0.2996, 0.5733, 158.28, 158.28, 254.97, 256.88}),
	};
	for (const CameraModel &camera : cameras) {
		const ShaderCamera form = fitForShader(camera);
		EXPECT_LE(form.residual, 0.004) << camera.name();
		EXPECT_LE(worstOverTheImage(camera, form), 0.005) << camera.name();
		EXPECT_NEAR(form.cosineLimit, std::cos(camera.maxAngle()), 1e-6);
	}
}

/// A mirror's steep curve, which no polynomial in the cosine follows: it falls back on a table.
TEST(ShaderCamera, TakesATableWhereNoPolynomialIsGoodEnough)
{
	const CameraModel camera(
		1024, 768, OCam{{-153.467, 0, 1.034692e-3, 5.138226e-6, -5.694855e-9}, {}, 382.828814, 456.345673, 1.000651, -6.25e-4, 4.31e-4});
	const ShaderCamera form = fitForShader(camera);
	EXPECT_EQ(form.coefficients, 0u);
	EXPECT_GE(form.table.size(), 1024u);
	EXPECT_LE(form.residual, 0.004);
	EXPECT_LE(worstOverTheImage(camera, form), 0.02);
}

TEST(ShaderCamera, ATighterToleranceTakesMoreTerms)
{
	const CameraModel camera(512, 512, DoubleSphere{-0.2996, 0.5733, 158.28, 158.28, 254.97, 256.88});
	const ShaderCamera coarse = fitForShader(camera, 0.5), fine = fitForShader(camera, 0.002);
	EXPECT_LT(coarse.coefficients, fine.coefficients);
	EXPECT_LE(coarse.residual, 0.5);
	EXPECT_GT(coarse.residual, fine.residual);
	EXPECT_LE(worstOverTheImage(camera, coarse), 0.55);
}

TEST(ShaderCamera, MatchesEveryRealOCamFile)
{
	const auto folder = test::sharedData("ocam");
	if (!folder) GTEST_SKIP() << test::noSharedData;
	int files = 0;
	for (const auto &entry : std::filesystem::directory_iterator(*folder)) {
		if (entry.path().extension() != ".txt") continue;
		const CameraModel camera = readOCamFile(entry.path().string());
		const double worst = worstOverTheImage(camera, fitForShader(camera));
		EXPECT_LE(worst, 0.02) << entry.path();
		++files;
	}
	EXPECT_GT(files, 0);
}

TEST(ShaderLens, FollowsTheLensWithinAFractionOfAPanelPixel)
{
	const struct {
		LensModel lens;
		double allowed;
	} table[] = {{LensModel(SplineLens{0.010}), 0.125},
				 {LensModel(SplineLens{0.007760465}), 0.16},
				 {LensModel(SplineLens{0.012}), 0.08},
				 {LensModel(SplineLens{0.017760465}), 0.05},
				 {LensModel(PolynomialLens{}), 0.001}};
	for (const auto &[lens, allowed] : table) {
		const ShaderLens form = fitForShader(lens);
		ASSERT_GE(form.coefficients, 3u);
		EXPECT_LE(form.residual, allowed);
		double worst = 0;
		const double rim = std::sqrt(lens.maxR2());
		for (double r = 0.0007; r < rim; r += 0.0013) {
			const float r2 = float(r * r);
			float d = 0;
			for (uint32_t i = form.coefficients; i-- > 0;) d = d * r2 + form.d[i];
			// where on the panel the lens shows the direction that the shader takes this place for
			const glm::dvec2 shown = lens.pixel(Eye::left, Channel::green, {0, r * double(d)}).value_or(glm::dvec2(-1e9));
			const glm::dvec2 place = lens.centre(Eye::left) - glm::dvec2(0, r * lens.pixelsPerTangent());
			worst = std::max(worst, glm::length(shown - place));
		}
		EXPECT_LE(worst, allowed);
		EXPECT_NEAR(worst, form.residual, 0.01 + 0.1 * allowed);
	}
}

} // namespace
} // namespace arift
