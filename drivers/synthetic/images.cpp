#include "drivers/synthetic/images.h"
#include "runtime/base/error.h"
#include <random>

namespace arift::synthetic
{

SyntheticImages::SyntheticImages(std::shared_ptr<const World> world, std::shared_ptr<const Scene> scene, const Settings &settings,
								 CameraGeometry geometry, uint32_t eye)
	: world_(std::move(world)),
	  info_{.name = fmt::format("Synthetic {} camera", eye == 0 ? "left" : "right"),
			.width = geometry.width,
			.height = geometry.height,
			.format = PixelFormat::bayerGrbg8, // as an MT9V032 has it
			.frameRate = settings.cameraRate,
			.blackLevel = settings.blackLevel},
	  phase_(eye == 0 ? 0 : settings.cameraPhase),
	  exposure_(settings.exposure),
	  transferDelay_(settings.transferDelay),
	  jitter_(settings.cameraJitter),
	  seed_(settings.seed * 2 + eye),
	  renderer_(std::move(scene), settings.markers, std::move(geometry),
				{.format = info_.format, .blackLevel = settings.blackLevel, .noise = settings.cameraNoise, .seed = seed_})
{
}

XrTime SyntheticImages::midExposure(uint64_t sequence) const
{
	return world_->start + fromSeconds((double(sequence) + phase_) / info_.frameRate);
}

std::optional<ImageSource::Timing> SyntheticImages::timing(uint64_t sequence) const
{
	const XrTime middle = midExposure(sequence);
	XrDuration error = 0;
	if (jitter_ > 0) {
		std::mt19937_64 random(seed_ * 0x9e3779b97f4a7c15u + sequence);
		error = XrDuration(std::normal_distribution<double>(0, double(jitter_))(random));
	}
	return Timing{.midExposure = middle + error, .exposure = exposure_, .arrival = middle + exposure_ / 2 + transferDelay_};
}

bool SyntheticImages::make(uint64_t sequence, std::span<std::byte> pixels)
{
	const HeadState head = world_->head(midExposure(sequence));
	renderer_.draw(head.orientation, head.position, sequence, pixels);
	return true;
}

} // namespace arift::synthetic
