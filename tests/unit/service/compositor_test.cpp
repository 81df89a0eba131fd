// The compositor's thread in simulated time, with a panel that draws nothing and a tracker and camera that this test plays.
#include "runtime/compositor/compositor.h"
#include "runtime/ipc/shared_memory.h"
#include "runtime/service/headset.h"
#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace arift;

namespace
{

constexpr XrDuration period = 16'691'704;
constexpr Pacer::Settings pacing{.period = period};

/// What a compositor under test has drawn.
struct Drawn {
	PanelInputs inputs;
	XrTime latched = 0;
};

class FakePanel final : public Panel
{
public:
	FakePanel(Clock &clock, Guarded<std::vector<Drawn>> &drawn) : clock_(clock), drawn_(drawn), target_(makeOffscreenTarget(clock, period))
	{
	}
	void addImage(uint64_t key, VkImage, const gpu::ImageSpec &, const gpu::ImageRows &) override
	{
		EXPECT_TRUE(images_.insert(key).second);
	}
	void removeImage(uint64_t key) override { EXPECT_EQ(images_.erase(key), 1u); }
	void render(const PanelInputs &inputs) override
	{
		drawn_.update([&](auto &all) { all.push_back({inputs, clock_.now()}); });
	}
	Target::Result present(const Pacer::Refresh &refresh) override
	{
		Target::Result result = target_->present(VK_NULL_HANDLE, {}, refresh);
		if (everyOtherIsLate && presented_++ % 2 == 0) result.display += period;
		return result;
	}
	ReadbackImage readPanel() override
	{
		reads++;
		return {.width = 1, .height = 1, .pixels = std::vector<std::byte>(4)};
	}
	ReadbackImage renderEyes(const PanelInputs &) override { return {.width = 2, .height = 1, .pixels = std::vector<std::byte>(8)}; }

	static inline std::atomic<size_t> reads = 0;
	/// Every other image is seen a refresh later than planned.
	static inline std::atomic<bool> everyOtherIsLate = false;

private:
	Clock &clock_;
	Guarded<std::vector<Drawn>> &drawn_;
	std::unique_ptr<Target> target_;
	std::set<uint64_t> images_;
	size_t presented_ = 0;
};

/// Shows one quad of one image, and notes what it is told.
class FakeSource final : public FrameSource
{
public:
	explicit FakeSource(uint64_t image, uint64_t order = 0, bool hidesOthers = false, float ahead = 0) : order_(order)
	{
		auto made = std::make_shared<FrameContent>();
		made->frame = 1;
		made->blendMode = hidesOthers ? XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND : XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
		made->hidesOthers = hidesOthers;
		made->layers.resize(1);
		made->layers[0].quad[0] = QuadView{{identityPose.orientation, {0, 0, -ahead}}, {1, 1}, {.image = image}};
		content_ = std::move(made);
	}
	void wake(const Opportunity &opportunity) override
	{
		wakes.update([&](auto &all) { all.push_back(opportunity); });
	}
	uint64_t order() const override { return order_; }
	std::shared_ptr<const FrameContent> content() override { return content_; }
	void shown(const std::shared_ptr<const FrameContent> &content) override { EXPECT_EQ(content, content_); }
	void displayed(const FrameContent &, XrTime display) override
	{
		displays.update([&](auto &all) { all.push_back(display); });
	}
	Guarded<std::vector<Opportunity>> wakes{};
	Guarded<std::vector<XrTime>> displays{};

private:
	const uint64_t order_;
	std::shared_ptr<const FrameContent> content_;
};

class CompositorTest : public testing::Test
{
protected:
	CompositorTest() : clock_(makeSteppedClock(second)), start_(*clock_)
	{
		PoseWriter writer(*poses_);
		writer.push({.time = clock_->now() - 5 * millisecond}); // at rest
		begin();
	}

	void begin(bool nearerOver = true)
	{
		compositor_.reset();
		compositor_ = std::make_unique<Compositor>(
			Surroundings{*clock_, rig_, PoseHistory(*poses_), *page_, {&feeds_[0], nullptr}, nullptr, {}, nearerOver},
			Pacer(pacing, clock_->now()), std::make_unique<FakePanel>(*clock_, drawn_));
	}

	/// Lets simulated time go on by so many refreshes, while this thread sleeps on the clock.
	void run(int refreshes) { clock_->sleepUntil(clock_->now() + refreshes * period, {}); }
	std::vector<Drawn> drawn() { return *drawn_.lock(); }
	/// Of the layers drawn last, bottom first.
	std::vector<uint64_t> imagesShown()
	{
		std::vector<uint64_t> images;
		const auto drawnLast = drawn().back();
		for (const PanelLayer &layer : drawnLast.inputs.layers) images.push_back(layer.quad[0]->texture.image);
		return images;
	}

