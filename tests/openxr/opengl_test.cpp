// Sessions that draw with OpenGL and OpenGL ES: the service's memory as textures, and an application's context that comes back as it was.
#include "tests/openxr/application.h"
#include "tests/openxr/gl_application.h"
#include "tests/openxr/image_service.h"
#include <cstring>
#include <tuple>

namespace arift
{
namespace
{

using Api = GlApplication::Api;

constexpr int width = 64, height = 48;
constexpr std::array<float, 4> red{1, 0, 0, 1}, blue{0, 0, 1, 1};
constexpr std::array<int64_t, 4> depthFormats{GL_DEPTH_COMPONENT16, GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT32F, GL_DEPTH32F_STENCIL8};
constexpr uint32_t redTexel = 0xff0000ff, blueTexel = 0xffff0000; // bytes: red, green, blue, alpha

class GlSession : public testing::TestWithParam<std::tuple<Api, ipc::Sharing>>, protected ImageService
{
protected:
	GlSession() : ImageService(std::get<1>(GetParam())) {}
	static Api api() { return std::get<0>(GetParam()); }
	static bool isCopied() { return std::get<1>(GetParam()) == ipc::Sharing::copies; }
	template <typename Pfn> Pfn get(const char *name) const { return application.get<Pfn>(name); }
	static const char *nameOf(Api kind) { return kind == Api::openGlEs ? "XR_KHR_opengl_es_enable" : "XR_KHR_opengl_enable"; }

	void askForRequirements() const
	{
		XrGraphicsRequirementsOpenGLKHR desktop{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR};
		XrGraphicsRequirementsOpenGLESKHR es{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_ES_KHR};
		if (api() == Api::openGlEs) {
			EXPECT_EQ(get<PFN_xrGetOpenGLESGraphicsRequirementsKHR>("xrGetOpenGLESGraphicsRequirementsKHR")(application.instance,
																											application.system(), &es),
					  XR_SUCCESS);
			EXPECT_EQ(es.minApiVersionSupported, XR_MAKE_VERSION(3, 0, 0));
		} else {
			EXPECT_EQ(get<PFN_xrGetOpenGLGraphicsRequirementsKHR>("xrGetOpenGLGraphicsRequirementsKHR")(application.instance,
																										application.system(), &desktop),
					  XR_SUCCESS);
			EXPECT_EQ(desktop.minApiVersionSupported, XR_MAKE_VERSION(3, 3, 0));
		}
	}
	XrResult createSession(const void *binding, XrSession &made) const
	{
		const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, binding, 0, application.system()};
		return get<PFN_xrCreateSession>("xrCreateSession")(application.instance, &info, &made);
	}
	void SetUp() override
	{
		askForRequirements();
		ASSERT_EQ(createSession(&gl.binding, session), XR_SUCCESS);
	}
	void TearDown() override
	{
		if (session) { EXPECT_EQ(get<PFN_xrDestroySession>("xrDestroySession")(session), XR_SUCCESS); }
	}

