#include "tests/e2e/common/private_tree.h"
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace arift::e2e
{

PrivateTree::PrivateTree()
{
	std::string pattern = (std::filesystem::temp_directory_path() / "arift-test-XXXXXX").string();
	if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder can be made: " + pattern);
	root_ = pattern;
	for (const char *folder : {"runtime", "config", "state"}) {
		std::filesystem::create_directory(root_ / folder);
		std::filesystem::permissions(root_ / folder, std::filesystem::perms::owner_all);
	}
}

PrivateTree::~PrivateTree()
{
	std::error_code ignored;
	std::filesystem::remove_all(root_, ignored);
}

std::filesystem::path PrivateTree::write(const std::string &name, const std::string &text) const
{
	const std::filesystem::path file = root_ / name;
	std::filesystem::create_directories(file.parent_path());
	std::ofstream(file) << text;
	return file;
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
	all["XDG_RUNTIME_DIR"] = (root_ / "runtime").string();
	all["XDG_CONFIG_HOME"] = (root_ / "config").string();
	all["XDG_STATE_HOME"] = (root_ / "state").string();
	all["XR_RUNTIME_JSON"] = (programDirectory().parent_path() / "openxr_arift.json").string();
	return all;
}

std::filesystem::path programDirectory() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

} // namespace arift::e2e
