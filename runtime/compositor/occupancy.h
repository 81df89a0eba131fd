// Where an application's image has content: most of an augmented-reality picture is transparent black, and asking it costs as much as
// asking for content. Looked at by the CPU, where the image lies in memory in rows (gpu::ImageRows), once per submission, block by block,
// and only where it is about to be shown. Not thread-safe.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace arift
{

/// Texels, x1 and y1 excluded.
struct TexelRect {
	int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

class Occupancy
{
public:
	/// Texels of one block in each direction: a texel in it that is not zero counts for all.
	static constexpr int block = 32;
	/// `first`: the first texel's first byte. It is read by mayHaveContent() alone.
	Occupancy(const std::byte *first, size_t rowPitch, size_t bytesPerTexel, uint32_t width, uint32_t height);

	/// Whether any byte of a texel in `rect` may be other than zero. Never false in error.
	bool mayHaveContent(const TexelRect &rect);
	/// The image has been drawn anew.
	void forget();
	/// Blocks looked at since the last forget().
	size_t examined() const { return examined_; }

private:
	enum class Known : uint8_t { nothing, empty, occupied };
	bool isEmpty(int column, int row) const;

	const std::byte *first_;
	size_t rowPitch_, bytesPerTexel_;
	int width_, height_, columns_;
	std::vector<Known> blocks_;
	size_t examined_ = 0;
};

} // namespace arift
