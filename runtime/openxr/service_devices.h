// The devices that the service reads for a person without controllers, as a session's input knows devices: khr/simple_controller in a
// hand, microsoft/xbox_controller.
#pragma once
#include "runtime/ipc/pages.h"
#include "runtime/openxr/input.h"
#include "runtime/openxr/paths.h"
#include <array>
#include <span>

namespace arift::openxr
{

/// Thread-safe.
class ServiceDevices
{
public:
	explicit ServiceDevices(PathTable &paths);

	/// Brings `input` up to what the service says. Reads shared memory, and does nothing where it says nothing new; devices that the
	/// application plays itself stay as it plays them.
	void update(Input &input, const ipc::Published<ipc::InputTable> &page);

	/// The motors (ipc::Vibrate::motors) of these outputs.
	uint32_t motorsOf(std::span<const XrPath> outputs) const;

private:
	struct Hand {
		XrPath user, select, menu, aim, output;
		std::array<XrPath, 2> surfaces; ///< grip_surface, palm_ext
	};
	struct Gamepad {
		XrPath user;
		std::array<XrPath, size_t(GamepadButton::count)> buttons;
		std::array<XrPath, 2> triggers, thumbsticks, outputs; ///< left, right
	};
	static Hand handAt(PathTable &paths, const std::string &user);
	static Gamepad gamepadAt(PathTable &paths, const std::string &user);
	void write(const ipc::InputTable &table, InputDevices &devices) const;

	const XrPath simpleController_, xboxController_;
	const std::array<Hand, 2> hands_;
	const Gamepad gamepad_;
	std::atomic<uint32_t> version_{0}; ///< of the page, as taken last
};

} // namespace arift::openxr
