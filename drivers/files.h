// Tables of numbers in text files: every complaint names file, line and value.
#pragma once
#include "runtime/base/error.h"
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace arift
{

/// A table in a text file, separated by commas: empty lines and those that begin with # or a letter are passed over. Throws InputError.
class CsvReader
{
public:
	explicit CsvReader(const std::filesystem::path &file);

	/// The next row; false at the end.
	bool next();
	/// A number that must be finite; one complaint for a missing, empty or wrong field.
	double number(size_t column) const;
	int64_t integer(size_t column) const;
	std::string text(size_t column) const;
	[[noreturn]] void complain(size_t column, std::string_view expected) const;
	/// "file:line"
	std::string where() const;

private:
	std::filesystem::path path_;
	std::ifstream file_;
	size_t line_ = 0;
	std::vector<std::string> fields_;
};

} // namespace arift
