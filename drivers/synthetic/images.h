// The simulated cameras as a source of images: when each is exposed and arrives, and what it shows.
#pragma once
#include "drivers/played_camera.h"
#include "drivers/synthetic/renderer.h"
#include "drivers/synthetic/settings.h"
#include "drivers/synthetic/world.h"

namespace arift::synthetic
{

class SyntheticImages final : public ImageSource
{
public:
	/// `eye` 0 left, 1 right. Exposures are centred at world.start + (k + phase) / cameraRate.
	SyntheticImages(std::shared_ptr<const World> world, std::shared_ptr<const Scene> scene, const Settings &settings,
					CameraGeometry geometry, uint32_t eye);

	CameraInfo info() const override { return info_; }
	std::optional<Timing> timing(uint64_t sequence) const override;
	bool make(uint64_t sequence, std::span<std::byte> pixels) override;

private:
	XrTime midExposure(uint64_t sequence) const;

	const std::shared_ptr<const World> world_;
	CameraInfo info_;
	double phase_ = 0;
	XrDuration exposure_, transferDelay_, jitter_;
	uint64_t seed_;
	Renderer renderer_;
};

} // namespace arift::synthetic
