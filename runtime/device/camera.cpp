#include "runtime/device/camera.h"
#include <vector>

namespace arift
{

namespace
{

class HostFrameBuffer final : public FrameBuffer
{
public:
	explicit HostFrameBuffer(size_t bytes) : bytes_(bytes) {}
	std::span<std::byte> bytes() override { return bytes_; }

private:
	std::vector<std::byte> bytes_;
};

} // namespace

std::shared_ptr<FrameBuffer> makeHostFrameBuffer(size_t bytes) { return std::make_shared<HostFrameBuffer>(bytes); }

} // namespace arift
