// One line on standard error per message: time, level, room, text. Small enough to live in other people's processes:
// no static object with a destructor, no shared library beyond the C++ runtime's own.
#pragma once
#include <fmt/core.h>
#include <string_view>

namespace arift::log
{

enum class Level { debug, info, warning, error, off };

/// The least level that is written: ARIFT_LOG = debug | info | warning | error | off, read once; by default `info`
/// (`warning` inside an application, see setDefault).
Level threshold();
void setDefault(Level level);
void write(Level level, std::string_view text);

template <typename... Args> void message(Level level, fmt::format_string<Args...> format, Args &&...args)
{
	if (level >= threshold()) write(level, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args> void debug(fmt::format_string<Args...> format, Args &&...args)
{
	message(Level::debug, format, std::forward<Args>(args)...);
}
template <typename... Args> void info(fmt::format_string<Args...> format, Args &&...args)
{
	message(Level::info, format, std::forward<Args>(args)...);
}
template <typename... Args> void warning(fmt::format_string<Args...> format, Args &&...args)
{
	message(Level::warning, format, std::forward<Args>(args)...);
}
template <typename... Args> void error(fmt::format_string<Args...> format, Args &&...args)
{
	message(Level::error, format, std::forward<Args>(args)...);
}

} // namespace arift::log
