#include "runtime/service/overrides.h"
#include "runtime/base/error.h"
#include "runtime/base/toml.h"
#include "runtime/base/unique_fd.h"
#include "runtime/base/user_directories.h"
#include <fcntl.h>
#include <sstream>
#include <unistd.h>

namespace arift
{

namespace fs = std::filesystem;

namespace
{

constexpr const char *header = "# Written by programs (`arift set`, `arift passthrough`), above config.toml and applications.toml. Take a "
							   "line away to have your own setting again.\n";

/// Whether all of it lies on the disk.
bool writeDown(const fs::path &file, const std::string &text)
{
	const UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
	return fd && ::write(fd.get(), text.data(), text.size()) == ssize_t(text.size()) && ::fsync(fd.get()) == 0;
}

/// Complete, or as it was.
void replace(const fs::path &file, const std::string &text)
{
	const fs::path next = file.string() + fmt::format(".{}", ::getpid());
	std::error_code problem;
	if (writeDown(next, text)) {
		fs::rename(next, file, problem);
		if (!problem) return;
	}
	std::error_code ignored;
	fs::remove(next, ignored);
	throw InputError("{}: cannot be written{}", file.string(), problem ? ": " + problem.message() : "");
}

void put(toml::table &table, const std::string &key, const Overrides::Value &value)
{
	if (const float *number = std::get_if<float>(&value))
		table.insert_or_assign(key, std::stod(fmt::format("{}", *number))); // 0.3, not the double nearest to the float
	else
		table.insert_or_assign(key, std::get<std::string>(value));
}

} // namespace

fs::path overridesFile() { return configDirectory() / "overrides.toml"; }

void Overrides::keep(const std::vector<std::string> &table, const Values &values)
{
	const std::lock_guard writing(writing_);
	const fs::path file = file_.empty() ? overridesFile() : file_;
	toml::table all = fs::exists(file) ? parseTomlFile(file) : toml::table{};
	toml::table *settings = &all;
	for (const std::string &name : table) {
		settings = settings->emplace<toml::table>(name).first->second.as_table();
		if (!settings) throw InputError("{}: {} is not a table", file.string(), name);
	}
	for (const auto &[key, value] : values) put(*settings, key, value);
	// Literal strings are not escaped: a name with an end of line in it would make the file unreadable.
	toml::toml_formatter escaped(all, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings);
	std::ostringstream text;
	text << header << '\n' << escaped << '\n';
	std::error_code ignored;
	fs::create_directories(file.parent_path(), ignored); // what is wrong shows when the file is written
	replace(file, text.str());
}

} // namespace arift
