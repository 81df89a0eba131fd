// Which runtime OpenXR applications load: the loader reads openxr/1/active_runtime[.ARCHITECTURE].json (loader specification, "Linux
// Manifest Search Behavior").
#include "runtime/base/error.h"
#include "runtime/base/user_directories.h"
#include "tools/arift/commands.h"
#include <array>
#include <cstdlib>
#include <iostream>

namespace arift::tools
{

namespace fs = std::filesystem;

namespace
{

constexpr std::array names{"active_runtime.json", "active_runtime.x86_64.json"};
constexpr const char *backupSuffix = ".arift-backup";

fs::path registryFolder(bool everybody) { return (everybody ? fs::path("/etc/xdg") : configDirectory().parent_path()) / "openxr/1"; }

/// The manifest of this build or installation: beside bin in a build tree, in share/openxr/1 of an installation.
fs::path ownManifest()
{
	const fs::path prefix = fs::canonical("/proc/self/exe").parent_path().parent_path();
	for (const fs::path &candidate : {prefix / "openxr_arift.json", prefix / "share/openxr/1/openxr_arift.json"})
		if (fs::exists(candidate)) return candidate;
	throw InputError("openxr_arift.json is neither in {} nor in {}", prefix.string(), (prefix / "share/openxr/1").string());
}

bool isOurs(const fs::path &entry) { return fs::is_symlink(entry) && fs::read_symlink(entry).filename() == "openxr_arift.json"; }

bool isThere(const fs::path &entry) { return fs::symlink_status(entry).type() != fs::file_type::not_found; }

void activate(const fs::path &entry, const fs::path &manifest)
{
	const fs::path backup = entry.string() + backupSuffix;
	if (isThere(entry) && !isOurs(entry)) {
		if (isThere(backup)) throw InputError("{} is there already: move it away, it holds what was registered before", backup.string());
		fs::rename(entry, backup);
		std::cout << fmt::format("kept {} as {}\n", entry.string(), backup.string());
	}
	// Made under another name and moved: an application that starts meanwhile finds the old one or the new one.
	const fs::path fresh = entry.string() + ".arift-new";
	fs::remove(fresh);
	fs::create_symlink(manifest, fresh);
	fs::rename(fresh, entry);
	std::cout << fmt::format("{} -> {}\n", entry.string(), manifest.string());
}

void restore(const fs::path &entry)
{
	const fs::path backup = entry.string() + backupSuffix;
	if (isThere(entry) && !isOurs(entry)) {
		std::cout << fmt::format("left {} alone: it is not ARift's\n", entry.string());
		return;
	}
	if (isThere(entry)) fs::remove(entry);
	if (!isThere(backup)) return;
	fs::rename(backup, entry);
	std::cout << fmt::format("restored {}\n", entry.string());
}

} // namespace

void registerRuntime(bool everybody)
{
	const fs::path manifest = ownManifest(), folder = registryFolder(everybody);
	fs::create_directories(folder);
	// Look before the first change: a call that fails has changed nothing.
	for (const char *name : names)
		if (isThere(folder / name) && !isOurs(folder / name) && isThere((folder / name).string() + backupSuffix))
			throw InputError("{}{} is there already: move it away, it holds what was registered before", (folder / name).string(),
							 backupSuffix);
	for (const char *name : names) activate(folder / name, manifest);
}

void unregisterRuntime(bool everybody)
{
	for (const char *name : names) restore(registryFolder(everybody) / name);
}

} // namespace arift::tools
