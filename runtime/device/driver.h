// A driver: says which devices it finds and opens them.
#pragma once
#include "runtime/device/camera.h"
#include "runtime/device/imu_tracker.h"
#include <memory>
#include <vector>

namespace arift
{

class TomlDocument;

/// Where a simulated camera looks: what its driver must know to draw, as plain numbers.
struct CameraGeometry {
	uint32_t width = 0, height = 0;
	/// Unit viewing direction of each pixel's centre in the CV frame, row by row; (0,0,0) where the lens sees nothing.
	std::vector<XrVector3f> rays;
	XrPosef cameraInHead = {{0, 0, 0, 1}, {0, 0, 0}}; ///< OpenXR axes
};

/// What a driver may know of the world it is opened in.
struct DriverContext {
	Clock &clock;
	std::shared_ptr<const TomlDocument> configuration; ///< its table of the driver's name holds the driver's settings; null: all defaults
	std::array<CameraGeometry, 2> geometry;            ///< for drivers that simulate cameras: left, right
	XrPosef imuInHead = {{0, 0, 0, 1}, {0, 0, 0}};     ///< for drivers that simulate a tracker
	XrVector3f neckInHead{0, -0.075f, 0.0805f};        ///< the pivot a simulated head turns about
};

class Driver
{
public:
	virtual ~Driver() = default;
	/// For people: "synthetic headset", "Oculus Rift DK1".
	virtual std::string name() const = 0;
	/// Null where this driver has no such device. Throws InputError when the device or its recording is there but unusable.
	virtual std::unique_ptr<ImuTracker> openTracker() = 0;
	/// `eye` 0 is left, 1 is right.
	virtual std::unique_ptr<Camera> openCamera(uint32_t eye, FrameAllocator allocate) = 0;
};

} // namespace arift
