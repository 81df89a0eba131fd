#include "runtime/compositor/target.h"

namespace arift
{

namespace
{

class OffscreenTarget final : public Target
{
public:
	OffscreenTarget(const Clock &clock, XrDuration period) : clock_(clock), period_(period) {}

	Result present(VkImage, VkExtent2D, const Pacer::Refresh &refresh) override
	{
		const XrDuration late = clock_.now() - refresh.vblank;
		const XrDuration refreshesLate = late <= 0 ? 0 : (late + period_ - 1) / period_;
		return {Presented::shown, refresh.display + refreshesLate * period_};
	}
	std::string name() const override { return "offscreen"; }

private:
	const Clock &clock_;
	XrDuration period_;
};

} // namespace

std::unique_ptr<Target> makeOffscreenTarget(const Clock &clock, XrDuration period)
{
	return std::make_unique<OffscreenTarget>(clock, period);
}

} // namespace arift
