// Where Rig files live.
#include "runtime/base/user_directories.h"
#include "runtime/optics/rig.h"

namespace arift
{

bool isRigPath(const std::string &rig) { return rig.find('/') != std::string::npos || rig.ends_with(".toml"); }

std::array<std::filesystem::path, 3> rigPlaces(const std::string &name)
{
	const std::string file = name + ".toml";
	return {configDirectory() / "rigs" / file, std::filesystem::path(ARIFT_INSTALLED_RIGS) / file,
			std::filesystem::path(ARIFT_SOURCE_RIGS) / file};
}

} // namespace arift
