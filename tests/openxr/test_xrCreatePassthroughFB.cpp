// XR_FB_passthrough: the feature, its layers and their styles, and what the service is told of them.
#include "tests/openxr/headless_session.h"
#include <cmath>

namespace arift
{
namespace
{

constexpr XrPassthroughFlagsFB running = XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB;

struct PassthroughTest : testing::Test {
	HeadlessApplication app{{"XR_FB_passthrough"}};

	XrResult create(XrPassthroughFB &passthrough, XrPassthroughFlagsFB flags = 0) const
	{
		const XrPassthroughCreateInfoFB info{XR_TYPE_PASSTHROUGH_CREATE_INFO_FB, nullptr, flags};
		return app.get<PFN_xrCreatePassthroughFB>("xrCreatePassthroughFB")(app.session, &info, &passthrough);
	}
	XrResult createLayer(XrPassthroughFB passthrough, XrPassthroughLayerFB &layer, XrPassthroughFlagsFB flags = 0,
						 XrPassthroughLayerPurposeFB purpose = XR_PASSTHROUGH_LAYER_PURPOSE_RECONSTRUCTION_FB) const
	{
		const XrPassthroughLayerCreateInfoFB info{XR_TYPE_PASSTHROUGH_LAYER_CREATE_INFO_FB, nullptr, passthrough, flags, purpose};
		return app.get<PFN_xrCreatePassthroughLayerFB>("xrCreatePassthroughLayerFB")(app.session, &info, &layer);
	}
	XrResult start(XrPassthroughFB passthrough) const { return app.get<PFN_xrPassthroughStartFB>("xrPassthroughStartFB")(passthrough); }
	XrResult pause(XrPassthroughFB passthrough) const { return app.get<PFN_xrPassthroughPauseFB>("xrPassthroughPauseFB")(passthrough); }
	XrResult destroy(XrPassthroughFB passthrough) const
	{
		return app.get<PFN_xrDestroyPassthroughFB>("xrDestroyPassthroughFB")(passthrough);
	}
	XrResult pause(XrPassthroughLayerFB layer) const { return app.get<PFN_xrPassthroughLayerPauseFB>("xrPassthroughLayerPauseFB")(layer); }
	XrResult resume(XrPassthroughLayerFB layer) const
	{
		return app.get<PFN_xrPassthroughLayerResumeFB>("xrPassthroughLayerResumeFB")(layer);
	}
	XrResult destroy(XrPassthroughLayerFB layer) const
	{
		return app.get<PFN_xrDestroyPassthroughLayerFB>("xrDestroyPassthroughLayerFB")(layer);
	}
	XrResult style(XrPassthroughLayerFB layer, float opacity, XrColor4f edge = {}, const void *next = nullptr) const
	{
		const XrPassthroughStyleFB info{XR_TYPE_PASSTHROUGH_STYLE_FB, next, opacity, edge};
		return app.get<PFN_xrPassthroughLayerSetStyleFB>("xrPassthroughLayerSetStyleFB")(layer, &info);
	}
	/// What the service knows of a layer, or of the feature.
	bool isShown(uint32_t layer)
	{
		bool shown = false;
		for (const ipc::ShowPassthrough &message : app.service.record().passthroughShown)
			if (message.layer == layer) shown = message.shown != 0;
		return shown;
	}
	bool runs() { return isShown(ipc::everyPassthroughLayer); }
	ipc::StylePassthrough newestStyle() { return app.service.record().passthroughStyles.back(); }
};

TEST_F(PassthroughTest, StartsAndPausesAsOftenAsItIsAskedTo)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough), XR_SUCCESS);
	EXPECT_FALSE(runs());
	EXPECT_EQ(pause(passthrough), XR_SUCCESS) << "it is paused already";
	EXPECT_EQ(start(passthrough), XR_SUCCESS);
	EXPECT_TRUE(runs());
	EXPECT_EQ(start(passthrough), XR_SUCCESS) << "applications start what was running at creation";
	EXPECT_EQ(pause(passthrough), XR_SUCCESS);
	EXPECT_FALSE(runs());
	EXPECT_EQ(start(passthrough), XR_SUCCESS);
	EXPECT_EQ(destroy(passthrough), XR_SUCCESS);
	EXPECT_FALSE(runs());
	EXPECT_EQ(start(passthrough), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(pause(passthrough), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(destroy(passthrough), XR_ERROR_HANDLE_INVALID);
}

TEST_F(PassthroughTest, RunsAtCreationWhereThatIsAskedFor)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough, running), XR_SUCCESS);
	EXPECT_TRUE(runs());
	XrPassthroughLayerFB paused = XR_NULL_HANDLE, shown = XR_NULL_HANDLE;
	ASSERT_EQ(createLayer(passthrough, paused), XR_SUCCESS);
	ASSERT_EQ(createLayer(passthrough, shown, running), XR_SUCCESS);
	EXPECT_FALSE(isShown(0));
	EXPECT_TRUE(isShown(1));
	EXPECT_EQ(resume(paused), XR_SUCCESS);
	EXPECT_TRUE(isShown(0));
	EXPECT_EQ(pause(shown), XR_SUCCESS);
	EXPECT_FALSE(isShown(1));
}

