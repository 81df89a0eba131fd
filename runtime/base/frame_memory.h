// Memory for what lives no longer than one turn of a loop: handed out from one block step by step and given back as a whole, so that a
// loop that must not wait for anybody waits for no allocator either.
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

namespace arift
{

/// One loop's, on one thread. A turn that needs more than there is takes the rest from the heap, and finds enough the next time.
class FrameMemory
{
public:
	explicit FrameMemory(size_t bytes) : block_(std::make_unique<std::byte[]>(bytes)), size_(bytes) {}

	/// While it lives, FrameVectors of this thread allocate from `memory`. What they made must be gone before it ends.
	class Turn
	{
	public:
		explicit Turn(FrameMemory &memory);
		~Turn();
		Turn(const Turn &) = delete;

	private:
		FrameMemory *const before_;
	};

	/// From the heap where no Turn is under way on this thread. Aligned for every type that needs no more than std::max_align_t.
	static void *allocate(size_t bytes);
	static void release(void *memory) noexcept;

private:
	std::byte *take(size_t bytes);
	bool owns(const void *memory) const;

	std::unique_ptr<std::byte[]> block_;
	size_t size_, used_ = 0, wanted_ = 0; ///< wanted: what this turn would have used
	static thread_local FrameMemory *current_;
};

template <typename T> struct FrameMemoryAllocator {
	using value_type = T;
	FrameMemoryAllocator() = default;
	template <typename U> FrameMemoryAllocator(const FrameMemoryAllocator<U> &) {
	} // NOLINT(google-explicit-constructor): allocators convert
	T *allocate(size_t count)
	{
		static_assert(alignof(T) <= alignof(std::max_align_t));
		return static_cast<T *>(FrameMemory::allocate(count * sizeof(T))); // NOLINT(bugprone-sizeof-expression): T may be a pointer
	}
	void deallocate(T *memory, size_t) noexcept { FrameMemory::release(memory); }
	friend bool operator==(const FrameMemoryAllocator &, const FrameMemoryAllocator &) { return true; }
};
template <typename T> using FrameVector = std::vector<T, FrameMemoryAllocator<T>>;

} // namespace arift
