// An OpenGL or OpenGL ES application without a window: EGL's surfaceless platform, a context, and the binding of XR_MNDX_egl_enable.
#pragma once
#include "runtime/openxr/api.h"
#include <GL/gl.h>
#include <GL/glext.h>
#include <array>

namespace arift
{

/// A context; current in the thread that made it until something else is. Destroyed with its display's connection left open: other contexts
/// of the process share it.
class GlApplication
{
public:
	enum class Api { openGl, openGlEs };
	/// Throws std::runtime_error where EGL has no such context.
	explicit GlApplication(Api api);
	~GlApplication();
	GlApplication(const GlApplication &) = delete;

	void makeCurrent() const;
	static void makeNoneCurrent();
	static EGLContext current() { return ::eglGetCurrentContext(); }
	/// Fills the lower half of a texture's array layer with `lower`, the rest with `upper`: red, green, blue, alpha.
	void fill(GLuint texture, GLenum target, int layer, int width, int height, const std::array<float, 4> &lower,
			  const std::array<float, 4> &upper) const;

	template <typename Pfn> static Pfn get(const char *name) { return reinterpret_cast<Pfn>(::eglGetProcAddress(name)); }

	const Api api;
	XrGraphicsBindingEGLMNDX binding{XR_TYPE_GRAPHICS_BINDING_EGL_MNDX};

private:
	EGLDisplay display_;
	EGLContext context_;
};

} // namespace arift