TEST_F(PassthroughTest, ASessionHasOneFeatureAtATime)
{
	XrPassthroughFB first = XR_NULL_HANDLE, second = XR_NULL_HANDLE;
	ASSERT_EQ(create(first), XR_SUCCESS);
	EXPECT_EQ(create(second), XR_ERROR_FEATURE_ALREADY_CREATED_PASSTHROUGH_FB);
	ASSERT_EQ(destroy(first), XR_SUCCESS);
	EXPECT_EQ(create(second), XR_SUCCESS);
}

TEST_F(PassthroughTest, LayersOfADestroyedFeatureAreNeverShownAgain)
{
	XrPassthroughFB first = XR_NULL_HANDLE, second = XR_NULL_HANDLE;
	XrPassthroughLayerFB orphan = XR_NULL_HANDLE;
	ASSERT_EQ(create(first, running), XR_SUCCESS);
	ASSERT_EQ(createLayer(first, orphan, running), XR_SUCCESS);
	ASSERT_EQ(destroy(first), XR_SUCCESS);
	ASSERT_EQ(create(second, running), XR_SUCCESS);
	EXPECT_FALSE(isShown(0));
	EXPECT_EQ(resume(orphan), XR_ERROR_UNEXPECTED_STATE_PASSTHROUGH_FB);
	EXPECT_EQ(pause(orphan), XR_SUCCESS);
	EXPECT_EQ(style(orphan, 0.5f), XR_SUCCESS);
	EXPECT_EQ(destroy(orphan), XR_SUCCESS);
	EXPECT_EQ(pause(orphan), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resume(orphan), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(style(orphan, 1), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(destroy(orphan), XR_ERROR_HANDLE_INVALID);
}

TEST_F(PassthroughTest, CreationChecksItsRequest)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	EXPECT_EQ(create(passthrough, 4), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(create(passthrough, XR_PASSTHROUGH_LAYER_DEPTH_BIT_FB), XR_ERROR_FEATURE_UNSUPPORTED);
	EXPECT_EQ(app.get<PFN_xrCreatePassthroughFB>("xrCreatePassthroughFB")(app.session, nullptr, &passthrough), XR_ERROR_VALIDATION_FAILURE);
	ASSERT_EQ(create(passthrough), XR_SUCCESS) << "what failed has changed nothing";
	XrPassthroughLayerFB layer = XR_NULL_HANDLE;
	EXPECT_EQ(createLayer(XR_NULL_HANDLE, layer), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(createLayer(passthrough, layer, 0, XR_PASSTHROUGH_LAYER_PURPOSE_PROJECTED_FB), XR_ERROR_FEATURE_UNSUPPORTED);
	EXPECT_EQ(createLayer(passthrough, layer, 0, XrPassthroughLayerPurposeFB(7)), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(createLayer(passthrough, layer, 8), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_TRUE(app.service.record().passthroughStyles.empty()) << "the service was not asked";
}

TEST_F(PassthroughTest, LayersHaveLimitsAndPlacesAreUsedAgainWithoutTheirStyle)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough, running), XR_SUCCESS);
	std::array<XrPassthroughLayerFB, ipc::maxPassthroughLayers> layers{};
	for (XrPassthroughLayerFB &layer : layers) ASSERT_EQ(createLayer(passthrough, layer, running), XR_SUCCESS);
	XrPassthroughLayerFB further = XR_NULL_HANDLE;
	EXPECT_EQ(createLayer(passthrough, further), XR_ERROR_INSUFFICIENT_RESOURCES_PASSTHROUGH_FB);
	ASSERT_EQ(style(layers[5], 0.25f), XR_SUCCESS);
	EXPECT_EQ(newestStyle().layer, 5u);
	ASSERT_EQ(destroy(layers[5]), XR_SUCCESS);
	EXPECT_FALSE(isShown(5));
	ASSERT_EQ(createLayer(passthrough, further), XR_SUCCESS);
	EXPECT_EQ(newestStyle().layer, 5u);
	EXPECT_EQ(newestStyle().opacity, 1);
	EXPECT_FALSE(isShown(5)) << "created paused";
}

TEST_F(PassthroughTest, StylesReachTheService)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	XrPassthroughLayerFB layer = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough), XR_SUCCESS);
	ASSERT_EQ(createLayer(passthrough, layer), XR_SUCCESS);
	ASSERT_EQ(style(layer, 0.5f, {0.1f, 0.2f, 0.3f, 0.4f}), XR_SUCCESS);
	EXPECT_EQ(newestStyle().opacity, 0.5f);
	EXPECT_EQ(newestStyle().edge.b, 0.3f);
	EXPECT_EQ(newestStyle().edge.a, 0.4f);
	EXPECT_EQ(newestStyle().mapped, 0u);
	EXPECT_EQ(newestStyle().contrast, 1);

	const XrPassthroughBrightnessContrastSaturationFB adjustment{XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB, nullptr, -20, 1.5f,
																 0.25f};
	ASSERT_EQ(style(layer, 1, {}, &adjustment), XR_SUCCESS);
	EXPECT_EQ(newestStyle().brightness, -20);
	EXPECT_EQ(newestStyle().contrast, 1.5f);
	EXPECT_EQ(newestStyle().saturation, 0.25f);

	XrPassthroughColorMapMonoToRgbaFB colours{XR_TYPE_PASSTHROUGH_COLOR_MAP_MONO_TO_RGBA_FB, nullptr, {}};
	for (size_t i = 0; i < 256; ++i) colours.textureColorMap[i] = {0, 1, float(i) / 255, 0.5f};
	ASSERT_EQ(style(layer, 1, {}, &colours), XR_SUCCESS);
	EXPECT_EQ(newestStyle().mapped, 1u);
	EXPECT_EQ(newestStyle().map[255], (std::array<uint8_t, 4>{0, 255, 255, 128}));
	EXPECT_EQ(newestStyle().map[55][2], 128) << "linear 0.2157, sRGB encoded";

	XrPassthroughColorMapMonoToMonoFB greys{XR_TYPE_PASSTHROUGH_COLOR_MAP_MONO_TO_MONO_FB, nullptr, {}};
	for (size_t i = 0; i < 256; ++i) greys.textureColorMap[i] = uint8_t(255 - i);
	ASSERT_EQ(style(layer, 1, {}, &greys), XR_SUCCESS);
	EXPECT_EQ(newestStyle().map[10], (std::array<uint8_t, 4>{245, 245, 245, 255}));
	ASSERT_EQ(style(layer, 1), XR_SUCCESS);
	EXPECT_EQ(newestStyle().mapped, 0u) << "a style replaces the one before wholly";
}

