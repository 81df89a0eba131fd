// Whom an instance tells what its application did wrong (XR_EXT_debug_utils).
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/openxr/api.h"
#include <vector>

namespace arift::openxr
{

/// Thread-safe. A callback is called without a lock. The specification lets no callback destroy a messenger, and no messenger be destroyed
/// while another thread is in a call with its instance or a child of it: none is destroyed while it is called.
class DebugMessengers
{
public:
	/// `messenger` stands for what is added until it is removed.
	void add(const void *messenger, const XrDebugUtilsMessengerCreateInfoEXT &info) { all_.lock()->push_back({messenger, info}); }
	void remove(const void *messenger)
	{
		std::erase_if(*all_.lock(), [&](const Messenger &other) { return other.key == messenger; });
	}
	/// To each that asked for such messages: with the names that the application gave its objects, and the labels of those that are
	/// sessions.
	void send(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
			  const XrDebugUtilsMessengerCallbackDataEXT &data);

private:
	struct Messenger {
		const void *key;
		XrDebugUtilsMessengerCreateInfoEXT info;
	};
	Guarded<std::vector<Messenger>> all_;
};

} // namespace arift::openxr
