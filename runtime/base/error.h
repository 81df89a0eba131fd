// What goes wrong with something a person gave us: says where, what was found and what was expected.
#pragma once
#include "runtime/base/log.h"
#include <stdexcept>
#include <string>

namespace arift
{

/// How a program ends that worked and was stopped by a fault: whoever watches over it starts it anew. 1 is for what would only happen
/// again.
constexpr int exitAfterFault = 70; // EX_SOFTWARE of sysexits.h

/// Bad input from outside (a file, a command line, a message). `what()` is one sentence fit to be shown as it is.
struct InputError : std::runtime_error {
	using std::runtime_error::runtime_error;
	template <typename... Args> explicit InputError(fmt::format_string<Args...> format, Args &&...args)
		: std::runtime_error(fmt::format(format, std::forward<Args>(args)...))
	{
	}
};

} // namespace arift
