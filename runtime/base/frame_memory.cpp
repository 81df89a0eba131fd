#include "runtime/base/frame_memory.h"
#include <functional>
#include <new>

namespace arift
{

thread_local FrameMemory *FrameMemory::current_ = nullptr;

FrameMemory::Turn::Turn(FrameMemory &memory) : before_(current_)
{
	if (memory.wanted_ > memory.size_) {
		memory.size_ = 2 * memory.wanted_;
		memory.block_ = std::make_unique<std::byte[]>(memory.size_);
	}
	memory.used_ = memory.wanted_ = 0;
	current_ = &memory;
}

FrameMemory::Turn::~Turn() { current_ = before_; }

std::byte *FrameMemory::take(size_t bytes)
{
	constexpr size_t alignment = alignof(std::max_align_t);
	const size_t rounded = (bytes + alignment - 1) / alignment * alignment;
	wanted_ += rounded;
	if (rounded > size_ - used_) return nullptr;
	std::byte *const taken = block_.get() + used_;
	used_ += rounded;
	return taken;
}

bool FrameMemory::owns(const void *memory) const
{
	const auto *const byte = static_cast<const std::byte *>(memory);
	return !std::less<>()(byte, block_.get()) && std::less<>()(byte, block_.get() + size_);
}

void *FrameMemory::allocate(size_t bytes)
{
	if (current_)
		if (void *const taken = current_->take(bytes)) return taken;
	return ::operator new(bytes);
}

void FrameMemory::release(void *memory) noexcept
{
	if (current_ && current_->owns(memory)) return;
	::operator delete(memory);
}

} // namespace arift
