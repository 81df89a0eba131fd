// Where Rig files live. XDG Base Directory Specification 0.8.
#include "runtime/base/error.h"
#include "runtime/optics/rig.h"
#include <cstdlib>

namespace arift
{

namespace
{

std::filesystem::path configFolder()
{
	if (const char *folder = std::getenv("XDG_CONFIG_HOME"); folder && *folder == '/') return folder;
	const char *home = std::getenv("HOME");
	return std::filesystem::path(home ? home : "/") / ".config";
}

} // namespace

std::filesystem::path findRig(const std::string &name)
{
	if (name.empty()) throw InputError("the name of a rig is empty, expected for example \"{}\"", defaultRig);
	if (name.find('/') != std::string::npos || name.ends_with(".toml")) {
		if (!std::filesystem::is_regular_file(name)) throw InputError("{}: no such rig file", name);
		return name;
	}
	std::string looked;
	for (const std::filesystem::path &folder :
		 {configFolder() / "arift" / "rigs", std::filesystem::path(ARIFT_INSTALLED_RIGS), std::filesystem::path(ARIFT_SOURCE_RIGS)}) {
		const std::filesystem::path file = folder / (name + ".toml");
		if (std::filesystem::is_regular_file(file)) return file;
		looked += (looked.empty() ? "" : ", ") + file.string();
	}
	throw InputError("no rig is named \"{}\", expected one of these files: {}", name, looked);
}

} // namespace arift
