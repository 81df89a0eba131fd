#include "runtime/openxr/opengl/gl_copied_images.h"
#include "runtime/openxr/opengl/gl_formats.h"

namespace arift::openxr
{
namespace
{

/// What glReadPixels depends on, as reading whole images needs it; then as it was.
class PlainReading
{
public:
	PlainReading(const GlApi &gl, GLuint framebuffer, bool isEs) : gl_(gl), count_(settings.size() - (isEs ? 1 : 0))
	{
		for (size_t i = 0; i < count_; ++i) {
			gl_.GetIntegerv(settings[i], &before_[i]);
			gl_.PixelStorei(settings[i], settings[i] == GL_PACK_ALIGNMENT ? 1 : 0);
		}
		gl_.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer_);
		gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
		gl_.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &framebuffer_);
		gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
	}
	~PlainReading()
	{
		gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(framebuffer_));
		gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(buffer_));
		for (size_t i = 0; i < count_; ++i) gl_.PixelStorei(settings[i], before_[i]);
	}
	PlainReading(const PlainReading &) = delete;

private:
	/// The last is OpenGL's alone.
	static constexpr std::array<GLenum, 5> settings{GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
													GL_PACK_SWAP_BYTES};
	const GlApi &gl_;
	const size_t count_;
	std::array<GLint, settings.size()> before_{};
	GLint buffer_ = 0, framebuffer_ = 0;
};

} // namespace

class GlCopiedImages::ReadBack final : public GlWork
{
public:
	ReadBack(const GlCopiedImages &images, uint32_t image) : GlWork(images.graphics_), images_(images), image_(image) {}

private:
	Outcome finish() override
	{
		images_.read(image_);
		return Outcome::done;
	}
	const GlCopiedImages &images_; ///< whose swapchain waits for its last submission before it goes
	const uint32_t image_;
};

GlCopiedImages::GlCopiedImages(const GlGraphics &graphics, const gpu::ImageSpec &spec, const SharedMemory &memory)
	: GlImages(graphics, spec, memory.fds.size())
{
	try {
		if (memory.size != gpu::copyLayoutOf(spec).size)
			throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service sent {} bytes for an image of {}", memory.size,
						gpu::copyLayoutOf(spec).size);
		for (size_t i = 0; i < textures_.size(); ++i) {
			memory_.push_back(ipc::mapWritable(memory.fds[i].get(), memory.size));
			memory.fds[i] = UniqueFd(); // mapped by now
			allocate(i);
		}
		gl_.GenFramebuffers(1, &framebuffer_);
		requireReadable();
	} catch (...) {
		release();
		throw;
	}
}

GlCopiedImages::~GlCopiedImages()
{
	inContext([this] { release(); });
}

void GlCopiedImages::release() noexcept
{
	deleteTextures();
	gl_.DeleteFramebuffers(1, &framebuffer_);
}

void GlCopiedImages::allocate(size_t image)
{
	const BoundTexture bound(gl_, target_, textures_[image]);
	const auto levels = GLsizei(spec_.mipLevels), width = GLsizei(spec_.width), height = GLsizei(spec_.height);
	if (target_ == GL_TEXTURE_2D_ARRAY)
		gl_.TexStorage3D(target_, levels, format_, width, height, GLsizei(spec_.arrayLayers));
	else
		gl_.TexStorage2D(target_, levels, format_, width, height);
	requireStorage();
}

void GlCopiedImages::attach(uint32_t image, uint32_t layer) const
{
	if (target_ == GL_TEXTURE_2D_ARRAY)
		gl_.FramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, textures_[image], 0, GLint(layer));
	else
		gl_.FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
								 target_ == GL_TEXTURE_CUBE_MAP ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + layer : target_, textures_[image], 0);
}

void GlCopiedImages::requireReadable() const
{
	if (gpu::isDepth(VkFormat(spec_.format))) return;
	const PlainReading plain(gl_, framebuffer_, graphics_.isEs());
	attach(0, 0);
	const auto wanted = GLint(transferOf(spec_.format).type);
	GLint type = wanted;
	// OpenGL ES reads bytes, packed tens and, beyond that, one type of its own choice.
	if (graphics_.isEs() && type == GL_HALF_FLOAT) gl_.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_TYPE, &type);
	if (gl_.CheckFramebufferStatus(GL_READ_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || type != wanted)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "the application's GL cannot read images of the internal format {:#x} back", format_);
}

void GlCopiedImages::read(uint32_t image) const
{
	if (gpu::isDepth(VkFormat(spec_.format))) return; // OpenGL ES cannot read it: GlGraphics::copiesDepth()
	const PlainReading plain(gl_, framebuffer_, graphics_.isEs());
	const gpu::CopyLayout layout = gpu::copyLayoutOf(spec_);
	const GlTransfer transfer = transferOf(spec_.format);
	for (uint32_t layer = 0; layer < spec_.arrayLayers; ++layer) {
		attach(image, layer);
		gl_.ReadPixels(0, 0, GLsizei(spec_.width), GLsizei(spec_.height), transfer.format, transfer.type,
					   static_cast<std::byte *>(memory_[image].address()) + layer * layout.layerPitch);
	}
}

std::shared_ptr<GlWork> GlCopiedImages::workOn(uint32_t image) { return std::make_shared<ReadBack>(*this, image); }

} // namespace arift::openxr
