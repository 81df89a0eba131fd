// Hands the newest value from one thread to another. Never queues: an unread value is replaced.
#pragma once
#include "runtime/base/guarded.h"
#include <optional>

namespace arift
{

template <typename T> class Mailbox
{
public:
	/// Puts the value and returns the unread one that it replaced.
	std::optional<T> put(T value)
	{
		std::optional<T> replaced(std::move(value));
		box_.update([&](auto &slot) { slot.swap(replaced); });
		return replaced;
	}
	std::optional<T> take()
	{
		auto slot = box_.lock();
		return std::exchange(*slot, std::nullopt);
	}

private:
	Guarded<std::optional<T>> box_;
};

} // namespace arift
