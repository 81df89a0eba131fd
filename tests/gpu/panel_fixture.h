// A renderer over a plain rig, images as an application would make them, and colours by hand. For the panel tests.
#pragma once
#include "runtime/compositor/panel_renderer.h"
#include "runtime/gpu/device.h"
#include "runtime/optics/rig.h"
#include <functional>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace arift
{

using Linear = std::array<double, 3>;

/// A layer of one colour in front of grey cameras: what blending makes of it is computed by hand.
namespace by_hand
{
inline constexpr XrCompositionLayerFlags sourceAlpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
inline constexpr XrCompositionLayerFlags unpremultiplied = sourceAlpha | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
inline constexpr auto opaque = XR_ENVIRONMENT_BLEND_MODE_OPAQUE, additive = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE,
					  alphaBlend = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
inline constexpr uint8_t cameraValue = 51;
inline constexpr double camera = 0.2;                                       ///< linear
inline constexpr Linear cameraColour{200 / 255.0, 100 / 255.0, 50 / 255.0}; ///< linear, of seeColour()
inline constexpr std::array<uint8_t, 4> colour{102, 51, 153, 153};
inline constexpr Linear c{0.4, 0.2, 0.6};
inline constexpr double a = 0.6;
} // namespace by_hand

/// What a linear value is in an sRGB texel, 0..255.
double encoded(double linear);
/// The other way round. IEC 61966-2-1.
double linearOf(double code);

/// DK1 lens, eyes 64 mm apart, two cameras of 320x240 at the eyes that see 76 x 62 degrees.
Rig plainRig();
constexpr uint32_t cameraWidth = 320, cameraHeight = 240;

/// The head at rest in the origin, seen from the eyes; no camera, no layer.
PanelInputs inputsAtRest(const Rig &rig);

/// An image of an application: filled by `texel` (x, y, array layer -> RGBA bytes), handed over as the specification says.
class LayerImage
{
public:
	using Texel = std::function<std::array<uint8_t, 4>(uint32_t, uint32_t, uint32_t)>;
	LayerImage(gpu::Device &device, uint32_t width, uint32_t height, const Texel &texel, VkFormat format = VK_FORMAT_R8G8B8A8_UNORM,
			   uint32_t arrayLayers = 1, VkImageCreateFlags flags = 0);
	VkImage image() const { return shared_.image(); }
	gpu::ImageRows rows() const { return shared_.rows(); }
	const gpu::ImageSpec &spec() const { return shared_.spec(); }

private:
	gpu::SharedImage shared_;
};

class PanelTest : public testing::Test
{
protected:
	explicit PanelTest(Unready unready = Unready::waitedFor)
		: rig(plainRig()), renderer(device, rig, VK_FORMAT_R8G8B8A8_SRGB, unready), inputs(inputsAtRest(rig))
	{
	}
	~PanelTest() override { EXPECT_EQ(device.validationMessages(), 0u); }

	/// A frame whose every byte is what `value` says for x (in bytes) and y.
	CameraFrame frame(PixelFormat format, const std::function<uint8_t(uint32_t, uint32_t)> &value, bool ours = true, uint32_t padding = 0);
	/// Both eyes see a uniform grey image of this raw value.
	void seeGrey(uint8_t value);
	/// Both eyes see by_hand::cameraColour everywhere.
	void seeColour();
	/// A layer of one colour (linear, RGBA bytes) that fills both eyes, at the pose it is shown for.
	PanelLayer &addUniformLayer(std::array<uint8_t, 4> colour, XrCompositionLayerFlags flags);
	/// A quad with one image for both eyes.
	PanelLayer &addQuad(uint64_t image, XrPosef quadInOrigin, XrExtent2Df size, XrRect2Di rect, uint32_t arrayIndex = 0);
	uint64_t addImage(uint32_t width, uint32_t height, const LayerImage::Texel &texel, VkFormat format = VK_FORMAT_R8G8B8A8_UNORM,
					  uint32_t arrayLayers = 1);

	/// An image that is pure green in this rectangle and magenta around it.
	uint64_t addGreenAmongMagenta();
	static constexpr XrRect2Di greenOnes{{2, 1}, {4, 2}};
	/// Panel pixels of the last render() that are pure green, when all others are black; the test fails where they are not.
	int greenPixels() const;
	/// `count` cube maps in one image: six array layers of `texel` each.
	uint64_t addCube(uint32_t size, const LayerImage::Texel &texel, uint32_t count);

	void render();
	/// RGB bytes at a panel pixel of the last render().
	std::array<int, 3> at(int x, int y) const;
	/// The panel pixel in which an eye sees a point of the origin frame, in green.
	glm::dvec2 pixelOf(Eye eye, XrVector3f point) const;
	uint64_t add(std::unique_ptr<LayerImage> image);
	void expectNear(std::array<int, 3> found, const Linear &expected, double tolerance = 1.01) const;

	gpu::Device device;
	Rig rig;
	std::vector<std::unique_ptr<LayerImage>> images;
	PanelRenderer renderer;
	PanelInputs inputs;
	ReadbackImage panel;
	uint64_t sequence = 0;
	/// On the left eye's axis.
	static constexpr int centreX = 345, centreY = 400;
};

} // namespace arift
