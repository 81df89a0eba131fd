// Raw passthrough: whatever an application shows, a command shows the cameras alone, in every pixel, and holograms again.
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/marked_world.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{
namespace
{

/// Share of a picture's values that are another picture's, as nearly as a head at rest is still.
double shareAlike(const PanelPicture &a, const PanelPicture &b)
{
	size_t alike = 0;
	for (size_t i = 0; i < a.rgba.size(); ++i) alike += std::abs(a.rgba[i] - b.rgba[i]) <= 12;
	return double(alike) / double(a.rgba.size());
}

/// Waits for further images, so that a picture shows what was asked for.
void awaitFrames(PrivateService &service)
{
	service.status(true);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"] > 3; }));
}

TEST(RawPassthrough, ShowsTheCamerasAloneWhateverIsSubmitted)
{
	PrivateService service(markedWorld(0.3));
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"] > 40; })); // the images have faded in
	const PanelPicture world = service.screenshot();
	const std::array<int, 2> red = redIn(world);
	ASSERT_GT(red[0], 300);
	ASSERT_GT(red[1], 300);

	const ChildProcess application = service.start("clearing_application", {"opaque", "0"});
	const auto isShown = [](const auto &status) { return !status["clients"].empty() && status["clients"][0]["shown"] > 3; };
	ASSERT_TRUE(eventually(service, isShown)) << application.output();
	const auto isHidden = [&] {
		const std::array<int, 2> left = redIn(service.screenshot()); // colours fringe the application's own white
		return left[0] < 100 && left[1] < 100;
	};
	EXPECT_TRUE(isHidden()) << "by the application";
	EXPECT_LT(shareAlike(service.screenshot(), world), 0.8);

	ASSERT_EQ(runArift(service.tree(), {"passthrough", "raw"}).status, 0);
	awaitFrames(service);
	const PanelPicture raw = service.screenshot();
	EXPECT_GT(shareAlike(raw, world), 0.995);
	EXPECT_EQ(service.status()["passthrough"]["raw"], true);
	EXPECT_EQ(service.status()["clients"].at(0)["state"], "running") << "the application goes on unseen";

	ASSERT_EQ(runArift(service.tree(), {"passthrough", "holograms"}).status, 0);
	awaitFrames(service);
	EXPECT_TRUE(isHidden()) << "again";
}

} // namespace
} // namespace arift::e2e
