#include "runtime/base/toml.h"
#include <sstream>
#include <utility>

namespace arift
{

namespace
{

/// Not toml++'s own formatter: for the width of an array it casts negative numbers to unsigned ones, and 0.1 is not 0.10000000000000001 to
/// people.
void show(const toml::node &node, std::ostream &text)
{
	node.visit([&](const auto &value) {
		if constexpr (toml::is_floating_point<decltype(value)>)
			text << fmt::format("{}", value.get());
		else if constexpr (toml::is_table<decltype(value)>)
			text << "(a table)";
		else if constexpr (toml::is_array<decltype(value)>) {
			const char *separator = "[ ";
			for (const toml::node &element : value) {
				text << std::exchange(separator, ", ");
				show(element, text);
			}
			text << (value.empty() ? "[]" : " ]");
		} else
			text << value;
	});
}

std::string shown(const toml::node &node)
{
	std::ostringstream text;
	show(node, text);
	std::string result = text.str();
	if (result.size() > 60) result = result.substr(0, 57) + "...";
	return result;
}

const toml::table emptyTable;

/// Sources that are no files are called "--set KEY=VALUE": they have no lines and no folder.
bool isCommandLine(std::string_view source) { return source.starts_with("--"); }

} // namespace

std::string TomlTable::where(const toml::node &node) const
{
	const toml::source_region &source = node.source();
	const std::string &place = source.path ? *source.path : file_;
	const bool hasLine = source.begin.line > 0 && !isCommandLine(place); // 0: it stands nowhere
	return hasLine ? fmt::format("{}:{}", place, source.begin.line) : place;
}

void TomlTable::complain(const char *key, std::string_view expected) const
{
	const toml::node *node = table_->get(key);
	const std::string name = path_.empty() ? key : path_ + "." + key;
	if (!node) throw InputError("{}: {} is missing, expected {}", where(*table_), name, expected);
	throw InputError("{}: {} = {}, expected {}", where(*node), name, shown(*node), expected);
}

const toml::node &TomlTable::node(const char *key, std::string_view expected)
{
	asked_.insert(key);
	const toml::node *node = table_->get(key);
	if (!node) complain(key, expected);
	return *node;
}

std::vector<std::string> TomlTable::keys() const
{
	std::vector<std::string> keys;
	for (const auto &[key, value] : *table_) keys.emplace_back(key.str());
	return keys;
}

double TomlTable::number(const char *key, double low, double high)
{
	const std::string expected = fmt::format("a number from {} to {}", low, high);
	const auto value = node(key, expected).value<double>();
	if (!value || !(*value >= low && *value <= high)) complain(key, expected);
	return *value;
}

int64_t TomlTable::integer(const char *key, int64_t low, int64_t high)
{
	const std::string expected = fmt::format("a whole number from {} to {}", low, high);
	const toml::node &found = node(key, expected);
	const auto value = found.value<int64_t>();
	if (!found.is_integer() || !value || *value < low || *value > high) complain(key, expected);
	return *value;
}

bool TomlTable::boolean(const char *key, bool otherwise)
{
	if (!has(key)) return otherwise;
	const toml::node &found = node(key, "true or false");
	if (!found.is_boolean()) complain(key, "true or false");
	return *found.value<bool>();
}

std::string TomlTable::text(const char *key)
{
	const toml::node &found = node(key, "a text in quotes");
	if (!found.is_string()) complain(key, "a text in quotes");
	return *found.value<std::string>();
}

std::filesystem::path TomlTable::path(const char *key)
{
	const std::filesystem::path value = text(key);
	if (value.empty()) return value;
	const toml::source_path_ptr &source = table_->get(key)->source().path;
	return std::filesystem::absolute(source && !isCommandLine(*source) ? std::filesystem::absolute(*source).parent_path() / value : value);
}

size_t TomlTable::choice(const char *key, std::span<const char *const> choices, size_t otherwise)
{
	if (!has(key)) return otherwise;
	const auto value = table_->get(key)->value<std::string>();
	std::string expected = "one of";
	size_t index = 0;
	for (const char *choice : choices) {
		if (value == choice) return index;
		expected += fmt::format("{} \"{}\"", index++ ? "," : "", choice);
	}
	complain(key, expected);
}

std::vector<double> TomlTable::numbers(const char *key, size_t size)
{
	const std::string expected = size ? fmt::format("an array of {} numbers", size) : std::string("an array of numbers");
	const toml::array *array = node(key, expected).as_array();
	if (!array || (size && array->size() != size)) complain(key, expected);
	std::vector<double> values;
	for (const toml::node &element : *array) {
		const auto value = element.value<double>();
		if (!value || !std::isfinite(*value)) complain(key, expected);
		values.push_back(*value);
	}
	return values;
}

std::vector<std::string> TomlTable::texts(const char *key)
{
	constexpr const char *expected = "an array of texts in quotes";
	const toml::array *array = node(key, expected).as_array();
	if (!array) complain(key, expected);
	std::vector<std::string> values;
	for (const toml::node &element : *array) {
		if (!element.is_string()) complain(key, expected);
		values.push_back(*element.value<std::string>());
	}
	return values;
}

TomlTable TomlTable::table(const char *key, bool required)
{
	const std::string path = path_.empty() ? key : path_ + "." + key;
	if (!has(key) && !required) return {emptyTable, file_, path};
	const toml::table *found = node(key, "a table").as_table();
	if (!found) complain(key, "a table");
	return {*found, file_, path};
}

std::vector<TomlTable> TomlTable::tables(const char *key)
{
	std::vector<TomlTable> result;
	if (!has(key)) return result;
	const toml::array *array = table_->get(key)->as_array();
	if (!array) complain(key, "an array of tables");
	for (const toml::node &element : *array) {
		if (!element.is_table()) complain(key, "an array of tables");
		result.emplace_back(*element.as_table(), file_, fmt::format("{}[{}]", path_.empty() ? key : path_ + "." + key, result.size()));
	}
	return result;
}

void TomlTable::finish() const
{
	for (const auto &[key, value] : *table_) {
		if (asked_.contains(key.str())) continue;
		std::string known;
		for (const std::string &name : asked_) known += (known.empty() ? "" : ", ") + name;
		throw InputError("{}: unknown key {}{}{} = {}, expected one of: {}", where(value), path_, path_.empty() ? "" : ".", key.str(),
						 shown(value), known);
	}
}

toml::table parseTomlFile(const std::filesystem::path &file)
{
	if (!std::filesystem::exists(file)) throw InputError("{}: no such file", file.string());
	try {
		return toml::parse_file(file.string());
	} catch (const toml::parse_error &error) {
		throw InputError("{}:{}: {}", file.string(), error.source().begin.line, error.description());
	}
}

} // namespace arift
