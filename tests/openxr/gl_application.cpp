#include "tests/openxr/gl_application.h"
#include <EGL/eglext.h>
#include <stdexcept>

namespace arift
{
namespace
{

EGLDisplay openDisplay()
{
	const auto getPlatformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(::eglGetProcAddress("eglGetPlatformDisplayEXT"));
	const EGLDisplay display =
		getPlatformDisplay ? getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) : EGL_NO_DISPLAY;
	if (display == EGL_NO_DISPLAY || !::eglInitialize(display, nullptr, nullptr))
		throw std::runtime_error("EGL has no surfaceless display");
	return display;
}

EGLContext makeContext(EGLDisplay display, GlApplication::Api api)
{
	const bool es = api == GlApplication::Api::openGlEs;
	::eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
	const EGLint core[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
	const EGLint embedded[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE};
	const EGLContext context = ::eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, es ? embedded : core);
	if (context == EGL_NO_CONTEXT) throw std::runtime_error("EGL makes no context");
	return context;
}

} // namespace

GlApplication::GlApplication(Api kind) : api(kind), display_(openDisplay()), context_(makeContext(display_, kind))
{
	binding.getProcAddress = ::eglGetProcAddress;
	binding.display = display_;
	binding.context = context_;
	makeCurrent();
}

GlApplication::~GlApplication()
{
	if (current() == context_) makeNoneCurrent();
	::eglDestroyContext(display_, context_);
}

void GlApplication::makeCurrent() const
{
	::eglBindAPI(api == Api::openGlEs ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
	if (!::eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) throw std::runtime_error("the context is not made current");
}

void GlApplication::makeNoneCurrent() { ::eglMakeCurrent(::eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

void GlApplication::fill(GLuint texture, GLenum target, int layer, int width, int height, const std::array<float, 4> &lower,
						 const std::array<float, 4> &upper) const
{
	GLuint framebuffer = 0;
	get<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers")(1, &framebuffer);
	get<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer);
	if (target == GL_TEXTURE_2D_ARRAY)
		get<PFNGLFRAMEBUFFERTEXTURELAYERPROC>("glFramebufferTextureLayer")(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0, layer);
	else
		get<PFNGLFRAMEBUFFERTEXTURE2DPROC>("glFramebufferTexture2D")(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, target, texture, 0);
	if (get<PFNGLCHECKFRAMEBUFFERSTATUSPROC>("glCheckFramebufferStatus")(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		throw std::runtime_error("a swapchain's texture cannot be drawn into");
	const auto clear = [&](int y, int rows, const std::array<float, 4> &colour) {
		get<void (*)(GLint, GLint, GLsizei, GLsizei)>("glScissor")(0, y, width, rows);
		get<void (*)(GLfloat, GLfloat, GLfloat, GLfloat)>("glClearColor")(colour[0], colour[1], colour[2], colour[3]);
		get<void (*)(GLbitfield)>("glClear")(GL_COLOR_BUFFER_BIT);
	};
	get<void (*)(GLenum)>("glEnable")(GL_SCISSOR_TEST);
	clear(0, height / 2, lower);
	clear(height / 2, height - height / 2, upper);
	get<void (*)(GLenum)>("glDisable")(GL_SCISSOR_TEST);
	get<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, 0);
	get<PFNGLDELETEFRAMEBUFFERSPROC>("glDeleteFramebuffers")(1, &framebuffer);
}

} // namespace arift
