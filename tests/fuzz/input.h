// What the fuzzers share: a property that must hold, and the input as a file for readers that take a path.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>

namespace arift::fuzz
{

/// Ends the process, so that the fuzzer keeps the input.
inline void require(bool holds, const char *what)
{
	if (holds) return;
	std::fprintf(stderr, "does not hold: %s\n", what);
	std::abort();
}

using Bytes = std::span<const uint8_t>;

/// Inputs of several files: what comes before the next line of four dashes; `rest` is what follows that line.
inline Bytes nextPart(Bytes &rest)
{
	constexpr std::string_view line = "----\n";
	const auto found = std::search(rest.begin(), rest.end(), line.begin(), line.end());
	const Bytes part = rest.first(size_t(found - rest.begin()));
	rest = found == rest.end() ? Bytes() : rest.subspan(part.size() + line.size());
	return part;
}

/// A folder of this process in memory; removed when the process ends in good order.
class Folder
{
public:
	Folder() : path_("/dev/shm/arift-fuzz-" + std::to_string(::getpid())) { std::filesystem::create_directories(path_); }
	~Folder()
	{
		std::error_code ignored;
		std::filesystem::remove_all(path_, ignored);
	}
	const std::filesystem::path &path() const { return path_; }
	std::filesystem::path write(const std::string &name, Bytes bytes) const
	{
		std::filesystem::path file = path_ / name;
		std::filesystem::create_directories(file.parent_path());
		std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char *>(bytes.data()), std::streamsize(bytes.size()));
		return file;
	}

private:
	std::filesystem::path path_;
};

} // namespace arift::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
