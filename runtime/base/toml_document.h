// A configuration: a TOML file, and what a command line puts above it.
#pragma once
#include "runtime/base/toml.h"
#include <memory>

namespace arift
{

/// Every value remembers the file and line, or the option, in which it stands: complaints name that, and relative paths begin there.
class TomlDocument
{
public:
	TomlDocument() = default; ///< says nothing
	/// Throws InputError with file and line.
	explicit TomlDocument(const std::filesystem::path &file);
	TomlDocument(const TomlDocument &) = delete; // toml++ forgets in a copy where the values stood

	/// Puts what another file says above this: into the table `under`, where one is given. Throws InputError with file and line.
	void add(const std::filesystem::path &file, const std::string &under = {});
	/// What "--set KEY.PATH=VALUE" asks for; `setting` is the KEY.PATH=VALUE, its value as in TOML, quotes optional. Throws InputError.
	void set(const std::string &setting);

	/// Valid as long as this is.
	TomlTable root() const { return {table_, name_, ""}; }

private:
	toml::table table_;
	std::string name_ = "configuration"; ///< where what is missing should be
};

/// The root of `document`; of one that says nothing where it is null.
TomlTable rootOf(const std::shared_ptr<const TomlDocument> &document);

} // namespace arift
