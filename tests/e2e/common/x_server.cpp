#include "tests/e2e/common/x_server.h"
#include <cctype>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace arift::e2e
{

namespace
{

constexpr const char *program = "/usr/bin/Xvfb";

} // namespace

bool XServer::isInstalled() { return ::access(program, X_OK) == 0; }

XServer::XServer(const PrivateTree &tree)
	: process_({program, "-displayfd", "1", "-screen", "0", "1280x800x24", "-noreset", "-nolisten", "tcp"}, tree.environment(),
			   tree.root() / "display-number")
{
	// It prints the number of its display, and a newline when it is ready.
	for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20); !process_.output().ends_with('\n');) {
		if (std::chrono::steady_clock::now() > end) throw std::runtime_error("no X server: " + process_.output());
		std::this_thread::sleep_for(std::chrono::milliseconds(20));
	}
	display_ = ":" + std::to_string(std::atoi(process_.output().c_str()));
}

} // namespace arift::e2e
