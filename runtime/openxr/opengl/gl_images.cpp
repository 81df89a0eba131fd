#include "runtime/openxr/opengl/gl_images.h"
#include "runtime/openxr/opengl/gl_formats.h"
#include <thread>

namespace arift::openxr
{
namespace
{

GLenum targetOf(const gpu::ImageSpec &spec)
{
	if (spec.createFlags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) return GL_TEXTURE_CUBE_MAP;
	return spec.arrayLayers > 1 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
}

GLenum bindingOf(GLenum target)
{
	switch (target) {
	case GL_TEXTURE_CUBE_MAP: return GL_TEXTURE_BINDING_CUBE_MAP;
	case GL_TEXTURE_2D_ARRAY: return GL_TEXTURE_BINDING_2D_ARRAY;
	default: return GL_TEXTURE_BINDING_2D;
	}
}

} // namespace

BoundTexture::BoundTexture(const GlApi &gl, GLenum target, GLuint texture) : gl_(gl), target_(target)
{
	gl_.GetIntegerv(bindingOf(target), &before_);
	gl_.BindTexture(target, texture);
}

void GlWork::settle()
{
	if (outcome_.load(std::memory_order_relaxed) != Outcome::notYet) return;
	const CurrentContext current(*graphics_.context);
	outcome_.store(finish(), std::memory_order_release);
}

Completion::Outcome GlWork::wait(XrDuration limit) const
{
	Outcome outcome = outcome_.load(std::memory_order_acquire);
	for (const XrTime end = realTime() + limit; outcome == Outcome::notYet && realTime() < end;
		 outcome = outcome_.load(std::memory_order_acquire))
		std::this_thread::sleep_for(std::chrono::milliseconds(1)); // another xrEndFrame may find it finished
	return outcome;
}

void GlWork::abandon()
{
	Outcome pending = Outcome::notYet;
	outcome_.compare_exchange_strong(pending, Outcome::failed);
	release();
}

GlImages::GlImages(const GlGraphics &graphics, const gpu::ImageSpec &spec, size_t count)
	: graphics_(graphics),
	  gl_(graphics.gl),
	  spec_(spec),
	  target_(targetOf(spec)),
	  format_(glFormatOf(spec.format)),
	  textures_(count),
	  work_(count)
{
	gl_.GenTextures(GLsizei(count), textures_.data());
}

void GlImages::deleteTextures() noexcept
{
	for (const std::shared_ptr<GlWork> &work : work_)
		if (work) work->abandon();
	gl_.DeleteTextures(GLsizei(textures_.size()), textures_.data());
}

void GlImages::requireStorage() const
{
	GLint isThere = GL_FALSE;
	gl_.GetTexParameteriv(target_, GL_TEXTURE_IMMUTABLE_FORMAT, &isThere);
	// glGetError is asked only where something has failed: an error before may be the application's, who wants to hear of it.
	if (!isThere)
		throw Error(XR_ERROR_RUNTIME_FAILURE, "the application's GL makes no texture of {}x{}, internal format {:#x}: GL error {:#x}",
					spec_.width, spec_.height, format_, gl_.GetError());
}

void GlImages::describe(std::span<XrSwapchainImageBaseHeader *const> elements) const
{
	// XrSwapchainImageOpenGLESKHR differs in its type alone.
	const XrStructureType type = graphics_.isEs() ? XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR : XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR;
	for (const XrSwapchainImageBaseHeader *element : elements)
		if (element->type != type)
			throw Error(XR_ERROR_VALIDATION_FAILURE, "an element's type is {}, not {}", int(element->type), nameOf(type));
	for (size_t i = 0; i < elements.size(); ++i) reinterpret_cast<XrSwapchainImageOpenGLKHR *>(elements[i])->image = textures_[i];
}

std::shared_ptr<Completion> GlImages::handOver(uint32_t index)
{
	const CurrentContext current(*graphics_.context);
	if (work_[index]) work_[index]->abandon();
	work_[index] = workOn(index);
	gl_.Flush();
	return work_[index];
}

} // namespace arift::openxr
