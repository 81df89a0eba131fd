// The colour maps of a session's passthrough layers, as images for the compositor.
#pragma once
#include "runtime/compositor/compositor.h"
#include "runtime/gpu/device.h"

namespace arift
{

/// For the client's thread alone.
class PassthroughMaps
{
public:
	PassthroughMaps(std::shared_ptr<gpu::Device> device, std::shared_ptr<Compositor> compositor);
	/// Takes every map away from the compositor.
	~PassthroughMaps();
	PassthroughMaps(const PassthroughMaps &) = delete;

	/// A map of its own for a style that has one. Throws std::runtime_error where the GPU has no memory for it.
	std::optional<LayerTexture> make(const ipc::StylePassthrough &style);
	/// The layer's map before, which nothing shows any more.
	void replace(uint32_t layer, const std::optional<LayerTexture> &now);

private:
	const std::shared_ptr<gpu::Device> device_;
	const std::shared_ptr<Compositor> compositor_;
	std::array<std::optional<LayerTexture>, ipc::maxPassthroughLayers> maps_;
};

} // namespace arift
