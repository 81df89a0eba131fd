// What a session has of XR_FB_passthrough: the one feature, and which of the service's places its layers have.
#pragma once
#include "runtime/ipc/messages.h"
#include <bitset>
#include <optional>

namespace arift::openxr
{

/// Knows no lock: it lies in a Guarded value.
struct PassthroughUse {
	bool hasFeature = false;
	std::bitset<ipc::maxPassthroughLayers> layers;

	/// A place that is free and is taken from now on; nothing where there is none.
	std::optional<uint32_t> take()
	{
		for (uint32_t i = 0; i < layers.size(); ++i)
			if (!layers.test(i)) {
				layers.set(i);
				return i;
			}
		return std::nullopt;
	}
};

} // namespace arift::openxr
