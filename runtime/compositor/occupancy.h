// Where an application's image has content: most of an augmented-reality picture is transparent black, and asking it costs as much as
// asking for content; where it is opaque, nothing behind it need be asked. Looked at by the CPU, where the image lies in memory in rows
// (gpu::ImageRows), once per submission, block by block, and only where it is about to be shown. Not thread-safe.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace arift
{

/// Texels, x1 and y1 excluded.
struct TexelRect {
	int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Of a part of a layer's image. Opaque: every texel's alpha is full.
enum class Content : uint8_t { none, some, opaque };

class Occupancy
{
public:
	/// Texels of one block in each direction: the texels in it count for all.
	static constexpr int block = 32;
	/// `first`: the first texel's first byte. It is read by contentOf() alone. `alphaLast`: the fourth of a texel's four bytes is its
	/// alpha.
	struct Texels {
		const std::byte *first = nullptr;
		size_t rowPitch = 0, bytesPerTexel = 0;
		bool alphaLast = false;
		uint32_t width = 0, height = 0;
	};
	explicit Occupancy(const Texels &texels);

	/// What any texel in `rect` may show; what lies beside the image is left out. Never `none` or `opaque` in error.
	Content contentOf(const TexelRect &rect);
	/// The image has been drawn anew.
	void forget();
	/// Blocks looked at since the last forget().
	size_t examined() const { return examined_; }

private:
	std::optional<Content> &known(int column, int row) { return blocks_[size_t(row) * size_t(columns_) + size_t(column)]; }
	Content examine(int column, int row) const;

	Texels texels_;
	int width_, height_, columns_;
	std::vector<std::optional<Content>> blocks_;
	size_t examined_ = 0;
};

} // namespace arift
