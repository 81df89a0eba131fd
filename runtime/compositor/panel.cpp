#include "runtime/compositor/panel.h"

namespace arift
{

namespace
{

class GpuPanel final : public Panel
{
public:
	GpuPanel(PanelRenderer &renderer, std::unique_ptr<Target> target) : renderer_(renderer), target_(std::move(target)) {}

	void addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec) override { renderer_.addImage(key, image, spec); }
	void removeImage(uint64_t key) override { renderer_.removeImage(key); }
	void render(const PanelInputs &inputs) override { renderer_.render(inputs); }
	Target::Result present(const Pacer::Refresh &refresh) override
	{
		return target_->present(renderer_.image(), renderer_.extent(), refresh);
	}
	ReadbackImage readPanel() override { return renderer_.readPanel(); }
	ReadbackImage renderEyes(const PanelInputs &inputs) override { return renderer_.renderEyes(inputs); }

private:
	PanelRenderer &renderer_;
	std::unique_ptr<Target> target_;
};

} // namespace

std::unique_ptr<Panel> makePanel(PanelRenderer &renderer, std::unique_ptr<Target> target)
{
	return std::make_unique<GpuPanel>(renderer, std::move(target));
}

} // namespace arift
