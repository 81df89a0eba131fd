// XR_EXT_dpad_binding: where a pad is pressed.
#include "runtime/openxr/ext/ext_dpad_binding.h"
#include <gtest/gtest.h>

namespace arift::openxr
{
namespace
{

const DpadSettings usual{};
constexpr DpadPress leaning{};

DpadPress pressed(float force) { return {true, force}; }

TEST(Dpad, AThumbstickNeedsNoPressing)
{
	Dpad pad;
	EXPECT_EQ(pad.update(usual, {0, 0.9f}, leaning), dpadUp);
	EXPECT_EQ(pad.update(usual, {0.1f, -0.9f}, leaning), dpadDown);
	EXPECT_EQ(pad.update(usual, {-0.6f, 0}, leaning), dpadLeft);
	EXPECT_EQ(pad.update(usual, {0.6f, 0.1f}, leaning), dpadRight);
	EXPECT_EQ(pad.update(usual, {0.3f, 0.3f}, leaning), 0u) << "within the centre";
}

TEST(Dpad, WedgesMayOverlapOrLeaveGaps)
{
	Dpad pad;
	DpadSettings settings;
	settings.wedgeAngle = 2;
	EXPECT_EQ(pad.update(settings, {0.7f, 0.7f}, leaning), dpadUp | dpadRight);
	settings.wedgeAngle = 1;
	EXPECT_EQ(pad.update(settings, {0.7f, 0.7f}, leaning), 0u);
}

TEST(Dpad, ATrackpadIsPressedAndReleasedAtItsThresholds)
{
	Dpad pad;
	DpadSettings settings;
	settings.forceThreshold = 0.8f;
	settings.forceThresholdReleased = 0.2f;
	EXPECT_EQ(pad.update(settings, {0, 0.9f}, pressed(0.7f)), 0u);
	EXPECT_EQ(pad.update(settings, {0, 0.9f}, pressed(0.8f)), dpadUp);
	EXPECT_EQ(pad.update(settings, {0, 0}, pressed(0.3f)), dpadCenter);
	EXPECT_EQ(pad.update(settings, {0, 0.9f}, pressed(0.1f)), 0u);
	EXPECT_EQ(pad.update(settings, {0, 0.9f}, pressed(0.3f)), 0u) << "released";
}

TEST(Dpad, ASticksDirectionStandsUntilItIsReleased)
{
	Dpad pad;
	DpadSettings settings;
	settings.isSticky = true;
	EXPECT_EQ(pad.update(settings, {0, 0.9f}, leaning), dpadUp);
	EXPECT_EQ(pad.update(settings, {0.9f, 0}, leaning), dpadUp);
	EXPECT_EQ(pad.update(settings, {0, 0}, leaning), 0u);
	EXPECT_EQ(pad.update(settings, {0.9f, 0}, leaning), dpadRight);
}

TEST(Dpad, SettingsAreChecked)
{
	const auto result = [](auto change) {
		XrInteractionProfileDpadBindingEXT wanted{XR_TYPE_INTERACTION_PROFILE_DPAD_BINDING_EXT};
		wanted.forceThreshold = 0.5f;
		wanted.forceThresholdReleased = 0.5f;
		wanted.centerRegion = 0.25f;
		wanted.wedgeAngle = 0;
		change(wanted);
		try {
			settingsOf(wanted);
			return XR_SUCCESS;
		} catch (const Error &error) {
			return error.result;
		}
	};
	using Wanted = XrInteractionProfileDpadBindingEXT;
	EXPECT_EQ(result([](Wanted &) {}), XR_SUCCESS);
	EXPECT_EQ(result([](Wanted &w) { w.forceThreshold = 0.4f; }), XR_ERROR_VALIDATION_FAILURE) << "below that of release";
	EXPECT_EQ(result([](Wanted &w) { w.forceThresholdReleased = 0; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(result([](Wanted &w) { w.forceThreshold = 1.01f; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(result([](Wanted &w) { w.centerRegion = 1; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(result([](Wanted &w) { w.wedgeAngle = 3.1416f; }), XR_ERROR_VALIDATION_FAILURE);
}

} // namespace
} // namespace arift::openxr
