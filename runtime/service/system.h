// What the service opens: GPU, Rig, devices, compositor; in the order in which one needs the other, so that they close the other way round.
#pragma once
#include "runtime/service/composition.h"
#include "runtime/service/devices.h"
#include "runtime/service/world.h"

namespace arift
{

class System
{
public:
	/// Opens everything, telling `world.opened` of every stage but the last. Throws InputError or std::runtime_error with a sentence for
	/// the user.
	explicit System(World &world);
	/// Tells `world.opened` of the last: from here on others may call it, so its owner must hold it already.
	void announce();
	System(const System &) = delete;
	~System();

	/// Makes GPU device and compositor anew after the compositor has ended with `problem`, until that succeeds or stop is requested; less
	/// and less often. Devices and head motion go on meanwhile. Throws std::runtime_error where it has failed too often in a row.
	void recompose(const std::string &problem, const std::stop_token &stop);

	/// Looks what is plugged in; true when sessions must end, for another headset, or none, has taken the place of theirs.
	bool followHeadset();

private:
	void identify(const gpu::DeviceIdentity &gpu);
	void tellHeadset();
	void compose(const std::shared_ptr<Composition> &composition);
	std::shared_ptr<Composition> makeComposition(bool again);
	std::function<void()> realtimeFor(const char *thread);
	void describe(nlohmann::json &status);

	World &world_;
	const Config &config_;
	const Rig rig_;
	Guarded<std::shared_ptr<Composition>> composition_; ///< the current one
	XrTime composedSince_ = 0;                          ///< real
	int failures_ = 0;                                  ///< compositions in a row that did not last
	std::array<CameraFeed, 2> feeds_;
	std::unique_ptr<Devices> devices_;
};

} // namespace arift
