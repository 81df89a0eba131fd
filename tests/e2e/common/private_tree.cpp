#include "tests/e2e/common/private_tree.h"
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace arift::e2e
{

PrivateTree::PrivateTree()
{
	for (const char *folder : {"runtime", "config", "state"}) {
		std::filesystem::create_directory(root() / folder);
		std::filesystem::permissions(root() / folder, std::filesystem::perms::owner_all);
	}
}

std::map<std::string, std::string> PrivateTree::environment() const
{
	std::map<std::string, std::string> all;
	for (char **entry = environ; *entry; ++entry) {
		const std::string text = *entry;
		const size_t equals = text.find('=');
		if (equals != std::string::npos) all[text.substr(0, equals)] = text.substr(equals + 1);
	}
	for (const char *name : {"DISPLAY", "WAYLAND_DISPLAY", "ARIFT_CONFIG", "XR_API_LAYER_PATH", "XR_ENABLE_API_LAYERS"}) all.erase(name);
	all["XDG_RUNTIME_DIR"] = (root() / "runtime").string();
	all["XDG_CONFIG_HOME"] = (root() / "config").string();
	all["XDG_STATE_HOME"] = (root() / "state").string();
	all["ARIFT_SYSFS"] = (root() / "sys").string(); // nothing is plugged in until a test does so
	all["ARIFT_DEV"] = (root() / "dev").string();
	all["XR_RUNTIME_JSON"] = (programDirectory().parent_path() / "openxr_arift.json").string();
	return all;
}

std::filesystem::path programDirectory() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

} // namespace arift::e2e
