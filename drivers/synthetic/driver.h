// The headset that needs no hardware: simulated sensors and cameras behind the interfaces of real ones.
#pragma once
#include "runtime/device/driver.h"
#include <memory>

namespace arift::synthetic
{

/// Throws InputError where [synthetic] is wrong; opens nothing.
void checkSettings(const std::shared_ptr<const TomlDocument> &configuration);

/// Reads [synthetic] of the context's configuration. Throws InputError. The context's clock outlives the driver and its devices.
std::unique_ptr<Driver> makeDriver(const DriverContext &context);

} // namespace arift::synthetic
