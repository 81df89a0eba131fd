#include "tests/common/temporary_folder.h"
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace arift::test
{

TemporaryFolder::TemporaryFolder()
{
	std::string name = (std::filesystem::temp_directory_path() / "arift-test-XXXXXX").string();
	if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
	path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
	std::error_code ignored;
	std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::filesystem::path &name, const std::string &content) const
{
	const std::filesystem::path file = path_ / name;
	std::filesystem::create_directories(file.parent_path());
	std::ofstream(file, std::ios::binary) << content;
	return file;
}

} // namespace arift::test
