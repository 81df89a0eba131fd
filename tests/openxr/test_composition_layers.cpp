// XR_KHR_composition_layer_cylinder, _equirect, _equirect2, _cube, _depth, _color_scale_bias, XR_FB_composition_layer_alpha_blend,
// _depth_test and XR_VARJO_composition_layer_depth_test: what xrEndFrame says of them, and what becomes of them on the wire.
#include "tests/openxr/vulkan_session.h"
#include <cmath>
#include <limits>
#include <numbers>

namespace arift
{
namespace
{

constexpr float pi = std::numbers::pi_v<float>, infinity = std::numeric_limits<float>::infinity();
constexpr XrPosef place{{0, 0, 0, 1}, {0.5f, 0, -1}};

struct CompositionLayers : VulkanSession {
	CompositionLayers()
		: VulkanSession(ipc::Sharing::memory, {},
						{"XR_KHR_composition_layer_cylinder", "XR_KHR_composition_layer_equirect", "XR_KHR_composition_layer_equirect2",
						 "XR_KHR_composition_layer_cube", "XR_KHR_composition_layer_depth", "XR_KHR_composition_layer_color_scale_bias",
						 "XR_FB_composition_layer_alpha_blend", "XR_FB_composition_layer_depth_test",
						 "XR_VARJO_composition_layer_depth_test"}),
		  chain(swapchain()),
		  space(application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL))
	{
		EXPECT_EQ(application.begin(session), XR_SUCCESS);
		time = beginFrame();
		draw(chain);
	}

	template <typename Layer> XrResult end(const Layer &layer)
	{
		const XrResult result = application.endFrame(session, time, {reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer)});
		if (result == XR_SUCCESS) {
			++ended;
			time = beginFrame();
		}
		return result;
	}
	/// The only layer of the newest submission.
	ipc::Layer newest()
	{
		const auto record = service.waitFor([&](const auto &r) { return r.submissions.size() == ended; });
		EXPECT_EQ(record.submissions.back().layerCount, 1u);
		return record.submissions.back().layers[0];
	}
	uint32_t layersOfNewest()
	{
		return service.waitFor([&](const auto &r) { return r.submissions.size() == ended; }).submissions.back().layerCount;
	}
	/// What xrEndFrame says of `good` after `change`.
	template <typename Layer, typename Change> XrResult resultOf(Layer layer, Change change)
	{
		change(layer);
		return end(layer);
	}
	XrSwapchainSubImage image() const { return {chain, {{8, 4}, {16, 12}}, 1}; }
	XrCompositionLayerQuad quad(const void *next = nullptr) const
	{
		return {XR_TYPE_COMPOSITION_LAYER_QUAD, next, 0, space, XR_EYE_VISIBILITY_BOTH, image(), place, {1, 1}};
	}
	XrSwapchain drawn(const XrSwapchainCreateInfo &info)
	{
		XrSwapchain made = XR_NULL_HANDLE;
		EXPECT_EQ(create(info, made), XR_SUCCESS);
		acquire(made);
		EXPECT_EQ(wait(made), XR_SUCCESS);
		EXPECT_EQ(release(made), XR_SUCCESS);
		return made;
	}

	const XrSwapchain chain;
	const XrSpace space;
	XrTime time = 0;
	size_t ended = 0;
};

