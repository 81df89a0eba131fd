// Owns the devices of one headset and the threads that read them; opens again what is lost. Nothing else.
#pragma once
#include "runtime/compositor/camera_feed.h"
#include "runtime/device/driver.h"
#include "runtime/optics/rig.h"
#include "runtime/service/config.h"
#include "runtime/service/status.h"
#include <memory>
#include <thread>

namespace arift
{

struct PoseRing;
class DriverDoor;

/// The Rig a configuration asks for. Throws InputError.
Rig rigFor(const Config &config);

/// The driver a configuration asks for, told what it must know of the Rig to simulate. Opens no device. Throws InputError.
std::unique_ptr<Driver> driverFor(const Config &config, const Rig &rig, Clock &clock);

/// Reads tracker and cameras until it is destroyed. A device that is lost or cannot be opened is tried again, less and less often, at
/// least every five seconds of the system's clock.
class Headset
{
public:
	/// Everything given must outlive it. `trackerBegins` is called first by the tracker's thread. Devices are opened here, so that what is
	/// wrong with a recording is said at once (InputError).
	Headset(const Rig &rig, Driver &driver, Clock &clock, PoseRing &poses, std::array<CameraFeed *, 2> feeds, FrameAllocator allocate,
			std::function<void()> trackerBegins = {});
	~Headset();

	std::vector<CameraStatus> cameras();
	TrackerStatus tracker();

private:
	std::unique_ptr<DriverDoor> door_;
	struct CameraThread;
	struct TrackerThread;
	std::vector<std::unique_ptr<CameraThread>> cameras_;
	std::unique_ptr<TrackerThread> tracker_;
};

} // namespace arift
