#include "drivers/files.h"
#include <cctype>
#include <charconv>
#include <cmath>

namespace arift
{

CsvReader::CsvReader(const std::filesystem::path &file) : path_(file), file_(file)
{
	if (!std::filesystem::exists(file)) throw InputError("{}: no such file", file.string());
	if (!file_ || !std::filesystem::is_regular_file(file))
		throw InputError("{}: cannot be read, expected a table in a text file", file.string());
}

bool CsvReader::next()
{
	constexpr size_t longestLine = 4096;
	for (std::string line; std::getline(file_, line);) {
		line_++;
		while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
		if (line.empty() || line[0] == '#' || std::isalpha(static_cast<unsigned char>(line[0]))) continue;
		if (line.size() > longestLine) throw InputError("{}: a line of {} bytes, expected comma-separated values", where(), line.size());
		fields_.clear();
		for (size_t begin = 0; begin <= line.size();) {
			const size_t end = std::min(line.find(',', begin), line.size());
			const size_t first = std::min(line.find_first_not_of(" \t", begin), end);
			fields_.push_back(line.substr(first, end - first));
			begin = end + 1;
		}
		return true;
	}
	return false;
}

std::string CsvReader::where() const { return fmt::format("{}:{}", path_.string(), line_); }

void CsvReader::complain(size_t column, std::string_view expected) const
{
	if (column >= fields_.size())
		throw InputError("{}: {} columns, expected {} in column {}", where(), fields_.size(), expected, column + 1);
	throw InputError("{}: \"{}\" in column {}, expected {}", where(), fields_[column].substr(0, 60), column + 1, expected);
}

double CsvReader::number(size_t column) const
{
	double value = 0;
	if (column >= fields_.size()) complain(column, "a number");
	const std::string &field = fields_[column];
	const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
	if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) complain(column, "a number");
	return value;
}

int64_t CsvReader::integer(size_t column) const
{
	int64_t value = 0;
	if (column >= fields_.size()) complain(column, "a whole number");
	const std::string &field = fields_[column];
	const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
	if (error != std::errc{} || end != field.data() + field.size()) complain(column, "a whole number");
	return value;
}

std::string CsvReader::text(size_t column) const
{
	if (column >= fields_.size() || fields_[column].empty()) complain(column, "a text");
	return fields_[column];
}

} // namespace arift
