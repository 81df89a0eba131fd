// The application's GL context, as GLX or EGL knows it.
#pragma once
#include "runtime/openxr/instance.h"
#include <memory>

namespace arift::openxr
{

/// What a thread has current: enough to bring it back.
struct CurrentBinding {
	void *display = nullptr;
	uintptr_t draw = 0, read = 0; ///< GLXDrawable or EGLSurface
	void *context = nullptr;      ///< null: none
	unsigned api = 0;             ///< EGL's rendering API of the thread
};

class GlContext
{
public:
	using Function = void (*)();

	virtual ~GlContext() = default;
	/// A function of GL; null where the application's GL has none of that name.
	virtual Function find(const char *name) const = 0;
	/// Makes the context the calling thread's; returns what was.
	virtual CurrentBinding enter() const = 0;
	/// Undoes enter().
	virtual void leave(const CurrentBinding &before) const = 0;
};

/// The application's context is the calling thread's for as long as this lives.
class CurrentContext
{
public:
	/// Throws XR_ERROR_RUNTIME_FAILURE where the context cannot be made current.
	explicit CurrentContext(const GlContext &context) : context_(context), before_(context.enter()) {}
	~CurrentContext() { context_.leave(before_); }
	CurrentContext(const CurrentContext &) = delete;

private:
	const GlContext &context_;
	const CurrentBinding before_;
};

/// The context of the graphics binding in the chain of XrSessionCreateInfo; null where no enabled extension's binding is there.
/// Throws XR_ERROR_GRAPHICS_DEVICE_INVALID for one that holds nothing.
std::unique_ptr<GlContext> glContextOf(const Instance &instance, const void *next);

} // namespace arift::openxr
