// The compositor's thread, once its memory is there, asks no allocator for more: what it plans, chooses and records lives in its own.
// This file stands in the place of operator new for the whole program, and counts on the threads that want it.
#include "runtime/base/frame_memory.h"
#include "runtime/compositor/compositor.h"
#include "runtime/ipc/shared_memory.h"
#include "tests/gpu/panel_fixture.h"
#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

namespace
{

thread_local bool isCounted = false;
std::atomic<int> allocations = 0;

void *counted(std::size_t bytes)
{
	if (isCounted) ++allocations;
	void *const memory = std::malloc(std::max<std::size_t>(bytes, 1));
	if (!memory) throw std::bad_alloc();
	return memory;
}

} // namespace

void *operator new(std::size_t bytes) { return counted(bytes); }
void *operator new[](std::size_t bytes) { return counted(bytes); }
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete[](void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void *memory, std::size_t) noexcept { std::free(memory); }

namespace arift
{
namespace
{

TEST(FrameMemory, IsUsedAgainTurnByTurn)
{
	FrameMemory memory(1 << 12);
	isCounted = true;
	const void *first = nullptr;
	for (int turn = 0; turn < 3; ++turn) {
		const FrameMemory::Turn here(memory);
		FrameVector<int> numbers(100, turn);
		if (turn == 0) first = numbers.data();
		EXPECT_EQ(numbers.data(), first);
		FrameVector<FrameVector<double>> nested(3, FrameVector<double>(10, 0.5));
		EXPECT_EQ(nested[2][9], 0.5);
	}
	const int before = allocations;
	{
		const FrameMemory::Turn here(memory);
		const FrameVector<int> numbers(1000); // 4000 of the 4096 bytes
		EXPECT_EQ(allocations, before);
		const FrameVector<int> more(1000);
		EXPECT_EQ(allocations, before + 1) << "the rest comes from the heap";
	}
	{
		const FrameMemory::Turn here(memory); // twice what was wanted
		const int grown = allocations;
		const FrameVector<int> numbers(1000), more(1000);
		EXPECT_EQ(allocations, grown) << "and is there the next time";
	}
	const int outside = allocations;
	const FrameVector<int> heap(10);
	EXPECT_EQ(allocations, outside + 1) << "without a turn it is the heap's";
	isCounted = false;
}

/// Shows the same layers as another submission in every image: nothing known of the one before helps.
class Source final : public FrameSource
{
public:
	explicit Source(std::vector<PanelLayer> layers, XrEnvironmentBlendMode mode) : layers_(std::move(layers)), mode_(mode) {}
	void wake(const Opportunity &) override {}
	std::shared_ptr<const FrameContent> content() override
	{
		const bool before = std::exchange(isCounted, false); // what a session prepares on its own thread
		for (PanelLayer &layer : layers_)
			for (size_t eye = 0; eye < 2; ++eye) {
				if (layer.projection[eye]) layer.projection[eye]->texture.content = number_;
				if (layer.quad[eye]) layer.quad[eye]->texture.content = number_;
				if (layer.curved[eye]) layer.curved[eye]->texture.content = number_;
				if (layer.cube[eye]) layer.cube[eye]->texture.content = number_;
			}
		auto content = std::make_shared<FrameContent>();
		content->frame = number_++;
		content->blendMode = mode_;
		content->layers = layers_;
		isCounted = before;
		return content;
	}
	void shown(const std::shared_ptr<const FrameContent> &) override {}

private:
	std::vector<PanelLayer> layers_;
	const XrEnvironmentBlendMode mode_;
	uint64_t number_ = 1;
};

constexpr uint64_t viewsKey = 1, cubesKey = 2;
constexpr XrRect2Di part{{0, 0}, {64, 64}};

class Frames : public PanelTest
{
protected:
	Frames() { seeGrey(100); }
	static std::array<uint8_t, 4> texel(uint32_t x, uint32_t y) { return {10, 20, 30, uint8_t(x < 100 ? 0 : y < 100 ? 255 : 128)}; }
	PanelLayer &add() { return layers.emplace_back(PanelLayer{.flags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT}); }
	PanelLayer &addViews()
	{
		PanelLayer &layer = add();
		for (size_t eye = 0; eye < 2; ++eye)
			layer.projection[eye] = ProjectionView{rig.eyeInHead[eye], {-1.2f, 1.2f, 1.2f, -1.2f}, {viewsKey, 0, {{0, 0}, {300, 300}}}};
		return layer;
	}
	PanelLayer &addQuadAt(float x)
	{
		PanelLayer &layer = add();
		for (auto &each : layer.quad) each = QuadView{{identityOrientation, {x, 0, -1}}, {0.3f, 0.3f}, {viewsKey, 0, part}};
		return layer;
	}
	void addCurved(Surface surface)
	{
		for (auto &each : add().curved)
			each = CurvedView{.surface = surface,
							  .centreInFrame = identityPose,
							  .radius = 1,
							  .uvAhead = {0.5f, 0.5f},
							  .uvPerUnit = {1, -1.5f},
							  .texture = {viewsKey, 0, part}};
	}
	void addCube()
	{
		for (auto &each : add().cube) each = CubeView{identityOrientation, {cubesKey, 0, part}};
	}
	/// Of 30 frames of these layers, when the first ones have found out how much is wanted.
	void countAllocations(const char *of, XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);

