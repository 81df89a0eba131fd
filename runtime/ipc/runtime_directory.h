// Where the service's socket, lock and log lie, and that nobody else can put a socket there.
#pragma once
#include <filesystem>

namespace arift::ipc
{

/// $XDG_RUNTIME_DIR/arift, else /run/user/UID/arift, else /tmp/arift-UID: made with mode 0700 where absent. Throws InputError where it is
/// not a directory, belongs to somebody else or is open to others.
std::filesystem::path runtimeDirectory();
std::filesystem::path socketPath();
std::filesystem::path lockPath();
/// $XDG_STATE_HOME/arift/service.log, else ~/.local/state/arift/service.log; folders are made.
std::filesystem::path logPath();

} // namespace arift::ipc