	static XrSwapchainCreateInfo swapchainInfo(uint32_t layers = 1)
	{
		return {.type = XR_TYPE_SWAPCHAIN_CREATE_INFO,
				.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT,
				.format = GL_RGBA8,
				.sampleCount = 1,
				.width = width,
				.height = height,
				.faceCount = 1,
				.arraySize = layers,
				.mipCount = 1};
	}
	XrResult create(const XrSwapchainCreateInfo &info, XrSwapchain &made) const
	{
		return get<PFN_xrCreateSwapchain>("xrCreateSwapchain")(session, &info, &made);
	}
	std::vector<GLuint> texturesOf(XrSwapchain swapchain) const
	{
		uint32_t count = 0;
		const bool es = api() == Api::openGlEs;
		std::vector<XrSwapchainImageOpenGLKHR> found(
			8, {es ? XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR : XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR, nullptr, 0});
		EXPECT_EQ(get<PFN_xrEnumerateSwapchainImages>("xrEnumerateSwapchainImages")(
					  swapchain, 8, &count, reinterpret_cast<XrSwapchainImageBaseHeader *>(found.data())),
				  XR_SUCCESS);
		std::vector<GLuint> textures;
		for (uint32_t i = 0; i < count; ++i) textures.push_back(found[i].image);
		return textures;
	}
	uint32_t acquire(XrSwapchain swapchain) const
	{
		uint32_t index = 99;
		EXPECT_EQ(get<PFN_xrAcquireSwapchainImage>("xrAcquireSwapchainImage")(swapchain, nullptr, &index), XR_SUCCESS);
		const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, second};
		EXPECT_EQ(get<PFN_xrWaitSwapchainImage>("xrWaitSwapchainImage")(swapchain, &wait), XR_SUCCESS);
		return index;
	}
	void release(XrSwapchain swapchain) const
	{
		EXPECT_EQ(get<PFN_xrReleaseSwapchainImage>("xrReleaseSwapchainImage")(swapchain, nullptr), XR_SUCCESS);
	}
	/// Ends a begun frame with a quad that shows the newest image.
	void showQuad(XrSwapchain swapchain, XrTime time) const
	{
		const XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD,
										  nullptr,
										  0,
										  application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL),
										  XR_EYE_VISIBILITY_BOTH,
										  {swapchain, {{0, 0}, {width, height}}, 0},
										  {{0, 0, 0, 1}, {0, 0, -1}},
										  {1, 1}};
		EXPECT_EQ(application.endFrame(session, time, {reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quad)}), XR_SUCCESS);
	}
	XrTime beginFrame() const
	{
		XrFrameState state;
		EXPECT_EQ(application.wait(session, state), XR_SUCCESS);
		EXPECT_EQ(application.beginFrame(session), XR_SUCCESS);
		return state.predictedDisplayTime;
	}
	/// Everything a frame does, with one image of a swapchain.
	void frame(XrSwapchain swapchain) const
	{
		const XrTime time = beginFrame();
		acquire(swapchain);
		release(swapchain);
		showQuad(swapchain, time);
	}
	/// Of the first swapchain.
	uint32_t texel(size_t image, int layer, int row) const
	{
		uint32_t value = 0;
		if (isCopied()) {
			const gpu::CopyLayout layout = gpu::copyLayoutOf(copiedSpec());
			const ipc::Mapping memory = ipc::mapWritable(copies[image].get(), layout.size);
			std::memcpy(&value, static_cast<std::byte *>(memory.address()) + layer * layout.layerPitch + row * layout.rowPitch,
						sizeof value);
		} else {
			const gpu::ImageRows rows = images[image].rows();
			std::memcpy(&value, rows.first + layer * rows.layerPitch + row * rows.rowPitch, sizeof value);
		}
		return value;
	}
	static gpu::ImageSpec copiedSpec() { return {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = width, .height = height, .arrayLayers = 2}; }

	Application application{{nameOf(api()), "XR_MNDX_egl_enable", "XR_KHR_composition_layer_depth"}};
	GlApplication gl{api()};
	XrSession session = XR_NULL_HANDLE;
};

TEST_P(GlSession, WhatIsDrawnReachesTheServiceBottomRowFirst)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	XrSwapchain swapchain = XR_NULL_HANDLE;
	ASSERT_EQ(create(swapchainInfo(2), swapchain), XR_SUCCESS);
	const std::vector<GLuint> textures = texturesOf(swapchain);
	ASSERT_EQ(textures.size(), 3u);
	for (uint64_t frame = 1; frame <= 5; ++frame) {
		const XrTime time = beginFrame();
		const uint32_t image = acquire(swapchain);
		gl.fill(textures[image], GL_TEXTURE_2D_ARRAY, 0, width, height, red, blue);
		gl.fill(textures[image], GL_TEXTURE_2D_ARRAY, 1, width, height, blue, red);
		release(swapchain);
		showQuad(swapchain, time);
		const auto record = service.waitFor([&](const auto &r) { return r.submissions.size() == frame; });
		EXPECT_EQ(record.submissions.back().layers[0].views[0].image.image, image);
		EXPECT_EQ(record.submissions.back().rowsGoUp, 1u);
		EXPECT_EQ(texel(image, 0, 0), redTexel) << "finished before the service hears of it";
		EXPECT_EQ(texel(image, 0, height - 1), blueTexel);
		EXPECT_EQ(texel(image, 1, 0), blueTexel);
		EXPECT_EQ(texel(image, 1, height - 1), redTexel);
	}
	EXPECT_EQ(get<PFN_xrDestroySwapchain>("xrDestroySwapchain")(swapchain), XR_SUCCESS);
}

