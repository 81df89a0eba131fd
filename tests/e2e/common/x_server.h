// An X server without a screen to look at, for one test.
#pragma once
#include "tests/e2e/common/child_process.h"
#include "tests/e2e/common/private_tree.h"

namespace arift::e2e
{

/// Thread-bound. Ended when destroyed.
class XServer
{
public:
	enum class Kind {
		virtualFramebuffer, ///< Xvfb (package xvfb)
		dummyDriver         ///< Xorg with the extensions of a real screen (package xserver-xorg-video-dummy), for root only
	};
	/// Whether this machine has one that this user may start.
	static bool isThere(Kind kind = Kind::virtualFramebuffer);
	/// Waits until it takes connections; throws std::runtime_error with what it said where it does not within twenty seconds.
	explicit XServer(const PrivateTree &tree, Kind kind = Kind::virtualFramebuffer);

	/// For DISPLAY.
	const std::string &display() const { return display_; }
	ChildProcess &process() { return process_; }

private:
	ChildProcess process_;
	std::string display_;
};

} // namespace arift::e2e
