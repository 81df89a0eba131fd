#include "runtime/openxr/opengl/gl_platform.h"
// First the above.
#include "runtime/openxr/opengl/gl_context.h"
#include <array>
#include <dlfcn.h>

namespace arift::openxr
{
namespace
{

/// The application has the library open already; it stays open, for the application's objects are its own.
void *opened(std::initializer_list<const char *> names)
{
	for (const char *name : names)
		if (void *library = ::dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
	throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "{} cannot be opened: {}", *names.begin(), ::dlerror());
}

template <typename Pfn> Pfn found(void *library, const char *name)
{
	const auto function = reinterpret_cast<Pfn>(::dlsym(library, name));
	if (!function) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the application's GL has no {}", name);
	return function;
}

/// XR_KHR_opengl_enable. Neither glXFBConfig nor visualid is looked at: applications leave them empty.
class GlxContext final : public GlContext
{
public:
	explicit GlxContext(const XrGraphicsBindingOpenGLXlibKHR &binding)
		: display_(binding.xDisplay), drawable_(binding.glxDrawable), context_(binding.glxContext)
	{
		if (!display_ || !context_) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the graphics binding has a null Display or GLXContext");
	}

	Function find(const char *name) const override { return getProcAddress_(reinterpret_cast<const GLubyte *>(name)); }

	CurrentBinding enter() const override
	{
		const CurrentBinding before{getDisplay_(), getDrawable_(), getReadDrawable_(), getContext_()};
		if (before.context != context_ && !makeCurrent_(display_, drawable_, drawable_, context_))
			throw Error(XR_ERROR_RUNTIME_FAILURE, "the application's GLXContext cannot be made current with the drawable {:#x}", drawable_);
		return before;
	}

	void leave(const CurrentBinding &before) const override
	{
		if (before.context == context_) return;
		if (before.context)
			makeCurrent_(static_cast<Display *>(before.display), before.draw, before.read, static_cast<GLXContext>(before.context));
		else
			makeCurrent_(display_, 0, 0, nullptr);
	}

private:
	Display *const display_;
	const GLXDrawable drawable_;
	const GLXContext context_;
	void *const library_ = opened({"libGL.so.1", "libGLX.so.0"});
	const decltype(&::glXGetProcAddressARB) getProcAddress_ = found<decltype(&::glXGetProcAddressARB)>(library_, "glXGetProcAddressARB");
	const decltype(&::glXMakeContextCurrent) makeCurrent_ = found<decltype(&::glXMakeContextCurrent)>(library_, "glXMakeContextCurrent");
	const decltype(&::glXGetCurrentContext) getContext_ = found<decltype(&::glXGetCurrentContext)>(library_, "glXGetCurrentContext");
	const decltype(&::glXGetCurrentDisplay) getDisplay_ = found<decltype(&::glXGetCurrentDisplay)>(library_, "glXGetCurrentDisplay");
	const decltype(&::glXGetCurrentDrawable) getDrawable_ = found<decltype(&::glXGetCurrentDrawable)>(library_, "glXGetCurrentDrawable");
	const decltype(&::glXGetCurrentReadDrawable) getReadDrawable_ =
		found<decltype(&::glXGetCurrentReadDrawable)>(library_, "glXGetCurrentReadDrawable");
};

const XrGraphicsBindingEGLMNDX &requireComplete(const XrGraphicsBindingEGLMNDX &binding)
{
	if (!binding.display || !binding.context || !binding.getProcAddress)
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the graphics binding has a null EGLDisplay, EGLContext or getProcAddress");
	return binding;
}

/// XR_MNDX_egl_enable: a context of OpenGL or of OpenGL ES, without a surface.
class EglContext final : public GlContext
{
public:
	explicit EglContext(const XrGraphicsBindingEGLMNDX &binding)
		: display_(requireComplete(binding).display), context_(binding.context), getProcAddress_(binding.getProcAddress)
	{
		EGLint type = 0;
		if (!queryContext_(display_, context_, EGL_CONTEXT_CLIENT_TYPE, &type))
			throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the graphics binding's EGLContext is not one of its EGLDisplay");
		api_ = EGLenum(type);
	}

	Function find(const char *name) const override { return getProcAddress_(name); }

	CurrentBinding enter() const override
	{
		const EGLenum api = queryApi_();
		bindApi_(api_);
		const CurrentBinding before{getDisplay_(), uintptr_t(getSurface_(EGL_DRAW)), uintptr_t(getSurface_(EGL_READ)), getContext_(), api};
		if (before.context != context_ && !makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
			bindApi_(api);
			throw Error(XR_ERROR_RUNTIME_FAILURE, "the application's EGLContext cannot be made current: EGL error {:#x}", getError_());
		}
		return before;
	}

	void leave(const CurrentBinding &before) const override
	{
		if (before.context != context_) {
			// EGL_NO_SURFACE is null, a surface is a pointer.
			const auto draw = reinterpret_cast<EGLSurface>(before.draw); // NOLINT(performance-no-int-to-ptr)
			const auto read = reinterpret_cast<EGLSurface>(before.read); // NOLINT(performance-no-int-to-ptr)
			makeCurrent_(before.context ? before.display : display_, draw, read, before.context);
		}
		bindApi_(before.api);
	}

private:
	template <typename Pfn> Pfn egl(const char *name) const
	{
		const auto function = reinterpret_cast<Pfn>(getProcAddress_(name));
		return function ? function : found<Pfn>(opened({"libEGL.so.1"}), name);
	}

	const EGLDisplay display_;
	const EGLContext context_;
	const PFNEGLGETPROCADDRESSPROC getProcAddress_;
	EGLenum api_ = 0;
	const PFNEGLQUERYCONTEXTPROC queryContext_ = egl<PFNEGLQUERYCONTEXTPROC>("eglQueryContext");
	const PFNEGLMAKECURRENTPROC makeCurrent_ = egl<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
	const PFNEGLGETCURRENTCONTEXTPROC getContext_ = egl<PFNEGLGETCURRENTCONTEXTPROC>("eglGetCurrentContext");
	const PFNEGLGETCURRENTDISPLAYPROC getDisplay_ = egl<PFNEGLGETCURRENTDISPLAYPROC>("eglGetCurrentDisplay");
	const PFNEGLGETCURRENTSURFACEPROC getSurface_ = egl<PFNEGLGETCURRENTSURFACEPROC>("eglGetCurrentSurface");
	const PFNEGLBINDAPIPROC bindApi_ = egl<PFNEGLBINDAPIPROC>("eglBindAPI");
	const PFNEGLQUERYAPIPROC queryApi_ = egl<PFNEGLQUERYAPIPROC>("eglQueryAPI");
	const PFNEGLGETERRORPROC getError_ = egl<PFNEGLGETERRORPROC>("eglGetError");
};

} // namespace

std::unique_ptr<GlContext> glContextOf(const Instance &instance, const void *next)
{
	if (instance.has(Extension::KHR_opengl_enable))
		if (const auto *binding = findInChain<XrGraphicsBindingOpenGLXlibKHR>(next)) return std::make_unique<GlxContext>(*binding);
	if (instance.has(Extension::MNDX_egl_enable))
		if (const auto *binding = findInChain<XrGraphicsBindingEGLMNDX>(next)) return std::make_unique<EglContext>(*binding);
	return nullptr;
}

} // namespace arift::openxr
