// A client's swapchains: their images on the service's GPU, and what submissions are checked against.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/gpu/device.h"
#include "runtime/service/decode.h"
#include <map>
#include <memory>
#include <vector>

namespace arift
{

class Compositor;
class CopiedImages;

/// An image's key for the renderer. Swapchain numbers are never used twice while the service lives, so neither are keys.
constexpr uint64_t imageKey(uint32_t swapchain, uint32_t image) { return uint64_t(swapchain) * ipc::maxImages + image; }

/// Thread-safe: the client's thread makes and destroys, its frame channel's thread finds and fetches, anybody's describes.
class Swapchains
{
public:
	explicit Swapchains(std::shared_ptr<Compositor> compositor) : compositor_(std::move(compositor)) {}
	/// Takes every image away from the compositor.
	~Swapchains();
	Swapchains(const Swapchains &) = delete;

	/// Images all like `spec`, cleared, told to the compositor; one descriptor each, of memory as `sharing` has it. Throws ipc-level
	/// refusals as Refused.
	struct Made {
		uint32_t swapchain = 0;
		uint64_t memorySize = 0;
		uint32_t memoryTypeIndex = 0;
		std::vector<UniqueFd> memory;
	};
	Made make(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount, ipc::Sharing sharing);
	/// Says whether there was such a swapchain.
	bool destroy(uint32_t swapchain);
	void destroyAll();
	/// Also of one destroyed not long ago: a submission in the frame channel may be overtaken by the request that destroys what it shows.
	/// The compositor leaves such layers out.
	std::optional<SwapchainShape> find(uint32_t swapchain);
	/// Brings in what the application has drawn of the images that a checked submission shows, where they are copied. For the frame
	/// channel's thread alone. Throws std::runtime_error where the GPU is lost.
	void fetch(const ipc::Submission &submission);
	uint64_t bytes();
	/// What people want to know of each.
	struct About {
		gpu::ImageSpec spec;
		uint32_t imageCount = 0;
		ipc::Sharing sharing = ipc::Sharing::memory;
	};
	std::vector<About> abouts();

private:
	struct Swapchain {
		About about;
		uint64_t bytes = 0;
		std::shared_ptr<CopiedImages> copies; ///< null where memory is shared
		SwapchainShape shape() const;
	};
	Made share(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount);
	Made copy(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount);
	void requireQuota(uint64_t bytes);
	void fetch(const ipc::SubImage &image);
	void tellCompositor(uint32_t swapchain, uint32_t image, const std::shared_ptr<gpu::SharedImage> &shared);
	const std::shared_ptr<Compositor> compositor_;
	Guarded<std::map<uint32_t, Swapchain>> swapchains_;
	Guarded<std::map<uint32_t, SwapchainShape>> destroyed_; ///< the last ones
};

/// A request that is understood and cannot be met: its result and sentence go back to the client, which stays connected.
struct Refused : std::runtime_error {
	Refused(XrResult code, const std::string &text) : std::runtime_error(text), result(code) {}
	XrResult result;
};

} // namespace arift
