// Why a call fails: the XrResult the application gets and a sentence, with the values, for whoever reads the log.
#pragma once
#include "runtime/base/log.h"
#include "runtime/openxr/api.h"
#include <stdexcept>

namespace arift::openxr
{

struct Error : std::runtime_error {
	template <typename... Args> Error(XrResult code, fmt::format_string<Args...> format, Args &&...args)
		: std::runtime_error(fmt::format(format, std::forward<Args>(args)...)), result(code)
	{
	}
	XrResult result;
};

/// The specification's name of a result, or null for a value that has none.
const char *nameOf(XrResult result);
const char *nameOf(XrStructureType type);

/// The one catch site: turns the exception in flight into the result of `function` and says why, in the log and to the debug messengers of
/// the instance that `handle` (0: none) belongs to.
XrResult report(const char *function, uint64_t handle) noexcept;

} // namespace arift::openxr
