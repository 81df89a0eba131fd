// One device of input that is open.
#pragma once
#include "drivers/evdev/nodes.h"
#include "runtime/base/unique_fd.h"
#include <libevdev/libevdev.h>
#include <memory>

namespace arift::evdev
{

class Device
{
public:
	/// Throws InputError with the reason, permission above all.
	explicit Device(const Node &node);

	/// To be polled for input.
	int fd() const { return fd_.get(); }
	/// The next moment at which something changed, into `report`'s keys, motion and gamepad. Never blocks: timeout where there is none.
	/// More moments than one may have been fetched from the kernel: only after a timeout is it worth polling.
	Outcome read(InputReport &report);
	/// As the gamepad is now, moved or not.
	std::optional<GamepadState> gamepad() const;
	void rumble(const Rumble &rumble);

private:
	struct Close {
		void operator()(libevdev *device) const { libevdev_free(device); }
	};
	Outcome next(unsigned flag, InputReport &report, bool &isComplete);

	InputKind kind_;
	UniqueFd fd_;
	std::unique_ptr<libevdev, Close> device_; ///< reads from fd_
	int effect_ = -1;                         ///< the kernel's number of the effect that the motors play; -1: none yet
};

} // namespace arift::evdev
