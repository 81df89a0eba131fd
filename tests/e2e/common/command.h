// Runs a program of the build tree, or of an installation, to its end.
#pragma once
#include "tests/e2e/common/child_process.h"
#include "tests/e2e/common/private_tree.h"

namespace arift::e2e
{

struct Ran {
	int status = -1; ///< as ChildProcess has it; -1: did not end within the limit
	std::string output;
};

/// `command[0]` is the program's path; both output streams are in `output`.
Ran runCommand(const PrivateTree &tree, const std::vector<std::string> &command, const std::map<std::string, std::string> &environment,
			   std::chrono::seconds limit = std::chrono::seconds(90));
/// The arift command of this build tree.
Ran runArift(const PrivateTree &tree, std::vector<std::string> arguments);

/// A file's content; empty where there is none.
std::string contentOf(const std::filesystem::path &file);

/// Ends whatever service listens in a tree: the one an application started is nobody's child.
class ServiceEnd
{
public:
	explicit ServiceEnd(const PrivateTree &tree) : tree_(tree) {}
	~ServiceEnd() { runArift(tree_, {"stop"}); }
	ServiceEnd(const ServiceEnd &) = delete;

private:
	const PrivateTree &tree_;
};

} // namespace arift::e2e
