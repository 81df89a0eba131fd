#include "tests/e2e/common/command.h"
#include <fstream>
#include <sstream>

namespace arift::e2e
{

Ran runCommand(const PrivateTree &tree, const std::vector<std::string> &command, const std::map<std::string, std::string> &environment,
			   std::chrono::seconds limit)
{
	const std::filesystem::path log = tree.root() / "command.log";
	std::filesystem::remove(log);
	ChildProcess process(command, environment, log);
	const auto status = process.wait(limit);
	return {status.value_or(-1), process.output()};
}

Ran runArift(const PrivateTree &tree, std::vector<std::string> arguments)
{
	arguments.insert(arguments.begin(), (programDirectory() / "arift").string());
	return runCommand(tree, arguments, tree.environment());
}

std::string contentOf(const std::filesystem::path &file)
{
	std::ostringstream text;
	text << std::ifstream(file, std::ios::binary).rdbuf();
	return text.str();
}

} // namespace arift::e2e
