// What the service opens: GPU, Rig, devices, compositor; in the order in which one needs the other, so that they close the other way round.
#pragma once
#include "runtime/compositor/compositor.h"
#include "runtime/service/headset.h"
#include "runtime/service/world.h"

namespace arift
{

class System
{
public:
	/// Opens everything, telling `world.opened` of every stage. Throws InputError or std::runtime_error with a sentence for the user.
	explicit System(World &world);
	System(const System &) = delete;
	~System();

	/// Where it can go on no longer by itself.
	std::optional<Compositor::End> ended() { return compositor_->ended(); }

private:
	void identify(World &world);
	void describe(nlohmann::json &status);

	const Config &config_;
	const bool window_;
	gpu::Device device_;
	const Rig rig_;
	std::unique_ptr<Driver> driver_;
	std::unique_ptr<PanelRenderer> renderer_;
	std::array<CameraFeed, 2> feeds_;
	std::unique_ptr<Headset> headset_;
	std::unique_ptr<Compositor> compositor_;
};

} // namespace arift
