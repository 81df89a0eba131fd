#include "tools/arift/png_file.h"
#include "runtime/base/error.h"
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <png.h>
#include <vector>

namespace arift::tools
{

namespace
{

struct CloseFile {
	void operator()(std::FILE *file) const { std::fclose(file); }
};

/// libpng leaves by longjmp on errors: nothing here may need a destructor.
bool encode(std::FILE *file, uint32_t width, uint32_t height, png_bytepp rows)
{
	png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
	png_infop info = png ? png_create_info_struct(png) : nullptr;
	if (!info || setjmp(png_jmpbuf(png))) {
		png_destroy_write_struct(&png, &info);
		return false;
	}
	png_init_io(png, file);
	png_set_compression_level(png, 4);
	png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
				 PNG_FILTER_TYPE_DEFAULT);
	png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
	png_write_info(png, info);
	png_set_filler(png, 0, PNG_FILLER_AFTER);
	png_write_image(png, rows);
	png_write_end(png, nullptr);
	png_destroy_write_struct(&png, &info);
	return true;
}

} // namespace

void writePng(const std::filesystem::path &path, uint32_t width, uint32_t height, std::span<const std::byte> pixels)
{
	const std::filesystem::path partial = path.string() + ".part";
	std::unique_ptr<std::FILE, CloseFile> file(std::fopen(partial.c_str(), "wb"));
	if (!file) throw InputError("{}: cannot be written: {}", partial.string(), std::strerror(errno));
	std::vector<png_bytep> rows(height);
	for (uint32_t y = 0; y < height; ++y)
		rows[y] = reinterpret_cast<png_bytep>(const_cast<std::byte *>(pixels.data() + size_t(y) * width * 4));
	const bool encoded = encode(file.get(), width, height, rows.data());
	const bool written = std::fclose(file.release()) == 0;
	std::error_code problem;
	if (encoded && written) std::filesystem::rename(partial, path, problem);
	if (encoded && written && !problem) return;
	std::error_code ignored;
	std::filesystem::remove(partial, ignored);
	throw InputError("{}: cannot be written{}{}", path.string(), problem ? ": " : "", problem ? problem.message() : "");
}

} // namespace arift::tools
