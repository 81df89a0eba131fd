// Reading TOML that people write: every complaint names file, line, value and what was expected.
#pragma once
#include "runtime/base/error.h"
#include <filesystem>
#include <optional>
#include <set>
#include <string>
// toml++ asserts what a damaged file can break (a table header that starts with a dot) and then reports it properly: let it.
#ifndef TOML_ASSERT
#define TOML_ASSERT(expression) static_assert(true)
#endif
#include <toml++/toml.h>
#include <vector>

namespace arift
{

/// One table of a TOML file. Reads with type and range; finish() complains about keys nobody asked for.
class TomlTable
{
public:
	TomlTable(const toml::table &table, std::string file, std::string path) : table_(&table), file_(std::move(file)), path_(std::move(path))
	{
	}

	/// Counts as asking for it.
	bool has(const char *key)
	{
		asked_.insert(key);
		return table_->contains(key);
	}
	double number(const char *key, double low, double high);
	double number(const char *key, double low, double high, double otherwise) { return has(key) ? number(key, low, high) : otherwise; }
	int64_t integer(const char *key, int64_t low, int64_t high);
	int64_t integer(const char *key, int64_t low, int64_t high, int64_t otherwise)
	{
		return has(key) ? integer(key, low, high) : otherwise;
	}
	bool boolean(const char *key, bool otherwise);
	std::string text(const char *key);
	std::string text(const char *key, std::string otherwise) { return has(key) ? text(key) : std::move(otherwise); }
	/// A path. A relative one begins at the folder of the file in which the value stands; from the command line, at the working directory.
	/// An empty text is an empty path.
	std::filesystem::path path(const char *key);
	/// One of `choices`; its index.
	size_t choice(const char *key, std::initializer_list<const char *> choices, size_t otherwise);
	/// An array of numbers; `size` 0 means any length.
	std::vector<double> numbers(const char *key, size_t size);
	/// An array of texts.
	std::vector<std::string> texts(const char *key);
	/// A sub-table; an empty one where the key is absent and `required` is not set.
	TomlTable table(const char *key, bool required = false);
	std::vector<TomlTable> tables(const char *key);

	/// Every key must have been asked for: a misspelt key is an error, not a default. The message lists those that were.
	void finish() const;
	[[noreturn]] void complain(const char *key, std::string_view expected) const;

private:
	const toml::node &node(const char *key, std::string_view expected);
	std::string where(const toml::node &node) const;

	const toml::table *table_;
	std::string file_;
	std::string path_;
	std::set<std::string, std::less<>> asked_;
};

/// Parses a file; syntax errors become InputError with file and line.
toml::table parseTomlFile(const std::filesystem::path &file);

} // namespace arift