	const Rig rig_{.eyeInHead = {identityPose, identityPose}, .cameras = {}};
	std::unique_ptr<Clock> clock_;
	Clock::Hold start_;
	ipc::SharedPage<ipc::SystemPage> page_{"test"};
	ipc::SharedPage<PoseRing> poses_{"test"};
	std::array<CameraFeed, 2> feeds_;
	Guarded<std::vector<Drawn>> drawn_{};
	std::unique_ptr<Compositor> compositor_;
};

} // namespace

TEST_F(CompositorTest, MakesOneImagePerRefreshAndMissesNone)
{
	run(100);
	const FrameFigures figures = compositor_->figures(false);
	EXPECT_NEAR(double(figures.shown), 99, 2);
	EXPECT_EQ(figures.missed, 0u);
	EXPECT_NEAR(figures.perSecond, 1 / inSeconds(period), 0.01);
	const auto images = drawn();
	for (size_t i = 1; i < images.size(); ++i)
		EXPECT_NEAR(double(images[i].inputs.displayTime - images[i - 1].inputs.displayTime), double(period), 100);
	// Composing takes no simulated time: once that is known, the latch lies margin and scan-out before the display.
	EXPECT_NEAR(double(images.back().inputs.displayTime - images.back().latched), double(pacing.vblankToDisplay + pacing.margin), 100);
	const auto timing = page_->timing.read();
	ASSERT_TRUE(timing);
	EXPECT_NEAR(double(timing->latchBeforeDisplay), double(pacing.vblankToDisplay + pacing.margin), 100);
}

TEST_F(CompositorTest, NoTwoImagesAreForOneRefresh)
{
	const auto source = std::make_shared<FakeSource>(7);
	compositor_->addImage(7, VkImage(1), {}, nullptr);
	compositor_->addSource(source);
	FakePanel::everyOtherIsLate = true;
	run(40);
	FakePanel::everyOtherIsLate = false;
	const std::vector<XrTime> displays = *source->displays.lock();
	ASSERT_GT(displays.size(), 10u);
	for (size_t i = 1; i < displays.size(); ++i)
		EXPECT_GT(displays[i], displays[i - 1] + period / 2) << "image " << i << " takes the place of one that is late";
}

TEST_F(CompositorTest, LinesAreSeenOneAfterTheOther)
{
	PoseWriter writer(*poses_);
	writer.push({.time = clock_->now(), .angularVelocity = {0, 1, 0}}); // one radian a second to the left
	run(2);
	const PanelInputs inputs = drawn().front().inputs;
	const double turned = angleBetween(inputs.top[0].headInOrigin.orientation, inputs.bottom[0].headInOrigin.orientation);
	EXPECT_NEAR(turned, inSeconds(rig_.timing.lineTime) * 799, 2e-5);
}

