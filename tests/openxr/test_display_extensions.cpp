// XR_FB_display_refresh_rate, XR_FB_color_space, XR_EXT_performance_settings, XR_EXT_hand_tracking, XR_MSFT_controller_model
// and XR_META_performance_metrics.
#include "tests/openxr/headless_session.h"

namespace arift
{
namespace
{

TEST(xrRequestDisplayRefreshRateFB, ThePanelHasOneRate)
{
	const HeadlessApplication app({"XR_FB_display_refresh_rate"});
	uint32_t count = 0;
	float rates[2]{}, rate = 0;
	const auto enumerate = app.get<PFN_xrEnumerateDisplayRefreshRatesFB>("xrEnumerateDisplayRefreshRatesFB");
	ASSERT_EQ(enumerate(app.session, 2, &count, rates), XR_SUCCESS);
	ASSERT_EQ(count, 1u);
	EXPECT_FLOAT_EQ(rates[0], 59.9f);
	ASSERT_EQ(app.get<PFN_xrGetDisplayRefreshRateFB>("xrGetDisplayRefreshRateFB")(app.session, &rate), XR_SUCCESS);
	EXPECT_EQ(rate, rates[0]);
	const auto request = app.get<PFN_xrRequestDisplayRefreshRateFB>("xrRequestDisplayRefreshRateFB");
	EXPECT_EQ(request(app.session, 0), XR_SUCCESS);
	EXPECT_EQ(request(app.session, rate), XR_SUCCESS);
	EXPECT_EQ(request(app.session, 90), XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB);
}

TEST(xrSetColorSpaceFB, TakesWhatIsEnumerated)
{
	const HeadlessApplication app({"XR_FB_color_space"});
	uint32_t count = 0;
	XrColorSpaceFB spaces[8]{};
	ASSERT_EQ(app.get<PFN_xrEnumerateColorSpacesFB>("xrEnumerateColorSpacesFB")(app.session, 8, &count, spaces), XR_SUCCESS);
	ASSERT_EQ(count, 2u);
	const auto set = app.get<PFN_xrSetColorSpaceFB>("xrSetColorSpaceFB");
	for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(set(app.session, spaces[i]), XR_SUCCESS);
	EXPECT_EQ(set(app.session, XR_COLOR_SPACE_P3_FB), XR_ERROR_COLOR_SPACE_UNSUPPORTED_FB);
}

TEST(xrPerfSettingsSetPerformanceLevelEXT, ChecksItsHints)
{
	const HeadlessApplication app({"XR_EXT_performance_settings"});
	const auto set = app.get<PFN_xrPerfSettingsSetPerformanceLevelEXT>("xrPerfSettingsSetPerformanceLevelEXT");
	EXPECT_EQ(set(app.session, XR_PERF_SETTINGS_DOMAIN_GPU_EXT, XR_PERF_SETTINGS_LEVEL_BOOST_EXT), XR_SUCCESS);
	EXPECT_EQ(set(app.session, XrPerfSettingsDomainEXT(3), XR_PERF_SETTINGS_LEVEL_BOOST_EXT), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(set(app.session, XR_PERF_SETTINGS_DOMAIN_CPU_EXT, XrPerfSettingsLevelEXT(24)), XR_ERROR_VALIDATION_FAILURE);
}

TEST(xrCreateHandTrackerEXT, IsUnsupported)
{
	const HeadlessApplication app({"XR_EXT_hand_tracking"});
	XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr, XR_HAND_LEFT_EXT, XR_HAND_JOINT_SET_DEFAULT_EXT};
	XrHandTrackerEXT tracker = XR_NULL_HANDLE;
	const auto create = app.get<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT");
	EXPECT_EQ(create(app.session, &info, &tracker), XR_ERROR_FEATURE_UNSUPPORTED);
	info.hand = XrHandEXT(3);
	EXPECT_EQ(create(app.session, &info, &tracker), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(app.get<PFN_xrDestroyHandTrackerEXT>("xrDestroyHandTrackerEXT")(tracker), XR_ERROR_HANDLE_INVALID);
}

TEST(xrGetControllerModelKeyMSFT, NothingHasAModel)
{
	const HeadlessApplication app({"XR_MSFT_controller_model"});
	const auto get = app.get<PFN_xrGetControllerModelKeyMSFT>("xrGetControllerModelKeyMSFT");
	const auto pathOf = [&](const char *text) {
		XrPath path = XR_NULL_PATH;
		EXPECT_EQ(app.get<PFN_xrStringToPath>("xrStringToPath")(app.application.instance, text, &path), XR_SUCCESS);
		return path;
	};
	XrControllerModelKeyStateMSFT state{XR_TYPE_CONTROLLER_MODEL_KEY_STATE_MSFT, nullptr, 5};
	ASSERT_EQ(get(app.session, pathOf("/user/hand/left"), &state), XR_SUCCESS);
	EXPECT_EQ(state.modelKey, XrControllerModelKeyMSFT(XR_NULL_CONTROLLER_MODEL_KEY_MSFT));
	EXPECT_EQ(get(app.session, pathOf("/user/foot/left"), &state), XR_ERROR_PATH_UNSUPPORTED);
	EXPECT_EQ(get(app.session, XR_NULL_PATH, &state), XR_ERROR_PATH_INVALID);
	uint32_t size = 0;
	EXPECT_EQ(app.get<PFN_xrLoadControllerModelMSFT>("xrLoadControllerModelMSFT")(app.session, 5, 0, &size, nullptr),
			  XR_ERROR_CONTROLLER_MODEL_KEY_INVALID_MSFT);
	XrControllerModelPropertiesMSFT properties{XR_TYPE_CONTROLLER_MODEL_PROPERTIES_MSFT};
	EXPECT_EQ(app.get<PFN_xrGetControllerModelPropertiesMSFT>("xrGetControllerModelPropertiesMSFT")(app.session, 5, &properties),
			  XR_ERROR_CONTROLLER_MODEL_KEY_INVALID_MSFT);
	XrControllerModelStateMSFT nodes{XR_TYPE_CONTROLLER_MODEL_STATE_MSFT};
	EXPECT_EQ(app.get<PFN_xrGetControllerModelStateMSFT>("xrGetControllerModelStateMSFT")(app.session, 5, &nodes),
			  XR_ERROR_CONTROLLER_MODEL_KEY_INVALID_MSFT);
}

TEST(xrQueryPerformanceMetricsCounterMETA, MeasuresTheApplicationsFrame)
{
	const HeadlessApplication app({"XR_META_performance_metrics"});
	uint32_t count = 0;
	XrPath path = XR_NULL_PATH;
	const auto enumerate = app.get<PFN_xrEnumeratePerformanceMetricsCounterPathsMETA>("xrEnumeratePerformanceMetricsCounterPathsMETA");
	ASSERT_EQ(enumerate(app.application.instance, 1, &count, &path), XR_SUCCESS);
	XrPerformanceMetricsCounterMETA counter{XR_TYPE_PERFORMANCE_METRICS_COUNTER_META};
	const auto query = app.get<PFN_xrQueryPerformanceMetricsCounterMETA>("xrQueryPerformanceMetricsCounterMETA");
	EXPECT_EQ(query(app.session, path, &counter), XR_ERROR_VALIDATION_FAILURE) << "off";
	XrPerformanceMetricsStateMETA state{XR_TYPE_PERFORMANCE_METRICS_STATE_META, nullptr, XR_TRUE};
	ASSERT_EQ(app.get<PFN_xrSetPerformanceMetricsStateMETA>("xrSetPerformanceMetricsStateMETA")(app.session, &state), XR_SUCCESS);
	state.enabled = XR_FALSE;
	ASSERT_EQ(app.get<PFN_xrGetPerformanceMetricsStateMETA>("xrGetPerformanceMetricsStateMETA")(app.session, &state), XR_SUCCESS);
	EXPECT_EQ(state.enabled, XrBool32(XR_TRUE));
	ASSERT_EQ(query(app.session, path, &counter), XR_SUCCESS);
	EXPECT_EQ(counter.counterFlags, 0u) << "nothing was measured yet";

	ASSERT_EQ(app.application.begin(app.session), XR_SUCCESS);
	XrFrameState frame;
	ASSERT_EQ(app.application.wait(app.session, frame), XR_SUCCESS);
	const XrTime waited = realTime();
	ASSERT_EQ(app.application.beginFrame(app.session), XR_SUCCESS);
	while (realTime() < waited + 3 * millisecond) {}
	ASSERT_EQ(app.application.endFrame(app.session, frame.predictedDisplayTime), XR_SUCCESS);
	const double longest = inSeconds(realTime() - waited) * 1000 + 1;
	ASSERT_EQ(query(app.session, path, &counter), XR_SUCCESS);
	EXPECT_EQ(counter.counterUnit, XR_PERFORMANCE_METRICS_COUNTER_UNIT_MILLISECONDS_META);
	EXPECT_TRUE(counter.counterFlags & XR_PERFORMANCE_METRICS_COUNTER_FLOAT_VALUE_VALID_BIT_META);
	EXPECT_GE(counter.floatValue, 3);
	EXPECT_LT(counter.floatValue, longest);
	EXPECT_EQ(query(app.session, app.application.path("/perfmetrics_meta/none"), &counter), XR_ERROR_PATH_UNSUPPORTED);
}

} // namespace
} // namespace arift
