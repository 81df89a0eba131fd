// Where the kernel lists what is plugged in: tests have lists of their own.
#pragma once
#include "drivers/registry.h"
#include <filesystem>

namespace arift
{

/// $ARIFT_SYSFS, or /sys.
std::filesystem::path sysfs();
/// In $ARIFT_DEV, or /dev, and in sysfs().
InputPlaces inputPlaces();

} // namespace arift
