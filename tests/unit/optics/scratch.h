// Files that a test writes.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <unistd.h>

namespace arift::tests
{

/// A folder of this test's own, removed at its end.
class Scratch
{
public:
	Scratch()
	{
		std::string path = (std::filesystem::temp_directory_path() / "arift_optics_XXXXXX").string();
		if (!mkdtemp(path.data())) throw std::runtime_error("no temporary folder");
		folder_ = path;
	}
	Scratch(const Scratch &) = delete;
	Scratch &operator=(const Scratch &) = delete;
	~Scratch() { std::filesystem::remove_all(folder_); }

	const std::filesystem::path &folder() const { return folder_; }
	std::filesystem::path write(const std::filesystem::path &name, const std::string &text) const
	{
		std::filesystem::create_directories((folder_ / name).parent_path());
		std::ofstream(folder_ / name, std::ios::binary) << text;
		return folder_ / name;
	}

private:
	std::filesystem::path folder_;
};

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
