// A camera that gives no more images: what is shown of the past says so after a quarter of a second, and is gone after a whole one.
#include "tests/e2e/common/private_service.h"
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{
namespace
{

enum class World {
	live,
	stale, ///< the image is there yet, framed in amber
	calm   ///< no image: a pattern
};

/// How the left eye's world looks: by the colour above what the camera sees, and by whether there is an image. The other camera's images
/// are not as old.
World worldOf(const PanelPicture &picture)
{
	size_t amber = 0, all = 0;
	for (size_t y = picture.height / 10; y < picture.height / 5; ++y)
		for (size_t x = 0; x < picture.width / 2; ++x) {
			const uint8_t *p = &picture.rgba[4 * (y * picture.width + x)];
			if (p[0] < 20) continue; // beside the lens
			++all;
			amber += p[0] * 4 > p[1] * 5 && p[1] > 2 * p[2];
		}
	if (all > 0 && amber > all / 2) return World::stale;
	return statisticsOfEyes(picture)[0].deviation > 12 ? World::live : World::calm;
}

TEST(StaleImages, CarryASignAndThenGo)
{
	// An image every 1.25 s: each grows old before the next one comes. The clock leaves time to look.
	PrivateService service(
		"[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"scaled\"\nrate = 0.2\n[compositor]\ntarget = \"offscreen\"\n"
		"[synthetic]\nmotion = \"rest\"\ncamera_rate = 0.8\n");
	XrTime firstStale = 0, lastStale = 0, lastLive = 0, firstCalm = 0;
	for (const XrTime end = realTime() + 75 * second; firstCalm == 0 && realTime() < end;) {
		const PanelPicture picture = service.screenshot();
		switch (worldOf(picture)) {
		case World::live: // another image has come: the look begins anew
			lastLive = picture.displayTime;
			firstStale = lastStale = 0;
			break;
		case World::stale:
			if (lastLive != 0 && firstStale == 0) firstStale = picture.displayTime;
			lastStale = picture.displayTime;
			break;
		case World::calm:
			if (firstStale != 0) firstCalm = picture.displayTime;
			break;
		}
	}
	ASSERT_GT(lastLive, 0) << service.process().output();
	ASSERT_GT(firstStale, lastLive);
	ASSERT_GT(firstCalm, lastStale);
	fmt::print(stderr, "[ FIGURE   ] the sign is there for {:.0f} to {:.0f} ms\n", inSeconds(lastStale - firstStale) * 1e3,
			   inSeconds(firstCalm - lastLive) * 1e3);
	// From 250 ms to 1 s after the image: 750 ms lie between what was seen of it and what may have been.
	EXPECT_LE(lastStale - firstStale, 751 * millisecond);
	EXPECT_GE(firstCalm - lastLive, 749 * millisecond);
	EXPECT_GE(lastStale - firstStale, 350 * millisecond) << "looked at often enough";
	EXPECT_LE(firstCalm - lastLive, 1250 * millisecond);
}

} // namespace
} // namespace arift::e2e
