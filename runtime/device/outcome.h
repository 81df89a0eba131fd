// How a bounded wait for a device ended. Expected outcomes are values, not exceptions.
#pragma once

namespace arift
{

enum class Outcome {
	ready,   ///< the output parameter holds a new sample
	timeout, ///< nothing came until the deadline; nothing is wrong
	lost,    ///< the device is gone; open it again
};

} // namespace arift
