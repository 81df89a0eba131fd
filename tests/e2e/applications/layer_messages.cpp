#include "tests/e2e/applications/layer_messages.h"
#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace arift::e2e
{

std::vector<std::string> expectedMessages(const std::filesystem::path &file)
{
	std::ifstream lines(file);
	if (!lines) throw std::runtime_error(file.string() + ": cannot be read");
	std::vector<std::string> ids;
	for (std::string line; std::getline(lines, line);) {
		std::istringstream words(line.substr(0, line.find('#')));
		std::string id, reason;
		if (!(words >> id)) continue;
		if (!std::getline(words >> std::ws, reason) || reason.empty())
			throw std::runtime_error(file.string() + ": " + id + " has no reason");
		ids.push_back(id);
	}
	return ids;
}

std::vector<std::string> unexpectedMessages(const std::string &text, const std::vector<std::string> &expected)
{
	static const std::regex vulkan(R"(Validation (?:Performance )?(?:Error|Warning): \[ ([^ \]]+) \])");
	static const std::regex core(R"(\[VALID_(?:ERROR|WARNING|UNKNOWN) ?\| ?([^ |]+) ?\|)");
	static const std::regex loader(R"(^(?:Error|Warning) \[[^\]]*OpenXR-Loader\])");
	std::vector<std::string> found;
	std::istringstream lines(text);
	for (std::string line; std::getline(lines, line);) {
		std::smatch match;
		std::string id;
		if (std::regex_search(line, match, vulkan) || std::regex_search(line, match, core))
			id = match[1];
		else if (std::regex_search(line, loader))
			id = "OpenXR-Loader";
		else
			continue;
		if (std::ranges::find(expected, id) == expected.end()) found.push_back(id + ": " + line);
	}
	return found;
}

} // namespace arift::e2e