TEST_F(CompositionLayers, ACylinderIsTheInsideOfASection)
{
	const XrCompositionLayerCylinderKHR good{
		XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR, nullptr, 0, space, XR_EYE_VISIBILITY_LEFT, image(), place, 2, pi / 2, 1.5f};
	ASSERT_EQ(end(good), XR_SUCCESS);
	const ipc::Layer layer = newest();
	EXPECT_EQ(layer.type, ipc::LayerType::cylinder);
	EXPECT_EQ(layer.eyes, 1u);
	EXPECT_EQ(layer.views[0].image.x, 8);
	EXPECT_FLOAT_EQ(layer.views[0].pose.position.x, 0.5f);
	EXPECT_FLOAT_EQ(layer.curved.radius, 2);
	EXPECT_FLOAT_EQ(layer.curved.uvPerUnit.x * pi / 4 + layer.curved.uvAhead.x, 1) << "its right edge";
	EXPECT_FLOAT_EQ(layer.curved.uvPerUnit.y * (pi / 2 / 1.5f / 2) + layer.curved.uvAhead.y, 0) << "its upper edge, in radii";
	for (const float endless : {0.0f, infinity}) {
		EXPECT_EQ(resultOf(good, [&](auto &c) { c.radius = endless; }), XR_SUCCESS);
		EXPECT_EQ(newest().curved.radius, 0);
	}
	EXPECT_EQ(resultOf(good, [](auto &c) { c.centralAngle = 0; }), XR_SUCCESS);
	EXPECT_EQ(layersOfNewest(), 0u) << "no extent, nothing to be seen";
	for (const float radius : {-1.0f, NAN}) EXPECT_EQ(resultOf(good, [&](auto &c) { c.radius = radius; }), XR_ERROR_VALIDATION_FAILURE);
	for (const float angle : {-0.1f, 2 * pi + 0.1f, NAN})
		EXPECT_EQ(resultOf(good, [&](auto &c) { c.centralAngle = angle; }), XR_ERROR_VALIDATION_FAILURE);
	for (const float aspect : {0.0f, -1.0f, infinity, NAN})
		EXPECT_EQ(resultOf(good, [&](auto &c) { c.aspectRatio = aspect; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.pose.orientation.w = 2; }), XR_ERROR_POSE_INVALID);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.subImage.imageRect.extent.width = 100; }), XR_ERROR_SWAPCHAIN_RECT_INVALID);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.space = XR_NULL_HANDLE; }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.eyeVisibility = XrEyeVisibility(7); }), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(CompositionLayers, AnEquirectTakesItsPartOfTheSphere)
{
	const XrCompositionLayerEquirectKHR good{
		XR_TYPE_COMPOSITION_LAYER_EQUIRECT_KHR, nullptr, 0, space, XR_EYE_VISIBILITY_BOTH, image(), place, 0, {0.25f, 0.5f}, {0, 0}};
	ASSERT_EQ(end(good), XR_SUCCESS);
	const ipc::CurvedSurface surface = newest().curved;
	EXPECT_EQ(newest().type, ipc::LayerType::equirect);
	EXPECT_FLOAT_EQ(surface.uvAhead.x + surface.uvPerUnit.x * pi / 4, 1) << "a quarter of the whole turn";
	EXPECT_FLOAT_EQ(surface.uvAhead.y + surface.uvPerUnit.y * pi / 4, 0) << "half of the half turn";
	EXPECT_EQ(resultOf(good, [](auto &e) { e.scale.x = 0; }), XR_SUCCESS);
	EXPECT_EQ(layersOfNewest(), 0u);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.scale.y = NAN; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.bias.x = infinity; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.radius = -1; }), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(CompositionLayers, AnEquirect2IsGivenByItsAngles)
{
	const XrCompositionLayerEquirect2KHR good{
		XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR, nullptr, 0, space, XR_EYE_VISIBILITY_BOTH, image(), place, 3, pi, pi / 4, -pi / 8};
	ASSERT_EQ(end(good), XR_SUCCESS);
	const ipc::CurvedSurface surface = newest().curved;
	EXPECT_EQ(newest().type, ipc::LayerType::equirect);
	EXPECT_FLOAT_EQ(surface.radius, 3);
	EXPECT_FLOAT_EQ(surface.uvAhead.x - surface.uvPerUnit.x * pi / 2, 0) << "its left edge";
	EXPECT_NEAR(surface.uvAhead.y + surface.uvPerUnit.y * pi / 4, 0, 1e-6) << "its upper edge";
	EXPECT_FLOAT_EQ(surface.uvAhead.y - surface.uvPerUnit.y * pi / 8, 1) << "its lower edge";
	EXPECT_EQ(resultOf(good, [](auto &e) { e.lowerVerticalAngle = e.upperVerticalAngle; }), XR_SUCCESS);
	EXPECT_EQ(layersOfNewest(), 0u);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.centralHorizontalAngle = 2 * pi; }), XR_SUCCESS);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.centralHorizontalAngle = 6.4f; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.upperVerticalAngle = 1.7f; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf(good, [](auto &e) { e.lowerVerticalAngle = NAN; }), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(CompositionLayers, ACubeNeedsASwapchainWithFaces)
{
	XrSwapchainCreateInfo info = swapchainInfo();
	info.height = info.width;
	info.faceCount = 6;
	const XrSwapchain cubes = drawn(info);
	const XrCompositionLayerCubeKHR good{
		XR_TYPE_COMPOSITION_LAYER_CUBE_KHR, nullptr, 0, space, XR_EYE_VISIBILITY_RIGHT, cubes, 1, {0, 0, 1, 0}};
	ASSERT_EQ(end(good), XR_SUCCESS);
	const ipc::Layer layer = newest();
	EXPECT_EQ(layer.type, ipc::LayerType::cube);
	EXPECT_EQ(layer.eyes, 2u);
	EXPECT_EQ(layer.views[0].image.arrayIndex, 1u);
	EXPECT_EQ(layer.views[0].image.width, 64);
	EXPECT_EQ(layer.views[0].pose.orientation.z, 1);
	EXPECT_EQ(resultOf(good, [&](auto &c) { c.swapchain = chain; }), XR_ERROR_LAYER_INVALID);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.swapchain = XR_NULL_HANDLE; }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.imageArrayIndex = 2; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf(good, [](auto &c) { c.orientation.z = 0; }), XR_ERROR_POSE_INVALID);
	EXPECT_EQ(resultOf(quad(), [&](auto &q) { q.subImage.swapchain = cubes; }), XR_ERROR_LAYER_INVALID) << "a cube is no flat image";
}

