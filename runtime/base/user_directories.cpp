#include "runtime/base/user_directories.h"
#include "runtime/base/error.h"
#include <cstdlib>
#include <pwd.h>
#include <unistd.h>

namespace arift
{

namespace fs = std::filesystem;

fs::path directoryFrom(const char *variable)
{
	const char *value = std::getenv(variable);
	return value && *value == '/' ? fs::path(value) : fs::path();
}

fs::path homeDirectory()
{
	if (fs::path path = directoryFrom("HOME"); !path.empty()) return path;
	const passwd *user = ::getpwuid(::getuid());
	if (!user || !user->pw_dir) throw InputError("neither HOME nor the user database names a home directory");
	return user->pw_dir;
}

fs::path configDirectory()
{
	fs::path base = directoryFrom("XDG_CONFIG_HOME");
	if (base.empty()) base = homeDirectory() / ".config";
	return base / "arift";
}

} // namespace arift
