// What a driver compiles, it compiles before the first frame.
#include "tests/gpu/panel_fixture.h"
#include <fstream>
#include <sstream>

namespace arift
{
namespace
{

/// Bytes of this process's memory that can be executed and come from no file: what a software renderer has compiled so far.
size_t compiledBytes()
{
	std::ifstream maps("/proc/self/maps");
	size_t bytes = 0;
	for (std::string line; std::getline(maps, line);) {
		std::istringstream fields(line);
		std::string range, permissions, offset, device, inode, file;
		fields >> range >> permissions >> offset >> device >> inode >> file;
		if (permissions.find('x') == std::string::npos || !file.empty()) continue;
		const size_t dash = range.find('-');
		bytes += std::stoull(range.substr(dash + 1), nullptr, 16) - std::stoull(range.substr(0, dash), nullptr, 16);
	}
	return bytes;
}

class WarmUp : public PanelTest
{
protected:
	/// Cameras, a layer over everything with parts that are empty, opaque and neither, and quads on top, each at its first time.
	void renderWhatIsUsual()
	{
		render(); // no camera
		seeGrey(100);
		render();
		const uint64_t views = addImage(
			1122, 301,
			[](uint32_t x, uint32_t, uint32_t) {
				return std::array<uint8_t, 4>{10, 20, 30, uint8_t(x < 400 ? 0 : x < 800 ? 255 : 128)};
			},
			VK_FORMAT_R8G8B8A8_SRGB);
		PanelLayer &layer = inputs.layers.emplace_back(PanelLayer{.flags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT});
		for (size_t e = 0; e < 2; ++e)
			layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-1.2f, 1.2f, 1.2f, -1.2f}, {views, 0, {{0, 0}, {1122, 301}}}};
		render();
		const uint64_t picture = addImage(
			64, 64,
			[](auto...) {
				return std::array<uint8_t, 4>{1, 2, 3, 128};
			},
			VK_FORMAT_R8G8B8A8_SRGB);
		addQuad(picture, {identityOrientation, {0, 0, -1}}, {0.5f, 0.5f}, {{0, 0}, {64, 64}}).flags =
			XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
		render();
		inputs.layers.erase(inputs.layers.begin()); // the quad alone, over the camera
		render();
		inputs.layers.front().flags = 0; // as of the lowest layer of an application that is shown by a key
		inputs.layers.front().key = KeyedOut{};
		render();
		inputs.layers.push_back({.passthrough = PassthroughStyle{.opacity = 0.5f}});
		render();
		inputs.layers.back().passthrough->contrast = 0.5f;
		render();
		inputs.cameras[1]->lens = 0; // an eye's camera is lost
		render();
	}
};

TEST_F(WarmUp, NoFrameCompilesAnything)
{
	renderer.warmUp();
	const size_t before = compiledBytes();
	renderWhatIsUsual();
	EXPECT_EQ(compiledBytes(), before);
}

TEST_F(WarmUp, WithoutItFramesCompileOnASoftwareRenderer)
{
	if (device.identity().deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) GTEST_SKIP() << "the GPU's code is not counted";
	const size_t before = compiledBytes();
	renderWhatIsUsual();
	EXPECT_GT(compiledBytes(), before) << "the count counts";
}

struct Unusual : PanelTest {
	Unusual() : PanelTest(Unready::leftOut) {}
};

TEST_F(Unusual, ALayerIsLeftOutUntilItsPipelineIsMadeAndNeverWaitedFor)
{
	seeGrey(51);
	render();
	const std::array<int, 3> world = at(centreX, centreY);
	addUniformLayer({102, 51, 153, 255}, XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT).key = KeyedOut{}; // and not sRGB encoded
	render();
	EXPECT_EQ(at(centreX, centreY), world) << "what is first asked for cannot be there";
	for (const XrTime end = realTime() + 60 * second; at(centreX, centreY) == world && realTime() < end;) render();
	expectNear(at(centreX, centreY), {0.4, 0.2, 0.6});
}

} // namespace
} // namespace arift
