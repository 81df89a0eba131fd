// The calibrated truth about one headset: immutable once read. The Rig file is TOML, versioned and commented (calib/rigs/).
#pragma once
#include "runtime/base/pose.h"
#include "runtime/optics/camera_model.h"
#include "runtime/optics/lens_model.h"
#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/mat3x3.hpp>

namespace arift
{

/// When each panel line is seen. By default the DK1: 1280x800 CVT reduced blanking, 823 lines at 59.91 Hz.
struct PanelTiming {
	double refreshRate = 59.91;             ///< nominal; the period is measured
	XrDuration vblankToFirstLine = 182'260; ///< ns
	XrDuration lineTime = 20'250;           ///< ns, top to bottom
	XrDuration settling = 16'800'000;       ///< ns: half of settling and persistence
	/// From vertical blank to the instant at which line `line` is seen.
	XrDuration lineDelay(double line) const { return vblankToFirstLine + XrDuration(line * double(lineTime)) + settling; }
};

/// corrected = matrix * (raw - bias), per sensor, in tracker axes.
struct SensorCalibration {
	glm::dmat3 matrix{1};
	glm::dvec3 bias{0};
};
struct ImuCalibration {
	SensorCalibration gyroscope;     ///< rad/s
	SensorCalibration accelerometer; ///< m/s^2
	XrQuaternionf imuInHead = identityOrientation;
};

struct RigCamera {
	CameraModel model;
	XrPosef cameraInHead = identityPose; ///< OpenXR axes: the camera looks along -z, its image's rows run along +x
	XrDuration timeOffset = 0;           ///< added to the driver's mid-exposure time
	int32_t bayer = -1;                  ///< PixelFormat that overrides the driver's, or -1
};

struct Rig {
	static constexpr int fileVersion = 1;
	std::string name;
	LensModel lens{SplineLens{}};
	PanelTiming timing;
	double interpupillaryDistance = 0.064;
	std::array<XrPosef, 2> eyeInHead;
	std::vector<RigCamera> cameras; ///< left, right; one for both eyes; or none
	ImuCalibration imu;
	XrVector3f pivotInHead{0, -0.075f, 0.0805f};

	/// The camera whose image an eye is shown; null where there is none.
	const RigCamera *cameraFor(size_t eye) const { return cameras.empty() ? nullptr : &cameras[std::min(eye, cameras.size() - 1)]; }
};

/// Throws InputError with file, line and value where the file is wrong. OCamCalib files it names are looked for beside it.
Rig readRig(const std::filesystem::path &file);

constexpr const char *defaultRig = "arift";
/// Whether somebody means a file (anything with a slash or ending in .toml) and not a name.
bool isRigPath(const std::string &rig);
/// Where the Rig of this name may lie, the best place first: NAME.toml in the user's configuration, the installed data, the source tree.
std::array<std::filesystem::path, 3> rigPlaces(const std::string &name);

} // namespace arift
