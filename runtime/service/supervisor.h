// The tiny parent of a service that an application has started: starts it anew when it dies.
#pragma once
#include "runtime/base/xr.h"
#include <functional>
#include <optional>

namespace arift
{

/// How long to wait before a service that died is started again. Pure.
class RestartPolicy
{
public:
	/// A life shorter than this (real time) was a quick one.
	static constexpr XrDuration quick = 10 * second;
	/// So many quick lives in a row are enough.
	static constexpr int mostQuick = 8;

	/// 0.1 s, and twice as long after each further quick life, at most 5 s; nothing: it is given up.
	std::optional<XrDuration> died(XrDuration lived);

private:
	int quickInARow_ = 0;
};

/// Forks; to be called before the process has any thread. In the child, which is to become the service, it returns nothing. In the parent
/// it returns when the service has come to its end: with 0 where that was orderly, with the service's own status where it says that it
/// cannot serve as asked, or once it is given up. A service ended by a signal or with exitAfterFault is started anew. SIGTERM and SIGINT
/// are passed on. `parentBegins` is called in the parent after the first fork.
std::optional<int> supervise(const std::function<void()> &parentBegins);

} // namespace arift
