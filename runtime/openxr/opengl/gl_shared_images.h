// Images in the service's memory, imported: GL_EXT_memory_object_fd.
#pragma once
#include "runtime/openxr/opengl/gl_images.h"

namespace arift::openxr
{

class GlSharedImages final : public GlImages
{
public:
	/// In xrCreateSwapchain, the context current. Throws XR_ERROR_RUNTIME_FAILURE where this driver cannot import what the service's
	/// exported.
	GlSharedImages(const GlGraphics &graphics, const gpu::ImageSpec &spec, const SharedMemory &memory);
	~GlSharedImages() override;

private:
	std::shared_ptr<GlWork> workOn(uint32_t image) override;
	void importMemory(size_t image, UniqueFd &fd, uint64_t size);
	void release() noexcept;

	std::vector<GLuint> memory_; ///< memory objects
};

} // namespace arift::openxr