TEST_F(CompositorTest, ApplicationsAreWokenForTheImageAfter)
{
	compositor_->addImage(5, VkImage(1), {}, nullptr);
	auto source = std::make_shared<FakeSource>(5);
	compositor_->addSource(source);
	run(20);
	const auto wakes = *source->wakes.lock();
	const auto images = drawn();
	ASSERT_GE(wakes.size(), 18u);
	for (size_t i = 1; i + 1 < images.size(); ++i) { // the first was planned before the cost of composing was known
		EXPECT_EQ(wakes[i].displayTime, images[i + 1].inputs.displayTime);
		EXPECT_EQ(wakes[i].latch, images[i + 1].latched) << "what is there by then is shown then";
	}
	EXPECT_EQ(images.back().inputs.blendMode, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE);
	compositor_->removeSource(*source);
	run(2);
	EXPECT_TRUE(drawn().back().inputs.layers.empty());
	EXPECT_EQ(drawn().back().inputs.blendMode, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
}

TEST_F(CompositorTest, SourcesAreDrawnInTheirOrderWheneverTheyCame)
{
	std::vector<std::shared_ptr<FakeSource>> sources;
	const auto add = [&](uint64_t image, uint64_t order, bool hidesOthers = false) {
		compositor_->addImage(image, VkImage(1), {}, nullptr);
		compositor_->addSource(sources.emplace_back(std::make_shared<FakeSource>(image, order, hidesOthers)));
	};
	add(1, 9);
	run(2);
	EXPECT_EQ(drawn().back().inputs.blendMode, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND) << "an overlay alone leaves the world as it is";
	add(2, 0);
	add(3, 4);
	add(4, 0);
	add(5, 9);
	run(2);
	EXPECT_EQ(imagesShown(), (std::vector<uint64_t>{2, 4, 3, 1, 5}));
	EXPECT_EQ(drawn().back().inputs.blendMode, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE);
	add(6, 7, true);
	run(2);
	EXPECT_EQ(imagesShown(), (std::vector<uint64_t>{6, 1, 5})) << "an overlay with the world behind it hides what is below";
	EXPECT_EQ(drawn().back().inputs.blendMode, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
}

TEST_F(CompositorTest, NearerApplicationsAreOverFartherOnesUnlessTheyAreToStayInTheirOrder)
{
	for (const bool nearerOver : {true, false}) {
		begin(nearerOver);
		const auto near = std::make_shared<FakeSource>(1, 0, true, 1.0f), far = std::make_shared<FakeSource>(2, 0, true, 3.0f);
		const auto overlay = std::make_shared<FakeSource>(3, 1, false, 9.0f);
		for (const auto &source : {overlay, near, far}) compositor_->addSource(source);
		run(2);
		EXPECT_EQ(imagesShown(), nearerOver ? (std::vector<uint64_t>{2, 1, 3}) : (std::vector<uint64_t>{1, 2, 3}))
			<< "main applications share the world; an overlay is over them";
	}
}

TEST_F(CompositorTest, RawPassthroughShowsNoLayerAndApplicationsGoOn)
{
	compositor_->addImage(5, VkImage(1), {}, nullptr);
	auto source = std::make_shared<FakeSource>(5);
	compositor_->addSource(source);
	run(3);
	ASSERT_FALSE(drawn().back().inputs.layers.empty());
	compositor_->setRawPassthrough(true);
	run(2);
	EXPECT_TRUE(compositor_->rawPassthrough());
	EXPECT_TRUE(drawn().back().inputs.layers.empty());
	EXPECT_EQ(drawn().back().inputs.blendMode, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND) << "nothing hides the world";
	const size_t wakes = source->wakes.lock()->size();
	run(3);
	EXPECT_GE(source->wakes.lock()->size(), wakes + 2);
	compositor_->setRawPassthrough(false);
	run(2);
	EXPECT_FALSE(drawn().back().inputs.layers.empty());
}

TEST_F(CompositorTest, AnImageThatIsRemovedIsLetGoOfThoughALayerNamesItYet)
{
	auto owner = std::make_shared<int>(1);
	compositor_->addImage(5, VkImage(1), {}, owner);
	compositor_->addSource(std::make_shared<FakeSource>(5));
	run(3);
	EXPECT_GT(owner.use_count(), 1);
	compositor_->removeImage(5);
	run(2);
	EXPECT_EQ(owner.use_count(), 1) << "the compositor has let go of it";
}

TEST_F(CompositorTest, PicturesAreHandedOut)
{
	std::jthread world([&, hold = Clock::Hold(*clock_)](const std::stop_token &stop) {
		while (!stop.stop_requested()) clock_->sleepUntil(clock_->now() + period, stop);
	});
	std::optional<Picture> panel, eyes;
	std::atomic<bool> done = false;
	std::thread monitor([&] { // holds no clock, as in the service
		panel = compositor_->picture(ipc::PictureKind::panel, 10 * second);
		eyes = compositor_->picture(ipc::PictureKind::eyes, 10 * second);
		done = true;
	});
	while (!done && clock_->now() < 1000 * second) run(1);
	monitor.join();
	ASSERT_TRUE(panel && eyes);
	EXPECT_EQ(panel->image.width, 1u);
	EXPECT_EQ(eyes->image.width, 2u);
	EXPECT_GT(eyes->displayTime, panel->displayTime);
}

TEST_F(CompositorTest, ManyMonitorsTogetherCostAFrameOnePicture)
{
	FakePanel::reads = 0;
	std::atomic<int> answered = 0;
	std::vector<std::jthread> monitors;
	for (int i = 0; i < 8; ++i)
		monitors.emplace_back([&] { answered += compositor_->picture(ipc::PictureKind::panel, 10 * second).has_value(); });
	std::this_thread::sleep_for(std::chrono::milliseconds(100)); // time stands still: all of them want the next image
	while (answered < 8 && clock_->now() < 1000 * second) run(1);
	monitors.clear();
	EXPECT_EQ(answered, 8);
	EXPECT_LE(FakePanel::reads, 2u);
}

TEST_F(CompositorTest, FiguresBeginAnewAfterAReset)
{
	run(10);
	EXPECT_GE(compositor_->figures(true).shown, 8u);
	EXPECT_EQ(compositor_->figures(false).shown, 0u);
}

// ---- what is too old

TEST(Assemble, AnImageOlderThanASecondIsNone)
{
	const Rig rig = rigFor({});
	const ipc::SharedPage<PoseRing> poses{"test"};
	Latched latched;
	latched.cameras[0] = {{.frame = {.midExposure = 10 * second}}};
	latched.cameras[1] = {{.frame = {.midExposure = 10 * second + 500 * millisecond}}};
	const auto lensOf = [&](XrTime display, size_t eye) -> std::optional<uint32_t> {
		const PanelInputs inputs = assemble(rig, {}, PoseHistory(*poses).now(), display, latched);
		return inputs.cameras[eye] ? std::optional(inputs.cameras[eye]->lens) : std::nullopt;
	};
	EXPECT_EQ(lensOf(11 * second, 0), 0u) << "old, and shown with a sign";
	EXPECT_EQ(lensOf(11 * second + millisecond, 0), 1u) << "the other eye's is better than one that is too old";
	EXPECT_EQ(lensOf(11 * second + 501 * millisecond, 0), std::nullopt) << "a frozen world must not look alive";
	EXPECT_EQ(lensOf(11 * second + 501 * millisecond, 1), std::nullopt);
}
