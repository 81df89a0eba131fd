// A folder of one test's own, removed with all it holds.
#pragma once
#include <filesystem>
#include <string>

namespace arift::test
{

class TemporaryFolder
{
public:
	/// Throws std::runtime_error where none can be made.
	TemporaryFolder();
	~TemporaryFolder();
	TemporaryFolder(const TemporaryFolder &) = delete;
	const std::filesystem::path &path() const { return path_; }
	/// Writes a file below path(), folders between included, and returns its path.
	std::filesystem::path write(const std::filesystem::path &name, const std::string &content) const;

private:
	std::filesystem::path path_;
};

} // namespace arift::test
