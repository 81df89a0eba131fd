// The user's directories. XDG Base Directory Specification 0.8.
#pragma once
#include <filesystem>

namespace arift
{

/// The directory that an environment variable names; empty where it names none, or a relative one, which the specification ignores.
std::filesystem::path directoryFrom(const char *variable);
/// $HOME, else what the user database says. Throws InputError where neither names one.
std::filesystem::path homeDirectory();
/// $XDG_CONFIG_HOME/arift, else ~/.config/arift. Not made.
std::filesystem::path configDirectory();

} // namespace arift
