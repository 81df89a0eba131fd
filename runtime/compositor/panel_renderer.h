// Turns PanelInputs into one panel image on the GPU: camera images, layers, timewarp per line, lens and chromatic correction, one pass.
#pragma once
#include "runtime/compositor/panel_inputs.h"
#include "runtime/gpu/image_spec.h"
#include <memory>
#include <span>

namespace arift
{

struct Rig;
namespace gpu
{
class Device;
}

/// One rendered panel or eye image read back: rows of RGBA8 (sRGB encoded) or RGBA16 (linear) as the renderer's format says.
struct ReadbackImage {
	uint32_t width = 0, height = 0;
	VkFormat format = VK_FORMAT_UNDEFINED;
	std::vector<std::byte> pixels;
};

/// What becomes of a layer whose pipeline is not made yet, because it is drawn in a way that is not usual: the image is late, or is shown
/// without it.
enum class Unready { waitedFor, leftOut };

/// Thread-bound.
class PanelRenderer
{
public:
	/// `format` of the panel image: VK_FORMAT_R8G8B8A8_SRGB, or VK_FORMAT_R16G16B16A16_UNORM (linear light) for measurements.
	PanelRenderer(gpu::Device &device, const Rig &rig, VkFormat format = VK_FORMAT_R8G8B8A8_SRGB, Unready unready = Unready::waitedFor);
	~PanelRenderer();

	/// Makes the usual pipelines and draws with each once: software renderers compile when they first draw with a kind of texture, which
	/// costs a frame.
	/// What is rarer (layers that are not sRGB encoded or not 8-bit RGBA, deep, tested, or keyed out with an alpha of their own, cameras of
	/// encoded values, eyes without the lens) is left out.
	void warmUp();

	/// An application's image. It must be in its boundary layout, owned by VK_QUEUE_FAMILY_EXTERNAL, whenever render() is given it.
	/// Where a CPU finds its texels in `rows`, parts without content are left out.
	void addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec, const gpu::ImageRows &rows = {});
	void removeImage(uint64_t key);

	/// Draws and waits until the GPU is done (bounded by gpu::Device::Handles::patience: throws std::runtime_error). The result stays in
	/// image().
	void render(const PanelInputs &inputs);

	/// Real time that the last render took, seconds: what is drawn where, camera images copied, commands recorded, the GPU waited for.
	struct Cost {
		double plan = 0, upload = 0, record = 0, wait = 0;
		uint32_t leftOut = 0; ///< rectangles' draws that wait for their pipelines
	};
	Cost cost() const;

	/// The panel image; layout TRANSFER_SRC_OPTIMAL after render(). For targets (window, offscreen).
	VkImage image() const;
	VkExtent2D extent() const;
	ReadbackImage readPanel();
	/// Both eyes side by side before the lens correction, drawn from the inputs of the last render() at the default field of view.
	ReadbackImage renderEyes(const PanelInputs &inputs);

private:
	struct Implementation;
	std::unique_ptr<Implementation> implementation_;
};

} // namespace arift
