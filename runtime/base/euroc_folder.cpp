#include "runtime/base/euroc_folder.h"
#include "runtime/base/error.h"

namespace arift
{

namespace fs = std::filesystem;

EurocFolder findEuroc(const fs::path &recording)
{
	const fs::path inner = recording / "mav0", sensors = fs::is_directory(inner) ? inner : recording;
	if (!fs::is_directory(sensors / "cam0"))
		throw InputError("{}: no folder cam0, expected a recording in the EuRoC layout (mav0/cam0, mav0/imu0)", sensors.string());
	fs::path named = fs::canonical(sensors); // without a slash at its end
	if (named.filename() == "mav0") named = named.parent_path();
	return {sensors, named.filename().string(), fs::is_directory(sensors / "cam1")};
}

} // namespace arift
