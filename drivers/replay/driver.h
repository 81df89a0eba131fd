// Plays recordings: EuRoC/ASL folders drive tracker and cameras; `.brd` files drive the tracker, while simulated cameras follow their
// reference poses through the synthetic room.
#pragma once
#include "runtime/device/driver.h"
#include <memory>

namespace arift::replay
{

/// Throws InputError where [replay] is wrong; opens nothing, and it need not name a recording.
void checkSettings(const std::shared_ptr<const TomlDocument> &configuration);

/// Reads [replay] of the context's configuration (recording = PATH, loop = true) and, for `.brd`, [synthetic] for the cameras.
/// Throws InputError. The context's clock outlives the driver and its devices.
std::unique_ptr<Driver> makeDriver(const DriverContext &context);

} // namespace arift::replay
