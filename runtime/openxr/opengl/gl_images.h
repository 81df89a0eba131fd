// A swapchain's images as textures of the application's context, whatever memory lies behind them.
#pragma once
#include "runtime/openxr/opengl/gl_graphics.h"

namespace arift::openxr
{

/// A texture is bound for as long as this lives; then what was before is again.
class BoundTexture
{
public:
	BoundTexture(const GlApi &gl, GLenum target, GLuint texture);
	~BoundTexture() { gl_.BindTexture(target_, GLuint(before_)); }
	BoundTexture(const BoundTexture &) = delete;

private:
	const GlApi &gl_;
	const GLenum target_;
	GLint before_ = 0;
};

/// What the application's context was given to do until a release. Other threads may not use the context: what xrEndFrame found is what
/// they are told.
class GlWork : public Completion
{
public:
	Outcome wait(XrDuration limit) const final;
	void settle() final;
	/// Its swapchain goes: there is nothing to be found out any more. The context is current.
	void abandon();

protected:
	/// `graphics` must outlive it.
	explicit GlWork(const GlGraphics &graphics) : graphics_(graphics) {}
	/// Waits, within a limit. The context is current.
	virtual Outcome finish() = 0;
	/// The context is current.
	virtual void release() {}

	const GlGraphics &graphics_;

private:
	std::atomic<Outcome> outcome_{Outcome::notYet};
};

class GlImages : public SwapchainImages
{
public:
	void describe(std::span<XrSwapchainImageBaseHeader *const> elements) const final;
	/// Without work: the compositor was waited for by the processor, and memory is one.
	void takeOver(uint32_t) final {}
	std::shared_ptr<Completion> handOver(uint32_t image) final;
	size_t elementSize() const final { return sizeof(XrSwapchainImageOpenGLKHR); }

protected:
	/// Textures that have names and no memory yet. `graphics` must outlive it. The context is current.
	GlImages(const GlGraphics &graphics, const gpu::ImageSpec &spec, size_t count);
	/// Its textures are gone: deleteTextures() was called.
	~GlImages() override = default;
	/// For destructors: calls `release` with the context current, where it still may be used; leaves everything alone where not.
	template <typename Release> void inContext(Release release) const noexcept
	{
		if (!graphics_.mayUseContext()) return; // textures go with it
		try {
			const CurrentContext current(*graphics_.context);
			release();
		} catch (const std::exception &problem) {
			log::warning("xrDestroySwapchain: {}; its textures are left alone", problem.what());
		}
	}
	/// The context is current.
	void deleteTextures() noexcept;
	/// Throws XR_ERROR_RUNTIME_FAILURE where a bound texture has got no memory.
	void requireStorage() const;
	/// What there is to be done when an image is released. The context is current.
	virtual std::shared_ptr<GlWork> workOn(uint32_t image) = 0;

	const GlGraphics &graphics_;
	const GlApi &gl_;
	const gpu::ImageSpec spec_;
	const GLenum target_;
	const GLenum format_;
	std::vector<GLuint> textures_;

private:
	std::vector<std::shared_ptr<GlWork>> work_; ///< of each image: the last
};

} // namespace arift::openxr
