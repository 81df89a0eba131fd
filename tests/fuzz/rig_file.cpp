// A Rig file that somebody wrote. Input: the file.
#include "runtime/base/error.h"
#include "runtime/base/pose.h"
#include "runtime/optics/rig.h"
#include "tests/fuzz/input.h"
#include <cmath>

using namespace arift;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const fuzz::Folder folder;
	try {
		const Rig rig = readRig(folder.write("rig.toml", {data, size}));
		fuzz::require(rig.cameras.empty() || rig.cameras.size() == 2, "two cameras or none");
		fuzz::require(std::isfinite(rig.interpupillaryDistance) && rig.timing.refreshRate > 0, "numbers are finite");
		for (const RigCamera &camera : rig.cameras) fuzz::require(isValidPose(camera.cameraInHead), "camera poses are valid");
	} catch (const InputError &error) {
		fuzz::require(std::string(error.what()).find("rig.toml") != std::string::npos, "the complaint names the file");
	}
	return 0;
}
