// OCamCalib's calib_results.txt. Input: the file.
#include "runtime/base/error.h"
#include "runtime/optics/camera_model.h"
#include "tests/fuzz/input.h"
#include <cmath>

using namespace arift;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const fuzz::Folder folder;
	try {
		const CameraModel camera = readOCamFile(folder.write("calib_results.txt", {data, size}).string());
		const glm::dvec2 centre(camera.width() / 2.0, camera.height() / 2.0);
		if (const auto direction = camera.unproject(centre))
			fuzz::require(std::isfinite(direction->x) && std::isfinite(direction->y) && std::isfinite(direction->z),
						  "directions are finite");
		if (const auto pixel = camera.project({0, 0, 1}))
			fuzz::require(std::isfinite(pixel->x) && std::isfinite(pixel->y), "pixels are finite");
	} catch (const InputError &error) {
		fuzz::require(std::string(error.what()).find("calib_results.txt") != std::string::npos, "the complaint names the file");
	}
	return 0;
}