TEST_F(CompositionLayers, ScaleAndBiasComeWithAnyLayer)
{
	XrCompositionLayerColorScaleBiasKHR change{
		XR_TYPE_COMPOSITION_LAYER_COLOR_SCALE_BIAS_KHR, nullptr, {0.5f, -1, 2, 1e9f}, {-0.25f, 0, 0.5f, 1}};
	ASSERT_EQ(end(quad(&change)), XR_SUCCESS);
	const ipc::Layer layer = newest();
	EXPECT_EQ(layer.colorScale.r, 0.5f);
	EXPECT_EQ(layer.colorScale.g, 0) << "negative scales are none";
	EXPECT_EQ(layer.colorScale.a, 1000);
	EXPECT_EQ(layer.colorBias.r, -0.25f);
	ASSERT_EQ(end(quad()), XR_SUCCESS);
	EXPECT_EQ(newest().colorScale.r, 1) << "of that layer alone";
	change.colorBias.g = NAN;
	EXPECT_EQ(end(quad(&change)), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(CompositionLayers, BlendFactorsComeWithAnyLayer)
{
	XrCompositionLayerAlphaBlendFB blend{
		XR_TYPE_COMPOSITION_LAYER_ALPHA_BLEND_FB, nullptr, XR_BLEND_FACTOR_SRC_ALPHA_FB, XR_BLEND_FACTOR_ONE_FB, XR_BLEND_FACTOR_ZERO_FB,
		XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB};
	ASSERT_EQ(end(quad(&blend)), XR_SUCCESS);
	const ipc::BlendFactors factors = newest().blend;
	EXPECT_EQ(factors.given, 1u);
	EXPECT_EQ(factors.sourceColor, uint32_t(XR_BLEND_FACTOR_SRC_ALPHA_FB));
	EXPECT_EQ(factors.destinationColor, uint32_t(XR_BLEND_FACTOR_ONE_FB));
	EXPECT_EQ(factors.sourceAlpha, uint32_t(XR_BLEND_FACTOR_ZERO_FB));
	EXPECT_EQ(factors.destinationAlpha, uint32_t(XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB));
	ASSERT_EQ(end(quad()), XR_SUCCESS);
	EXPECT_EQ(newest().blend.given, 0u);
	blend.dstFactorAlpha = XrBlendFactorFB(6);
	EXPECT_EQ(end(quad(&blend)), XR_ERROR_VALIDATION_FAILURE);
}

struct DepthLayers : CompositionLayers {
	DepthLayers()
	{
		XrSwapchainCreateInfo info = swapchainInfo();
		info.usageFlags = XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
		info.format = VK_FORMAT_D32_SFLOAT;
		depths = drawn(info);
		for (uint32_t eye = 0; eye < 2; ++eye) {
			infos[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, {depths, {{0, 0}, {32, 24}}, eye}, 0, 1, 0.1f, infinity};
			projection.views[eye].next = &infos[eye];
		}
	}
	XrSwapchain depths = XR_NULL_HANDLE;
	XrCompositionLayerDepthInfoKHR infos[2];
	XrCompositionLayerDepthTestVARJO range{XR_TYPE_COMPOSITION_LAYER_DEPTH_TEST_VARJO, nullptr, 0.5f, infinity};
	Projection projection{chain, space};
};

TEST_F(DepthLayers, DepthsBecomeInverseDistances)
{
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	const ipc::ViewDepth far = newest().views[1].depth;
	EXPECT_EQ(far.image.arrayIndex, 1u);
	EXPECT_EQ(far.image.width, 32);
	EXPECT_FLOAT_EQ(far.inverseBias, 10) << "depth 0 is 0.1 m away";
	EXPECT_NEAR(far.inverseBias + far.inverseScale, 0, 1e-5) << "depth 1 is endlessly far away";
	infos[1] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, infos[1].subImage, 0.25f, 0.75f, 50, 0.5f}; // reversed
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	const ipc::ViewDepth reversed = newest().views[1].depth;
	EXPECT_NEAR(reversed.inverseBias + 0.25f * reversed.inverseScale, 1 / 50.0, 1e-5);
	EXPECT_NEAR(reversed.inverseBias + 0.75f * reversed.inverseScale, 1 / 0.5, 1e-5);
	projection.views[0].next = projection.views[1].next = nullptr;
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	EXPECT_EQ(newest().views[0].depth.image.swapchain, 0u);
}

TEST_F(DepthLayers, WhatIsNoDepthIsRefused)
{
	const auto depthResult = [&](auto change) {
		const XrCompositionLayerDepthInfoKHR before = infos[0];
		change(infos[0]);
		const XrResult result = end(projection.layer);
		infos[0] = before;
		return result;
	};
	EXPECT_EQ(depthResult([](auto &d) { d.minDepth = 1; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.minDepth = -0.1f; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.maxDepth = 1.1f; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.maxDepth = NAN; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.nearZ = 0; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.nearZ = d.farZ; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.subImage.imageArrayIndex = 2; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(depthResult([](auto &d) { d.subImage.imageRect.extent.width = 65; }), XR_ERROR_SWAPCHAIN_RECT_INVALID);
	EXPECT_EQ(depthResult([](auto &d) { d.subImage.swapchain = XR_NULL_HANDLE; }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(depthResult([&](auto &d) { d.subImage.swapchain = chain; }), XR_ERROR_LAYER_INVALID) << "colour is no depth";
	EXPECT_EQ(depthResult([](auto &) {}), XR_SUCCESS);
	EXPECT_EQ(resultOf(quad(), [&](auto &q) { q.subImage.swapchain = depths; }), XR_ERROR_LAYER_INVALID) << "depth is no colour";
}

TEST_F(DepthLayers, ATestForDepthNeedsDepth)
{
	XrCompositionLayerDepthTestFB test{XR_TYPE_COMPOSITION_LAYER_DEPTH_TEST_FB, nullptr, XR_TRUE, XR_COMPARE_OP_GREATER_FB};
	projection.layer.next = &test;
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	EXPECT_EQ(newest().depthTest.given, 1u);
	EXPECT_EQ(newest().depthTest.compareOp, uint32_t(XR_COMPARE_OP_GREATER_FB));
	EXPECT_EQ(newest().depthTest.writes, 1u);
	ASSERT_EQ(end(quad(&test)), XR_SUCCESS);
	EXPECT_EQ(newest().depthTest.given, 1u) << "a quad's depth is known";
	projection.views[1].next = nullptr;
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	EXPECT_EQ(newest().depthTest.given, 0u) << "a view without depth is not tested";
	test.compareOp = XrCompareOpFB(8);
	EXPECT_EQ(end(projection.layer), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(DepthLayers, ATestForDepthMayHaveARange)
{
	for (XrCompositionLayerDepthInfoKHR &info : infos) info.next = &range;
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	const ipc::Layer found = newest();
	EXPECT_EQ(found.depthTest.given, 1u);
	EXPECT_EQ(found.depthTest.compareOp, uint32_t(XR_COMPARE_OP_LESS_OR_EQUAL_FB));
	EXPECT_EQ(found.depthTest.writes, 1u);
	for (const ipc::LayerView &view : found.views) {
		EXPECT_EQ(view.depth.testedFrom, 0.5f);
		EXPECT_EQ(view.depth.testedTo, 0) << "there is no such end";
	}
	infos[1].next = nullptr;
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	EXPECT_EQ(newest().depthTest.given, 0u) << "one view does not ask for it";
	EXPECT_EQ(newest().views[0].depth.testedFrom, 0);
	infos[0].next = nullptr;
	projection.layer.next = &range;
	ASSERT_EQ(end(projection.layer), XR_SUCCESS);
	EXPECT_EQ(newest().depthTest.given, 1u) << "the layer asks for both";
	EXPECT_EQ(newest().views[0].depth.testedFrom, 0.5f);
	EXPECT_EQ(newest().views[1].depth.testedFrom, 0.5f);
	for (const auto &[nearest, farthest] : {std::pair{1.0f, 1.0f}, {2.0f, 1.0f}, {-1.0f, 1.0f}, {NAN, 1.0f}}) {
		range.depthTestRangeNearZ = nearest;
		range.depthTestRangeFarZ = farthest;
		EXPECT_EQ(end(projection.layer), XR_ERROR_VALIDATION_FAILURE) << nearest << " to " << farthest;
	}
}

TEST_F(VulkanSession, LayersOfExtensionsThatAreNotEnabledAreInvalidAndTheirChainsSkipped)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	const XrSwapchain chain = swapchain();
	const XrSpace space = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const XrTime time = beginFrame();
	draw(chain);
	const XrSwapchainSubImage image{chain, {{0, 0}, {8, 8}}, 0};
	const XrCompositionLayerCylinderKHR cylinder{
		XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR, nullptr, 0, space, XR_EYE_VISIBILITY_BOTH, image, place, 1, 1, 1};
	EXPECT_EQ(application.endFrame(session, time, {reinterpret_cast<const XrCompositionLayerBaseHeader *>(&cylinder)}),
			  XR_ERROR_LAYER_INVALID);
	const XrCompositionLayerAlphaBlendFB blend{XR_TYPE_COMPOSITION_LAYER_ALPHA_BLEND_FB, nullptr, XrBlendFactorFB(99)};
	const XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD, &blend, 0, space, XR_EYE_VISIBILITY_BOTH, image, place, {1, 1}};
	ASSERT_EQ(application.endFrame(session, time, {reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quad)}), XR_SUCCESS);
	EXPECT_EQ(service.waitFor([](const auto &r) { return r.submissions.size() == 1; }).submissions[0].layers[0].blend.given, 0u);
}

} // namespace
} // namespace arift
