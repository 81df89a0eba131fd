#include "runtime/compositor/panel.h"
#include "runtime/base/log.h"

namespace arift
{

namespace
{

class GpuPanel final : public Panel
{
public:
	GpuPanel(PanelRenderer &renderer, std::unique_ptr<Target> target, std::unique_ptr<Target> spare)
		: renderer_(renderer), target_(std::move(target)), spare_(std::move(spare))
	{
	}

	void addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec, const gpu::ImageRows &rows) override
	{
		renderer_.addImage(key, image, spec, rows);
	}
	void removeImage(uint64_t key) override { renderer_.removeImage(key); }
	void render(const PanelInputs &inputs) override { renderer_.render(inputs); }
	PanelRenderer::Cost cost() const override { return renderer_.cost(); }
	Target::Result present(const Pacer::Refresh &refresh) override
	{
		const Target::Result result = target_->present(renderer_.image(), renderer_.extent(), refresh);
		if (result.outcome != Presented::gone || !spare_) return result;
		log::warning("the {} has gone: images are composed {} from here on", target_->name(), spare_->name());
		target_ = std::move(spare_);
		return target_->present(renderer_.image(), renderer_.extent(), refresh);
	}
	ReadbackImage readPanel() override { return renderer_.readPanel(); }
	ReadbackImage renderEyes(const PanelInputs &inputs) override { return renderer_.renderEyes(inputs); }

private:
	PanelRenderer &renderer_;
	std::unique_ptr<Target> target_, spare_;
};

} // namespace

std::unique_ptr<Panel> makePanel(PanelRenderer &renderer, std::unique_ptr<Target> target, std::unique_ptr<Target> spare)
{
	return std::make_unique<GpuPanel>(renderer, std::move(target), std::move(spare));
}

} // namespace arift