TEST_F(PassthroughTest, WrongStylesAreRefusedAndChangeNothing)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	XrPassthroughLayerFB layer = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough), XR_SUCCESS);
	ASSERT_EQ(createLayer(passthrough, layer), XR_SUCCESS);
	const size_t before = app.service.record().passthroughStyles.size();
	for (const float opacity : {-0.1f, 1.1f, NAN}) EXPECT_EQ(style(layer, opacity), XR_ERROR_VALIDATION_FAILURE) << opacity;
	EXPECT_EQ(style(layer, 1, {0, 0, 2, 0}), XR_ERROR_VALIDATION_FAILURE);
	for (const std::array<float, 3> &numbers : {std::array{101.0f, 1.0f, 1.0f}, {0, -1, 1}, {0, 1, -1}, {NAN, 1, 1}, {0, NAN, 1}}) {
		const XrPassthroughBrightnessContrastSaturationFB adjustment{XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB, nullptr,
																	 numbers[0], numbers[1], numbers[2]};
		EXPECT_EQ(style(layer, 1, {}, &adjustment), XR_ERROR_VALIDATION_FAILURE) << numbers[0] << ' ' << numbers[1] << ' ' << numbers[2];
	}
	XrPassthroughColorMapMonoToRgbaFB colours{XR_TYPE_PASSTHROUGH_COLOR_MAP_MONO_TO_RGBA_FB, nullptr, {}};
	colours.textureColorMap[200].g = -0.5f;
	EXPECT_EQ(style(layer, 1, {}, &colours), XR_ERROR_VALIDATION_FAILURE);
	XrPassthroughColorMapMonoToMonoFB greys{XR_TYPE_PASSTHROUGH_COLOR_MAP_MONO_TO_MONO_FB, nullptr, {}};
	const XrPassthroughBrightnessContrastSaturationFB both{XR_TYPE_PASSTHROUGH_BRIGHTNESS_CONTRAST_SATURATION_FB, &greys, 0, 1, 1};
	EXPECT_EQ(style(layer, 1, {}, &both), XR_ERROR_VALIDATION_FAILURE) << "they exclude each other";
	EXPECT_EQ(app.service.record().passthroughStyles.size(), before);
}