TEST_P(GlSession, DepthIsSubmittedWhereItsImagesReachTheService)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	XrSwapchainCreateInfo info = swapchainInfo();
	XrSwapchain colours = XR_NULL_HANDLE, depths = XR_NULL_HANDLE;
	ASSERT_EQ(create(info, colours), XR_SUCCESS);
	info.usageFlags = XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
	info.format = GL_DEPTH_COMPONENT16;
	ASSERT_EQ(create(info, depths), XR_SUCCESS);
	const XrTime time = beginFrame();
	for (const XrSwapchain swapchain : {colours, depths}) {
		acquire(swapchain);
		release(swapchain);
	}
	const XrCompositionLayerDepthInfoKHR depth{
		XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, {depths, {{0, 0}, {width, height}}, 0}, 0, 1, 0.1f, 10};
	XrCompositionLayerProjectionView view{XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
										  &depth,
										  {{0, 0, 0, 1}, {0, 0, 0}},
										  {-0.5f, 0.5f, 0.5f, -0.5f},
										  {colours, {{0, 0}, {width, height}}, 0}};
	const std::array views{view, view};
	const XrCompositionLayerProjection layer{
		XR_TYPE_COMPOSITION_LAYER_PROJECTION, nullptr, 0, application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL), 2, views.data()};
	EXPECT_EQ(application.endFrame(session, time, {reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer)}), XR_SUCCESS);
	const auto record = service.waitFor([](const auto &r) { return r.submissions.size() == 1; });
	for (const ipc::LayerView &submitted : record.submissions.back().layers[0].views)
		EXPECT_EQ(submitted.depth.image.swapchain != 0, !isCopied()) << "an image that stays cleared would say that all is far away";
}

TEST_P(GlSession, BindingsAndPendingErrorsComeBackAsTheyWere)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	const auto bindTexture = GlApplication::get<void (*)(GLenum, GLuint)>("glBindTexture");
	const auto getInteger = GlApplication::get<void (*)(GLenum, GLint *)>("glGetIntegerv");
	const auto getError = GlApplication::get<GLenum (*)()>("glGetError");
	GLuint mine[3]{};
	GlApplication::get<void (*)(GLsizei, GLuint *)>("glGenTextures")(3, mine);
	constexpr GLenum targets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP};
	constexpr GLenum bindings[] = {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP};
	for (int i = 0; i < 3; ++i) bindTexture(targets[i], mine[i]);
	while (getError() != GL_NO_ERROR) continue;
	bindTexture(GL_NONE, 0); // an error that the application has not asked for yet
	const EGLContext before = GlApplication::current();
	for (const uint32_t layers : {1u, 2u, 6u}) {
		XrSwapchain swapchain = XR_NULL_HANDLE;
		XrSwapchainCreateInfo info = swapchainInfo(layers == 6 ? 1 : layers);
		if (layers == 6) info.faceCount = 6, info.width = info.height;
		ASSERT_EQ(create(info, swapchain), XR_SUCCESS);
		if (layers < 6) frame(swapchain);
		EXPECT_EQ(get<PFN_xrDestroySwapchain>("xrDestroySwapchain")(swapchain), XR_SUCCESS);
	}
	EXPECT_EQ(GlApplication::current(), before);
	for (int i = 0; i < 3; ++i) {
		GLint bound = 0;
		getInteger(bindings[i], &bound);
		EXPECT_EQ(GLuint(bound), mine[i]);
	}
	EXPECT_EQ(getError(), GLenum(GL_INVALID_ENUM));
	EXPECT_EQ(getError(), GLenum(GL_NO_ERROR));
}

TEST_P(GlSession, WhateverContextIsCurrentStaysSo)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	XrSwapchain swapchain = XR_NULL_HANDLE;
	GlApplication::makeNoneCurrent();
	ASSERT_EQ(create(swapchainInfo(), swapchain), XR_SUCCESS);
	EXPECT_EQ(GlApplication::current(), EGL_NO_CONTEXT);
	frame(swapchain);
	EXPECT_EQ(GlApplication::current(), EGL_NO_CONTEXT);
	const GlApplication other(api() == Api::openGl ? Api::openGlEs : Api::openGl);
	const EGLenum api = ::eglQueryAPI();
	const EGLContext theirs = GlApplication::current();
	frame(swapchain);
	EXPECT_EQ(::eglQueryAPI(), api);
	EXPECT_EQ(GlApplication::current(), theirs);
	EXPECT_EQ(get<PFN_xrDestroySwapchain>("xrDestroySwapchain")(swapchain), XR_SUCCESS);
	EXPECT_EQ(GlApplication::current(), theirs);
}

