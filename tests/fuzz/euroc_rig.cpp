// The calibration of a EuRoC recording. Input: sensor.yaml of cam0, of cam1 (none: a monocular recording) and of imu0, separated by lines
// of four dashes.
#include "runtime/optics/euroc_rig.h"
#include "runtime/base/error.h"
#include "tests/fuzz/input.h"
#include <cmath>

using namespace arift;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const fuzz::Folder folder;
	fuzz::Bytes rest(data, size);
	folder.write("euroc/cam0/sensor.yaml", fuzz::nextPart(rest));
	if (const fuzz::Bytes right = fuzz::nextPart(rest); right.empty())
		std::filesystem::remove_all(folder.path() / "euroc/cam1");
	else
		folder.write("euroc/cam1/sensor.yaml", right);
	folder.write("euroc/imu0/sensor.yaml", rest);
	try {
		const Rig rig = rigFromEuroc(folder.path() / "euroc");
		fuzz::require(rig.cameras.size() == 1 || rig.cameras.size() == 2, "one camera or two");
		for (const RigCamera &camera : rig.cameras) {
			fuzz::require(isValidPose(camera.cameraInHead), "camera poses are valid");
			fuzz::require(camera.model.maxAngle() > 0 && camera.model.maxAngle() < M_PI, "cameras see something");
		}
		fuzz::require(isValidPose({rig.imu.imuInHead, {}}), "the sensor's axes are a rotation");
	} catch (const InputError &error) {
		fuzz::require(std::string(error.what()).find(folder.path()) != std::string::npos, "the complaint names the file");
	}
	return 0;
}
