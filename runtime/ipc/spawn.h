// Starts a program that outlives this process and has nothing of it: safe in any host, however many threads and signal handlers it has.
#pragma once
#include "runtime/base/unique_fd.h"
#include <filesystem>
#include <string>
#include <vector>

namespace arift::ipc
{

/// Double fork, new session, default signals, cwd /, standard input from /dev/null, output appended to `log`, every other descriptor
/// closed, an allow-listed environment. Returns the reading end of a pipe whose other end the program has (descriptor 3, named by
/// ARIFT_LAUNCH_FD): it ends when the program closes it or dies. Throws std::system_error.
UniqueFd spawnDetached(const std::filesystem::path &program, const std::vector<std::string> &arguments, const std::filesystem::path &log);

/// Which variables of this process' environment the program gets: who and where the user is, displays, drivers and ours.
bool passesToService(std::string_view variable);

} // namespace arift::ipc