	std::vector<PanelLayer> layers;
};

void Frames::countAllocations(const char *of, XrEnvironmentBlendMode mode)
{
	const LayerImage views(
		device, 300, 300, [](auto x, auto y, auto) { return texel(x, y); }, VK_FORMAT_R8G8B8A8_SRGB);
	const LayerImage cubes(
		device, 64, 64, [](auto x, auto y, auto) { return texel(x, y); }, VK_FORMAT_R8G8B8A8_SRGB, 6, VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT);
	const auto clock = makeRealClock(); // a stepped one keeps a list of those who sleep
	const ipc::SharedPage<ipc::SystemPage> page{"test"};
	const ipc::SharedPage<PoseRing> poses{"test"};
	PoseWriter(*poses).push({.time = clock->now() - 5 * millisecond});
	std::array<CameraFeed, 2> feeds;
	for (size_t eye = 0; eye < 2; ++eye) feeds[eye].put({.frame = inputs.cameras[eye]->frame}, clock->now());
	constexpr XrDuration period = 16'691'704;
	const Surroundings surroundings{
		.clock = *clock, .rig = rig, .poses = PoseHistory(*poses), .page = *page, .cameras = {&feeds[0], &feeds[1]}, .threadBegins = [] {
			isCounted = true;
		}};
	Compositor compositor(surroundings, Pacer({.period = period}, clock->now()),
						  makePanel(renderer, makeOffscreenTarget(*clock, period), makeOffscreenTarget(*clock, period)));
	compositor.addImage(viewsKey, views.image(), views.spec(), nullptr, views.rows());
	compositor.addImage(cubesKey, cubes.image(), cubes.spec(), nullptr, cubes.rows());
	compositor.addSource(std::make_shared<Source>(layers, mode));
	const auto areShown = [&](uint64_t frames) {
		const XrTime limit = realTime() + 60 * second;
		while (compositor.figures(false).shown < frames && realTime() < limit) std::this_thread::sleep_for(std::chrono::milliseconds(2));
		return compositor.figures(false).shown >= frames;
	};
	ASSERT_TRUE(areShown(30));
	const int before = allocations;
	ASSERT_TRUE(areShown(60));
	const int made = allocations - before;
	std::fprintf(stderr, "[ FIGURE   ] allocations in 30 frames of %s: %d\n", of, made);
	EXPECT_EQ(made, 0);
}

TEST_F(Frames, OfViewsAndQuadsAllocateNothing)
{
	addViews();
	for (int i = 0; i < 4; ++i) addQuadAt(0.2f * float(i));
	countAllocations("views and quads");
}

TEST_F(Frames, OfCurvedLayersAndCubesAllocateNothing)
{
	addViews().colorScale.a = 0.5f;
	addCurved(Surface::cylinder);
	addCurved(Surface::sphere);
	addCube();
	countAllocations("cylinders, spheres and cubes");
}

TEST_F(Frames, WithBlendFactorsAllocateNothing)
{
	addViews();
	addCube();
	addQuadAt(0).factors = {XR_BLEND_FACTOR_ZERO_FB, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB, XR_BLEND_FACTOR_ZERO_FB,
							XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB};
	countAllocations("layers with blend factors");
}

TEST_F(Frames, OfLayersThatAreAddedToTheWorldAllocateNothing)
{
	addViews();
	addQuadAt(0);
	countAllocations("layers that are added to the world", XR_ENVIRONMENT_BLEND_MODE_ADDITIVE);
}

TEST_F(Frames, WithDepthTestsAllocateNothing)
{
	addViews();
	addQuadAt(0).depthTest = DepthTest{VK_COMPARE_OP_LESS, true};
	addCurved(Surface::sphere);
	layers.back().depthTest = DepthTest{VK_COMPARE_OP_LESS_OR_EQUAL, true};
	addQuadAt(0.3f).factors = {XR_BLEND_FACTOR_DST_ALPHA_FB, XR_BLEND_FACTOR_ZERO_FB, XR_BLEND_FACTOR_ZERO_FB,
							   XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB};
	countAllocations("layers that are tested for their depth");
}

TEST_F(Frames, OfKeyedLayersAllocateNothing)
{
	addViews().key = KeyedOut{};
	addQuadAt(0).key = KeyedOut{.key = {}, .opacity = 0.5f};
	addCurved(Surface::cylinder);
	layers.back().key = KeyedOut{};
	countAllocations("keyed layers");
}

TEST_F(Frames, WithPassthroughLayersAllocateNothing)
{
	addViews();
	layers.push_back({.passthrough = PassthroughStyle{.opacity = 0.5f}});
	addQuadAt(0);
	layers.push_back({.passthrough = PassthroughStyle{.opacity = 0.5f, .edge = {1, 0, 0, 1}, .brightness = 10}});
	layers.push_back({.passthrough = PassthroughStyle{.opacity = 0.5f, .map = LayerTexture{.image = viewsKey, .rect = part}}});
	addQuadAt(0.3f);
	countAllocations("layers below and above passthrough layers");
}

} // namespace
} // namespace arift
