#include "runtime/base/toml_document.h"

namespace arift
{

namespace
{

/// Moves, for a copied node has lost its source.
void merge(toml::table &into, toml::table &&from)
{
	for (auto &&[key, value] : from) {
		toml::table *target = into[key.str()].as_table(), *source = value.as_table();
		if (target && source)
			merge(*target, std::move(*source));
		else
			into.insert_or_assign(key.str(), std::move(value));
	}
}

toml::table parseSetting(const std::string &setting, const std::string &source)
{
	const size_t equals = setting.find('=');
	if (equals == std::string::npos || equals == 0)
		throw InputError("{}: expected KEY.PATH=VALUE, for instance --set clock.mode=stepped", source);
	const std::string key = setting.substr(0, equals), value = setting.substr(equals + 1);
	try {
		return toml::parse(key + " = " + value, source);
	} catch (const toml::parse_error &) {
		try {
			return toml::parse(key + " = '''" + value + "'''", source); // a bare word is a text
		} catch (const toml::parse_error &problem) {
			throw InputError("{}: {}", source, problem.description());
		}
	}
}

} // namespace

TomlDocument::TomlDocument(const std::filesystem::path &file) : table_(parseTomlFile(file)), name_(file.string()) {}

void TomlDocument::add(const std::filesystem::path &file, const std::string &under)
{
	toml::table table = parseTomlFile(file);
	if (under.empty()) return merge(table_, std::move(table));
	toml::table outer;
	outer.emplace(under, std::move(table));
	merge(table_, std::move(outer));
}

void TomlDocument::set(const std::string &setting)
{
	const std::string source = "--set " + setting;
	toml::table table = parseSetting(setting, source);
	if (table.size() != 1) throw InputError("{}: expected one KEY.PATH=VALUE", source); // a comment sign in the key, or lines
	merge(table_, std::move(table));
}

TomlTable rootOf(const std::shared_ptr<const TomlDocument> &document)
{
	static const TomlDocument nothing;
	return document ? document->root() : nothing.root();
}

} // namespace arift
