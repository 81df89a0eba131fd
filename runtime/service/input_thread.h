// Reads the devices of input that are switched on, and turns their motors.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/service/input_map.h"
#include "runtime/service/vibration.h"
#include <functional>
#include <memory>
#include <thread>

namespace arift
{

class InputThread
{
public:
	/// Called on the thread, without a lock; none may wait long.
	struct Deeds {
		/// With everything that is new, and that nothing is there when nobody reads any more.
		std::function<void(const ipc::InputTable &)> tell;
		std::function<void()> recenter, toggleRawPassthrough;
		std::function<bool(uint32_t session)> mayVibrate; ///< whether it has the focus
	};
	InputThread(InputSettings settings, std::unique_ptr<InputDevices> devices, Deeds deeds);
	~InputThread();
	InputThread(const InputThread &) = delete;

	/// Both thread-safe. Whoever asks is felt while it may, which is seen to here: when motors are told, and whenever somebody says that
	/// the focus has moved.
	void vibrate(uint32_t session, const ipc::Vibrate &message);
	void focusMoved();

private:
	struct Wanted {
		Vibration vibration;
		uint32_t changes = 0;
	};
	/// What the motors were told last.
	struct Told {
		uint32_t changes = 0;
		Rumble rumble;
		XrTime until = 0; ///< real
	};
	void run(const std::stop_token &stop);
	void read(const std::stop_token &stop);
	void leave();
	Wanted wanted();
	void take(const InputReport &report);
	void drive();

	InputMap map_;
	const std::unique_ptr<InputDevices> devices_;
	const Deeds deeds_;
	Guarded<Wanted> wanted_;
	Told told_;
	std::jthread thread_;
};

} // namespace arift
