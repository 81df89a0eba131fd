#include "runtime/openxr/opengl/gl_shared_images.h"

namespace arift::openxr
{
namespace
{

/// How long xrEndFrame waits; the frame is left out after that.
constexpr XrDuration frameLimit = second;

class Fence final : public GlWork
{
public:
	/// The context is current.
	explicit Fence(const GlGraphics &graphics) : GlWork(graphics), sync_(graphics.gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}

private:
	Outcome finish() override
	{
		switch (sync_ ? graphics_.gl.ClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, uint64_t(frameLimit)) : GL_WAIT_FAILED) {
		case GL_ALREADY_SIGNALED:
		case GL_CONDITION_SATISFIED: return Outcome::done;
		case GL_TIMEOUT_EXPIRED: return Outcome::notYet;
		default: return Outcome::failed;
		}
	}
	void release() override
	{
		if (sync_) graphics_.gl.DeleteSync(sync_);
		sync_ = nullptr;
	}
	GLsync sync_;
};

} // namespace

GlSharedImages::GlSharedImages(const GlGraphics &graphics, const gpu::ImageSpec &spec, const SharedMemory &memory)
	: GlImages(graphics, spec, memory.fds.size()), memory_(memory.fds.size())
{
	try {
		graphics.sharing().CreateMemoryObjectsEXT(GLsizei(memory_.size()), memory_.data());
		for (size_t i = 0; i < memory_.size(); ++i) importMemory(i, memory.fds[i], memory.size);
	} catch (...) {
		release();
		throw;
	}
}

GlSharedImages::~GlSharedImages()
{
	inContext([this] { release(); });
}

void GlSharedImages::release() noexcept
{
	deleteTextures();
	graphics_.sharing().DeleteMemoryObjectsEXT(GLsizei(memory_.size()), memory_.data());
}

void GlSharedImages::importMemory(size_t image, UniqueFd &fd, uint64_t size)
{
	const GlSharingApi &api = graphics_.sharing();
	const GLuint memory = memory_[image];
	const GLint dedicated = GL_TRUE;
	api.MemoryObjectParameterivEXT(memory, GL_DEDICATED_MEMORY_OBJECT_EXT, &dedicated);
	api.ImportMemoryFdEXT(memory, size, GL_HANDLE_TYPE_OPAQUE_FD_EXT, fd.get());
	fd.release(); // GL's now
	const BoundTexture bound(gl_, target_, textures_[image]);
	if (spec_.inRows) gl_.TexParameteri(target_, GL_TEXTURE_TILING_EXT, GL_LINEAR_TILING_EXT);
	const auto levels = GLsizei(spec_.mipLevels), width = GLsizei(spec_.width), height = GLsizei(spec_.height);
	if (target_ == GL_TEXTURE_2D_ARRAY)
		api.TexStorageMem3DEXT(target_, levels, format_, width, height, GLsizei(spec_.arrayLayers), memory, 0);
	else
		api.TexStorageMem2DEXT(target_, levels, format_, width, height, memory, 0);
	requireStorage();
}

std::shared_ptr<GlWork> GlSharedImages::workOn(uint32_t) { return std::make_shared<Fence>(graphics_); }

} // namespace arift::openxr
