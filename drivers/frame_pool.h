// A camera's ring of buffers: lends one per image and takes it back when the last copy of the frame is gone.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/device/camera.h"
#include <vector>

namespace arift
{

class FramePool
{
public:
	FramePool(const FrameAllocator &allocate, size_t count, size_t bytesEach) : ring_(std::make_shared<Guarded<Ring>>())
	{
		ring_->update([&](Ring &ring) {
			for (size_t i = 0; i < count; i++) ring.idle.push_back(ring.buffers.emplace_back(allocate(bytesEach)).get());
		});
	}

	/// A buffer nobody reads; null when the consumer holds them all. What is lent outlives the pool. Thread-safe.
	std::shared_ptr<FrameBuffer> lend()
	{
		FrameBuffer *buffer = nullptr;
		ring_->update([&](Ring &ring) {
			if (ring.idle.empty()) return;
			buffer = ring.idle.front(); // the one that has rested longest
			ring.idle.erase(ring.idle.begin());
		});
		if (!buffer) return nullptr;
		return {buffer, [ring = ring_](FrameBuffer *back) { ring->update([&](Ring &r) { r.idle.push_back(back); }); }};
	}

private:
	struct Ring {
		std::vector<std::shared_ptr<FrameBuffer>> buffers;
		std::vector<FrameBuffer *> idle;
	};
	std::shared_ptr<Guarded<Ring>> ring_;
};

} // namespace arift
