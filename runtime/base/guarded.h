// A value that can be reached only while its mutex is held.
#pragma once
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

namespace arift
{

template <typename T> class Guarded
{
public:
	template <typename... Args> explicit Guarded(Args &&...args) : value_(std::forward<Args>(args)...) {}

	class [[nodiscard]] Access
	{
	public:
		T *operator->() const { return &value_; }
		T &operator*() const { return value_; }
		/// Sleeps until ready(value) or stop is requested; says whether it became ready.
		template <typename Ready> bool wait(std::stop_token stop, Ready ready)
		{
			return changed_.wait(lock_, stop, [&] { return ready(value_); });
		}
		/// Sleeps until ready(value), stop is requested or the real time `timeout` has passed; says whether it became ready.
		template <typename Timeout, typename Ready> bool waitFor(std::stop_token stop, Timeout timeout, Ready ready)
		{
			return changed_.wait_for(lock_, stop, timeout, [&] { return ready(value_); });
		}

	private:
		friend Guarded;
		explicit Access(Guarded &owner) : lock_(owner.mutex_), value_(owner.value_), changed_(owner.changed_) {}
		std::unique_lock<std::mutex> lock_;
		T &value_;
		std::condition_variable_any &changed_;
	};

	Access lock() { return Access(*this); }

	/// Changes the value under the lock and wakes whoever waits for it.
	template <typename Change> void update(Change change)
	{
		{
			auto access = lock();
			change(*access);
		}
		changed_.notify_all();
	}

private:
	std::mutex mutex_;
	std::condition_variable_any changed_;
	T value_;
};

} // namespace arift
