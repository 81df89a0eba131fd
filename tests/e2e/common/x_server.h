// An X server without a screen of its own, for one test.
#pragma once
#include "tests/e2e/common/child_process.h"
#include "tests/e2e/common/private_tree.h"

namespace arift::e2e
{

/// Thread-bound. Ended when destroyed.
class XServer
{
public:
	/// Whether there is one on this machine (package xvfb).
	static bool isInstalled();
	/// Waits until it takes connections; throws std::runtime_error with what it said where it does not within twenty seconds.
	explicit XServer(const PrivateTree &tree);

	/// For DISPLAY.
	const std::string &display() const { return display_; }
	ChildProcess &process() { return process_; }

private:
	ChildProcess process_;
	std::string display_;
};

} // namespace arift::e2e
