#include "tools/arift/monitor.h"
#include "runtime/ipc/launch.h"
#include <stdexcept>

namespace arift::tools
{

namespace
{

ipc::Socket connected()
{
	ipc::Connection connection = ipc::connectToService();
	if (!connection.socket) throw std::runtime_error(connection.problem + "; `arift service` starts one");
	return std::move(*connection.socket);
}

} // namespace

Monitor::Monitor() : requests_(connected())
{
	ipc::Hello hello;
	hello.role = ipc::Role::monitor;
	hello.pid = uint32_t(::getpid());
	ipc::copyText(hello.applicationName, "arift");
	ipc::copyText(hello.build, "arift " ARIFT_VERSION);
	ask<ipc::Welcome>(hello);
}

} // namespace arift::tools
