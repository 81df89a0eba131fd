// The cameras' image as a layer with a style, by colours computed a second time here.
#include "tests/gpu/panel_fixture.h"
#include <cmath>
#include <fmt/core.h>

namespace arift
{
namespace
{

using by_hand::a, by_hand::c, by_hand::colour, by_hand::sourceAlpha;
constexpr Linear camera = by_hand::cameraColour;

Linear over(const Linear &light, const Linear &kept, double below)
{
	return {light[0] + kept[0] * below, light[1] + kept[1] * below, light[2] + kept[2] * below};
}
Linear times(const Linear &light, double factor) { return over({0, 0, 0}, light, factor); }

/// CIE 15 with the white point D65, Rec. 709 primaries (IEC 61966-2-1).
Linear adjustedInLab(const Linear &light, double brightness, double contrast, double saturation)
{
	const double white[3] = {0.95047, 1, 1.08883};
	const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
	const auto inverse = [](double v) { return v > 6.0 / 29 ? v * v * v : (116 * v - 16) * 27 / 24389; };
	const double x = f((0.4124564 * light[0] + 0.3575761 * light[1] + 0.1804375 * light[2]) / white[0]);
	const double y = f(0.2126729 * light[0] + 0.7151522 * light[1] + 0.0721750 * light[2]);
	const double z = f((0.0193339 * light[0] + 0.1191920 * light[1] + 0.9503041 * light[2]) / white[2]);
	double l = 116 * y - 16;
	const double as = 500 * (x - y) * saturation, bs = 200 * (y - z) * saturation;
	l = std::clamp((l - 50) * contrast + 50, 0.0, 100.0);
	l = std::clamp(l + brightness, 0.0, 100.0);
	const double fy = (l + 16) / 116, X = white[0] * inverse(fy + as / 500), Y = inverse(fy), Z = white[2] * inverse(fy - bs / 200);
	return {std::clamp(3.2404542 * X - 1.5371385 * Y - 0.4985314 * Z, 0.0, 1.0),
			std::clamp(-0.9692660 * X + 1.8760108 * Y + 0.0415560 * Z, 0.0, 1.0),
			std::clamp(0.0556434 * X - 0.2040259 * Y + 1.0572252 * Z, 0.0, 1.0)};
}

class PanelPassthroughTest : public PanelTest
{
protected:
	PanelPassthroughTest()
	{
		inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
		seeColour();
	}
	PassthroughStyle &addPassthrough(float opacity = 1)
	{
		PanelLayer &layer = inputs.layers.emplace_back();
		layer.passthrough = PassthroughStyle{.opacity = opacity};
		return *layer.passthrough;
	}
	void expectInBothEyes(const Linear &expected, double tolerance = 1.5)
	{
		render();
		expectNear(at(centreX, centreY), expected, tolerance);
		expectNear(at(1280 - centreX, centreY), expected, tolerance);
	}
	LayerTexture addMap(const std::function<std::array<uint8_t, 4>(uint32_t)> &map)
	{
		return {addImage(256, 1, [&](uint32_t x, auto, auto) { return map(x); }), 0, {{0, 0}, {256, 1}}};
	}
};

TEST_F(PanelPassthroughTest, ItsOpacityIsOverBlackWhereNothingIsBelow)
{
	addPassthrough(0.5f);
	expectInBothEyes(times(camera, 0.5));
}

TEST_F(PanelPassthroughTest, LayersLieBelowAndAboveInTheirOrder)
{
	addUniformLayer(colour, 0);
	addPassthrough(0.25f);
	expectInBothEyes(over(times(c, 0.75), camera, 0.25));
	addUniformLayer({0, 51, 0, 102}, sourceAlpha); // 0.2 green, alpha 0.4
	expectInBothEyes(over({0, 0.2, 0}, over(times(c, 0.75), camera, 0.25), 0.6));
	addPassthrough(0.5f);
	expectInBothEyes(over(times(over({0, 0.2, 0}, over(times(c, 0.75), camera, 0.25), 0.6), 0.5), camera, 0.5));
}

TEST_F(PanelPassthroughTest, AnOpaqueLayerAboveHidesItAndWhatIsBelow)
{
	addUniformLayer({255, 255, 255, 255}, 0);
	addPassthrough(0.5f);
	addUniformLayer({51, 51, 51, 0}, 0);
	expectInBothEyes({0.2, 0.2, 0.2});
}

TEST_F(PanelPassthroughTest, OverTheWorldItIsTheWorld)
{
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	addPassthrough(0.5f);
	expectInBothEyes(camera);
	addUniformLayer(colour, sourceAlpha);
	expectInBothEyes(over(c, camera, 1 - a));
}

TEST_F(PanelPassthroughTest, IsTheCalmPatternWithoutACamera)
{
	inputs.cameras = {};
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	render();
	const auto calm = at(centreX, centreY);
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	addPassthrough().brightness = 1e-4f; // a style that changes nothing to be seen
	render();
	for (size_t channel = 0; channel < 3; ++channel) EXPECT_NEAR(at(centreX, centreY)[channel], calm[channel], 1);
}

TEST_F(PanelPassthroughTest, AdjustsBrightnessContrastAndSaturationInLab)
{
	PassthroughStyle &style = addPassthrough();
	double worst = 0;
	for (const auto &[brightness, contrast, saturation] : {std::array{20.0, 1.0, 1.0},
														   {-20, 1, 1},
														   {0, 0.5, 1},
														   {0, 1.4, 1},
														   {0, 1, 0},
														   {0, 1, 1.2},
														   {10, 0.7, 0.5},
														   {100, 1, 1},
														   {-100, 1, 1}}) {
		style.brightness = float(brightness);
		style.contrast = float(contrast);
		style.saturation = float(saturation);
		const Linear expected = adjustedInLab(camera, brightness, contrast, saturation);
		expectInBothEyes(expected, 2);
		for (size_t channel = 0; channel < 3; ++channel)
			worst = std::max(worst, std::abs(at(centreX, centreY)[channel] - encoded(expected[channel])));
	}
	fmt::print("[ FIGURE   ] brightness, contrast and saturation: at most {:.2f} of 255 from CIELAB in double precision\n", worst);
}

TEST_F(PanelPassthroughTest, AMapReplacesLuma)
{
	seeGrey(51); // linear 0.2: 124 of 255 encoded
	PassthroughStyle &style = addPassthrough();
	style.map = addMap([](uint32_t x) { return std::array<uint8_t, 4>{uint8_t(255 - x), 10, uint8_t(x < 200 ? 40 : 0), 255}; });
	expectInBothEyes({linearOf(255 - 123.6), linearOf(10), linearOf(40)}, 2);
	style.map = addMap([](uint32_t) { return std::array<uint8_t, 4>{200, 100, 50, 51}; });
	style.opacity = 0.5f;
	expectInBothEyes(times({linearOf(200), linearOf(100), linearOf(50)}, 0.1), 2);
}

TEST_F(PanelPassthroughTest, AMapThatIsGoneIsLeftOut)
{
	PassthroughStyle &style = addPassthrough(0.5f);
	style.map = LayerTexture{4711, 0, {{0, 0}, {256, 1}}};
	expectInBothEyes(times(camera, 0.5));
}

TEST_F(PanelPassthroughTest, EdgesAreDrawnWhereTheImageHasThem)
{
	// Left half dark, right half bright.
	for (uint32_t e = 0; e < 2; ++e)
		inputs.cameras[e] =
			CameraView{.frame = frame(PixelFormat::grey8, [](uint32_t x, auto) { return uint8_t(x < cameraWidth / 2 ? 20 : 150); }),
					   .cameraInOrigin = rig.eyeInHead[e],
					   .lens = e};
	PassthroughStyle &style = addPassthrough(0);
	style.edge = {0, 1, 0, 0.5f};
	render();
	int greenest = 0, where = 0;
	for (int x = centreX - 40; x < centreX + 40; ++x)
		if (at(x, centreY)[1] > greenest) {
			greenest = at(x, centreY)[1];
			where = x;
		}
	EXPECT_NEAR(greenest, encoded(0.5), 2) << "of half its light";
	EXPECT_NEAR(where, pixelOf(Eye::left, {rig.eyeInHead[0].position.x, 0, -2}).x, 3);
	for (const int off : {-20, 20}) EXPECT_EQ(at(where + off, centreY), (std::array{0, 0, 0})) << "nothing but edges";
	style.opacity = 1;
	render();
	const auto onEdge = at(where, centreY);
	EXPECT_NEAR(onEdge[1], encoded(0.5 + linearOf(onEdge[0])), 3) << "half green over half of the grey";
	expectNear(at(where + 20, centreY), {150 / 255.0, 150 / 255.0, 150 / 255.0}, 2);
}

} // namespace
} // namespace arift
