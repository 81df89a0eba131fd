#include "tests/e2e/common/x_server.h"
#include "tests/e2e/common/command.h"
#include <cctype>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace arift::e2e
{

namespace
{

constexpr const char *xvfb = "/usr/bin/Xvfb", *xorg = "/usr/bin/Xorg";
constexpr const char *dummyDriver = "/usr/lib/xorg/modules/drivers/dummy_drv.so";
/// xorg.conf(5): one screen of the DK1's size, nothing of this machine's own.
constexpr const char *dummyScreen = R"(
Section "ServerFlags"
	Option "AutoAddDevices" "false"
	Option "AutoAddGPU" "false"
EndSection
Section "Device"
	Identifier "device"
	Driver "dummy"
	VideoRam 65536
EndSection
Section "Monitor"
	Identifier "monitor"
	HorizSync 5-1000
	VertRefresh 5-200
EndSection
Section "Screen"
	Identifier "screen"
	Device "device"
	Monitor "monitor"
	DefaultDepth 24
	SubSection "Display"
		Depth 24
		Modes "1280x800"
	EndSubSection
EndSection
)";

std::vector<std::string> commandFor(XServer::Kind kind, const PrivateTree &tree)
{
	if (kind == XServer::Kind::virtualFramebuffer) return {xvfb, "-screen", "0", "1280x800x24", "-noreset", "-nolisten", "tcp"};
	const std::string configuration = tree.root() / "xorg.conf";
	std::ofstream(configuration) << dummyScreen;
	return {xorg,       "-config",   configuration, "-logfile",    tree.root() / "xorg.log",
			"-noreset", "-nolisten", "tcp",         "-novtswitch", "-sharevts"};
}

/// With the number of its display, and a newline when it is ready, in a file.
std::vector<std::string> announcing(std::vector<std::string> command, const std::filesystem::path &file)
{
	command.insert(command.begin(), {"/bin/sh", "-c", R"(exec "$@" -displayfd 3 3>"$0")", file});
	return command;
}

} // namespace

bool XServer::isThere(Kind kind)
{
	if (kind == Kind::virtualFramebuffer) return ::access(xvfb, X_OK) == 0;
	return ::access(xorg, X_OK) == 0 && ::access(dummyDriver, R_OK) == 0 && ::geteuid() == 0;
}

XServer::XServer(const PrivateTree &tree, Kind kind)
	: process_(announcing(commandFor(kind, tree), tree.root() / "display-number"), tree.environment(), tree.root() / "x-server.log")
{
	const std::filesystem::path number = tree.root() / "display-number";
	for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20); !contentOf(number).ends_with('\n');) {
		if (std::chrono::steady_clock::now() > end) throw std::runtime_error("no X server: " + process_.output());
		std::this_thread::sleep_for(std::chrono::milliseconds(20));
	}
	display_ = ":" + std::to_string(std::atoi(contentOf(number).c_str()));
}

} // namespace arift::e2e