TEST_F(PassthroughTest, GeometryInstancesHaveNoLayerToHangOn)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	XrPassthroughLayerFB layer = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough), XR_SUCCESS);
	ASSERT_EQ(createLayer(passthrough, layer), XR_SUCCESS);
	const XrSpace local = app.application.space(app.session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	XrGeometryInstanceCreateInfoFB info{
		XR_TYPE_GEOMETRY_INSTANCE_CREATE_INFO_FB, nullptr, layer, XR_NULL_HANDLE, local, {{0, 0, 0, 1}, {0, 0, 0}}, {1, 1, 1}};
	const auto createInstance = app.get<PFN_xrCreateGeometryInstanceFB>("xrCreateGeometryInstanceFB");
	XrGeometryInstanceFB instance = XR_NULL_HANDLE;
	EXPECT_EQ(createInstance(app.session, &info, &instance), XR_ERROR_FEATURE_UNSUPPORTED);
	info.pose.orientation.w = 0;
	EXPECT_EQ(createInstance(app.session, &info, &instance), XR_ERROR_POSE_INVALID);
	info.layer = XR_NULL_HANDLE;
	EXPECT_EQ(createInstance(app.session, &info, &instance), XR_ERROR_HANDLE_INVALID);
	const XrGeometryInstanceTransformFB transform{
		XR_TYPE_GEOMETRY_INSTANCE_TRANSFORM_FB, nullptr, local, 1, {{0, 0, 0, 1}, {0, 0, 0}}, {1, 1, 1}};
	EXPECT_EQ(app.get<PFN_xrGeometryInstanceSetTransformFB>("xrGeometryInstanceSetTransformFB")(instance, &transform),
			  XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(app.get<PFN_xrDestroyGeometryInstanceFB>("xrDestroyGeometryInstanceFB")(instance), XR_ERROR_HANDLE_INVALID);
}

TEST_F(PassthroughTest, SystemsSayThatTheyHaveIt)
{
	XrSystemPassthroughProperties2FB second{XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES2_FB, nullptr, 0};
	XrSystemPassthroughPropertiesFB first{XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES_FB, &second, 7};
	XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES, &first};
	const auto getProperties = app.get<PFN_xrGetSystemProperties>("xrGetSystemProperties");
	ASSERT_EQ(getProperties(app.application.instance, app.application.system(), &properties), XR_SUCCESS);
	EXPECT_EQ(first.supportsPassthrough, XrBool32(XR_TRUE));
	EXPECT_EQ(second.capabilities, XR_PASSTHROUGH_CAPABILITY_BIT_FB | XR_PASSTHROUGH_CAPABILITY_COLOR_BIT_FB);
}

TEST_F(PassthroughTest, GoesWithItsSession)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	XrPassthroughLayerFB layer = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough, running), XR_SUCCESS);
	ASSERT_EQ(createLayer(passthrough, layer, running), XR_SUCCESS);
	ASSERT_EQ(app.get<PFN_xrDestroySession>("xrDestroySession")(app.session), XR_SUCCESS);
	EXPECT_EQ(start(passthrough), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resume(layer), XR_ERROR_HANDLE_INVALID);
	app.session = app.application.session();
	EXPECT_EQ(create(passthrough), XR_SUCCESS) << "a session of its own has its own";
}

TEST_F(PassthroughTest, IsDestroyedAlsoWithoutAService)
{
	XrPassthroughFB passthrough = XR_NULL_HANDLE;
	XrPassthroughLayerFB layer = XR_NULL_HANDLE;
	ASSERT_EQ(create(passthrough), XR_SUCCESS);
	ASSERT_EQ(createLayer(passthrough, layer), XR_SUCCESS);
	app.service.hangUp();
	const XrResult result = start(passthrough);
	EXPECT_TRUE(result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST) << result;
	EXPECT_EQ(destroy(layer), XR_SUCCESS);
	EXPECT_EQ(destroy(passthrough), XR_SUCCESS);
}

TEST(xrCreatePassthroughFB, IsThereForThoseWhoEnableIt)
{
	const HeadlessApplication app;
	EXPECT_EQ(app.application.get<PFN_xrCreatePassthroughFB>("xrCreatePassthroughFB"), nullptr);
	XrSystemPassthroughPropertiesFB passthrough{XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES_FB, nullptr, 7};
	XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES, &passthrough};
	const auto getProperties = app.get<PFN_xrGetSystemProperties>("xrGetSystemProperties");
	ASSERT_EQ(getProperties(app.application.instance, app.application.system(), &properties), XR_SUCCESS);
	EXPECT_EQ(passthrough.supportsPassthrough, 7u);
}

} // namespace
} // namespace arift
