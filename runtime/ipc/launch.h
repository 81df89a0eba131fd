// Reaching the service, and starting it when none runs.
#pragma once
#include "runtime/ipc/socket.h"
#include <filesystem>
#include <string>

namespace arift::ipc
{

/// Environment variable that names the descriptor on which a launched service tells its launcher, in one line, why it cannot start.
constexpr const char *launchFdVariable = "ARIFT_LAUNCH_FD";

struct Connection {
	std::optional<Socket> socket;
	std::string problem; ///< where there is no socket: one sentence that says why and what to do
};

/// Connects to the running service. Never starts one.
Connection connectToService();

/// Connects; where nobody listens, starts the service and waits until it listens, at most `limit` of real time. The program started is
/// $ARIFT_SERVICE, else bin/arift-service beside the library or program this code lies in, else arift-service on PATH. Inside a sandbox
/// nothing is started; the problem names the launch option that lets the socket through.
Connection connectOrLaunch(XrDuration limit);

/// What to do where this process runs in a sandbox, from which no program outside can be started: the launch option or command that lets
/// the socket through. Empty outside of one. `root` is where the file system begins.
std::string sandboxHint(const std::filesystem::path &root = "/");

/// The service program that would be started; empty where there is none.
std::filesystem::path findService();

} // namespace arift::ipc