TEST_P(GlSession, EveryFormatListedCanBeHad)
{
	uint32_t count = 0;
	const auto enumerate = get<PFN_xrEnumerateSwapchainFormats>("xrEnumerateSwapchainFormats");
	ASSERT_EQ(enumerate(session, 0, &count, nullptr), XR_SUCCESS);
	std::vector<int64_t> formats(count);
	ASSERT_EQ(enumerate(session, count, &count, formats.data()), XR_SUCCESS);
	ASSERT_GE(formats.size(), 8u);
	EXPECT_EQ(formats[0], GL_SRGB8_ALPHA8);
	for (const int64_t needed : {GL_RGBA8, GL_RGBA16F, GL_RGB10_A2, GL_DEPTH_COMPONENT16, GL_DEPTH24_STENCIL8})
		EXPECT_NE(std::ranges::find(formats, needed), formats.end()) << "internal format " << needed;
	for (const int64_t format : formats)
		for (const uint32_t levels : {1u, 3u}) {
			const bool isDepth = std::ranges::find(depthFormats, format) != depthFormats.end();
			XrSwapchainCreateInfo info = swapchainInfo(2);
			info.format = format;
			info.mipCount = levels;
			info.usageFlags = isDepth ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
			XrSwapchain swapchain = XR_NULL_HANDLE;
			EXPECT_EQ(create(info, swapchain), XR_SUCCESS) << "internal format " << format << ", " << levels << " levels";
			acquire(swapchain);
			release(swapchain);
			EXPECT_EQ(get<PFN_xrDestroySwapchain>("xrDestroySwapchain")(swapchain), XR_SUCCESS);
		}
	XrSwapchain none = XR_NULL_HANDLE;
	XrSwapchainCreateInfo info = swapchainInfo();
	info.format = GL_RGB8;
	EXPECT_EQ(create(info, none), XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
	info = swapchainInfo();
	info.usageFlags |= 0x80; // XR_SWAPCHAIN_USAGE_INPUT_ATTACHMENT_BIT, which is Vulkan's
	EXPECT_EQ(create(info, none), XR_ERROR_FEATURE_UNSUPPORTED);
}

TEST_P(GlSession, TheGraphicsBindingIsChecked)
{
	ASSERT_EQ(get<PFN_xrDestroySession>("xrDestroySession")(session), XR_SUCCESS);
	session = XR_NULL_HANDLE;
	XrSession made = XR_NULL_HANDLE;
	EXPECT_EQ(createSession(nullptr, made), XR_ERROR_GRAPHICS_DEVICE_INVALID);
	for (const auto spoil :
		 {+[](XrGraphicsBindingEGLMNDX &b) { b.display = nullptr; }, +[](XrGraphicsBindingEGLMNDX &b) { b.context = nullptr; },
		  +[](XrGraphicsBindingEGLMNDX &b) { b.getProcAddress = nullptr; }}) {
		auto binding = gl.binding;
		spoil(binding);
		EXPECT_EQ(createSession(&binding, made), XR_ERROR_GRAPHICS_DEVICE_INVALID);
	}
	EXPECT_EQ(createSession(&gl.binding, session), XR_SUCCESS);
	const Application hasty({nameOf(api()), "XR_MNDX_egl_enable"});
	const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &gl.binding, 0, hasty.system()};
	EXPECT_EQ(hasty.get<PFN_xrCreateSession>("xrCreateSession")(hasty.instance, &info, &made), XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
}

std::string nameOf(const testing::TestParamInfo<std::tuple<Api, ipc::Sharing>> &parameters)
{
	const bool isOpenGl = std::get<0>(parameters.param) == Api::openGl, isShared = std::get<1>(parameters.param) == ipc::Sharing::memory;
	return std::string(isOpenGl ? "OpenGL" : "OpenGLES") + (isShared ? "Shared" : "Copied");
}
INSTANTIATE_TEST_SUITE_P(Every, GlSession,
						 testing::Combine(testing::Values(Api::openGl, Api::openGlEs),
										  testing::Values(ipc::Sharing::memory, ipc::Sharing::copies)),
						 nameOf);

} // namespace
} // namespace arift
