// Files that a test writes.
#pragma once
#include "tests/common/temporary_folder.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

namespace arift::tests
{

using test::TemporaryFolder;

inline std::string readAll(const std::filesystem::path &file)
{
	std::ostringstream text;
	text << std::ifstream(file, std::ios::binary).rdbuf();
	return text.str();
}

/// `text` with its first `from` replaced, and the line on which that stood.
struct Damaged {
	std::string text;
	int line;
};
inline Damaged damage(std::string text, const std::string &from, const std::string &to)
{
	const size_t at = text.find(from);
	if (at == std::string::npos) throw std::runtime_error("nothing to damage: " + from);
	const int line = 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
	return {text.replace(at, from.size(), to), line};
}

} // namespace arift::tests
