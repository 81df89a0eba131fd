// A keyboard, mouse or gamepad as a test plays it, for a program that interposed_calls.cpp is linked into.
#pragma once
#include "runtime/base/unique_fd.h"
#include "runtime/base/xr.h"
#include "tests/fakes/evdev/fake_state.h"
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace arift::fake
{

/// What a device is made of.
struct InputModel {
	std::string name;
	uint16_t vendor = 0x045e;
	std::vector<int> keys, relative;
	struct Axis {
		int code;
		int minimum, maximum, flat, value;
	};
	std::vector<Axis> axes;
	bool rumbles = false;

	static InputModel keyboard(std::string name = "Test Keyboard");
	static InputModel mouse(std::string name = "Test Mouse");
	/// As the kernel's driver for the Xbox 360's tells of one: triggers on Z and RZ, the pad as a hat.
	static InputModel gamepad(std::string name = "Test Gamepad");
};

/// Folders of one test that stand for /dev/input and /sys.
struct InputFolders {
	explicit InputFolders(const std::filesystem::path &root);
	std::filesystem::path devices, sysfs;
};

/// Plugged in as long as it lives. Every wait ends after ten seconds with a failure of the test.
class FakeInputDevice
{
public:
	FakeInputDevice(InputFolders folders, std::string node, const InputModel &model, unsigned permissions = 0600);
	~FakeInputDevice();
	FakeInputDevice(const FakeInputDevice &) = delete;

	/// As udev does it when somebody sits down before the machine.
	void setPermissions(unsigned permissions) const;
	/// Until the program has opened it.
	void waitForReader();
	bool isOpened() const;
	struct Change {
		int type, code, value;
	};
	/// Everything that happens at one moment. To whoever has opened it; waits for somebody.
	void send(std::initializer_list<Change> changes);
	/// More has happened than the kernel keeps: the reader hears that it missed something and must ask.
	void overrun(std::initializer_list<Change> missed);
	void press(int key, bool isPressed = true) { send({{EV_KEY, key, isPressed ? 1 : 0}}); }

	/// What its motors were told.
	struct Played {
		uint16_t strong, weak, lengthMs;
		bool isOn; ///< false: stopped
		bool operator==(const Played &) const = default;
	};
	/// The next thing they are told; nothing where that is not within ten seconds.
	std::optional<Played> nextPlayed();

private:
	void note(const Change &change);
	void writeSysfs(const InputModel &model) const;

	const InputFolders folders_;
	const std::string node_;
	const std::filesystem::path path_;
	InputState *state_ = nullptr; ///< mapped
	UniqueFd listener_, reader_;
	Played effect_{}; ///< as uploaded
};

} // namespace arift::fake
