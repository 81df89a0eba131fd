// What draws panel images and shows them, as the compositor's thread sees it.
#pragma once
#include "runtime/compositor/panel_renderer.h"
#include "runtime/compositor/target.h"

namespace arift
{

/// Thread-bound to the compositor's thread. Every call may throw std::runtime_error when the GPU is lost.
class Panel
{
public:
	virtual ~Panel() = default;
	virtual void addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec, const gpu::ImageRows &rows) = 0;
	virtual void removeImage(uint64_t key) = 0;
	/// Draws, and waits until the image is finished.
	virtual void render(const PanelInputs &inputs) = 0;
	/// Of the last render.
	virtual PanelRenderer::Cost cost() const { return {}; }
	/// Shows the image just drawn.
	virtual Target::Result present(const Pacer::Refresh &refresh) = 0;
	virtual ReadbackImage readPanel() = 0;
	virtual ReadbackImage renderEyes(const PanelInputs &inputs) = 0;
};

/// `renderer` must outlive it. `spare` takes the place of a target that has gone.
std::unique_ptr<Panel> makePanel(PanelRenderer &renderer, std::unique_ptr<Target> target, std::unique_ptr<Target> spare);

} // namespace arift
