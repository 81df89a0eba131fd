// A directory tree of its own for one test: no socket, configuration or state is shared with the user or with another test.
#pragma once
#include "tests/common/temporary_folder.h"
#include <filesystem>
#include <map>
#include <string>

namespace arift::e2e
{

/// Removed with all it holds when destroyed.
class PrivateTree
{
public:
	/// Throws std::runtime_error where no temporary folder can be made.
	PrivateTree();

	const std::filesystem::path &root() const { return folder_.path(); }
	/// Writes a file below root() and returns its path.
	std::filesystem::path write(const std::string &name, const std::string &text) const { return folder_.write(name, text); }
	/// This process' environment with XDG folders inside the tree, no display, and the runtime of this build tree active.
	std::map<std::string, std::string> environment() const;

private:
	test::TemporaryFolder folder_;
};

/// Where this build tree's programs are: beside the running one.
std::filesystem::path programDirectory();

} // namespace arift::e2e
