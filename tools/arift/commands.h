// What the arift command can do. Each command throws InputError or std::runtime_error with one sentence for the user.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace arift::tools
{

/// Becomes arift-service; does not return.
[[noreturn]] void runService(const std::vector<std::string> &arguments);

struct StatusOptions {
	bool json = false;
	bool reset = false;
};
void status(const StatusOptions &options);
/// Writes a PNG; a file that is there is replaced only once the new one is whole.
void screenshot(const std::string &file, bool eyes);
void recenter();
void set(const std::string &name, double value);
/// The cameras alone, or holograms again.
void showRawPassthrough(bool raw);
/// What is forced upon each application, connected or not.
void listPassthrough();
struct PassthroughOptions {
	std::string application; ///< its name
	std::string mode;        ///< off, alpha, chroma or underlay
	// What is not given stays as it is.
	std::optional<std::string> colour; ///< RRGGBB
	std::optional<double> tolerance, softness, opacity;
};
/// Puts the cameras' image behind an application that knows only opaque pictures.
void forcePassthrough(const PassthroughOptions &options);
void stop();

/// active_runtime.json and active_runtime.x86_64.json in openxr/1 of the user's configuration, or of /etc/xdg for everybody. What was there
/// is kept as NAME.arift-backup, and comes back with unregister.
void registerRuntime(bool everybody);
void unregisterRuntime(bool everybody);

} // namespace arift::tools
