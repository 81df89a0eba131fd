// Images of the application's own, read back into memory that the service can read: where GL cannot share memory with the service's GPU.
#pragma once
#include "runtime/ipc/shared_memory.h"
#include "runtime/openxr/opengl/gl_images.h"

namespace arift::openxr
{

class GlCopiedImages final : public GlImages
{
public:
	/// In xrCreateSwapchain, the context current. Throws XR_ERROR_RUNTIME_FAILURE or XR_ERROR_FEATURE_UNSUPPORTED where GL makes
	/// no such texture, or does not read it.
	GlCopiedImages(const GlGraphics &graphics, const gpu::ImageSpec &spec, const SharedMemory &memory);
	~GlCopiedImages() override;

private:
	class ReadBack;
	std::shared_ptr<GlWork> workOn(uint32_t image) override;
	void allocate(size_t image);
	/// To the framebuffer that is bound for reading.
	void attach(uint32_t image, uint32_t layer) const;
	/// Throws XR_ERROR_FEATURE_UNSUPPORTED where GL would not read what it has drawn.
	void requireReadable() const;
	/// In xrEndFrame, the context current: an image that was released is the runtime's to read.
	void read(uint32_t image) const;
	void release() noexcept;

	std::vector<ipc::Mapping> memory_;
	GLuint framebuffer_ = 0;
};

} // namespace arift::openxr
