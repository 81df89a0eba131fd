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
	/// Called on the thread; none may wait long.
	struct Deeds {
		std::function<void(const ipc::InputTable &)> tell; ///< with everything that is new
		std::function<void()> recenter, toggleRawPassthrough;
	};
	InputThread(InputSettings settings, std::unique_ptr<InputDevices> devices, Deeds deeds);
	~InputThread();
	InputThread(const InputThread &) = delete;

	/// Both thread-safe.
	void vibrate(const ipc::Vibrate &message);
	void stopVibrating();

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
