// All devices of input that are switched on: opened when they come, let go of when they leave.
#pragma once
#include "drivers/evdev/device.h"
#include <deque>
#include <map>

namespace arift::evdev
{

class Devices final : public InputDevices
{
public:
	/// `wanted`: names of devices, as in isWanted(). Devices that cannot be opened are tried again whenever something changes there. Throws
	/// std::system_error when the process has no descriptors left.
	Devices(InputPlaces places, std::vector<std::string> wanted);

	Outcome read(InputReport &report, XrTime deadline) override;
	void rumble(uint32_t device, const Rumble &rumble) override;
	void wake() override;

private:
	struct Opened {
		uint32_t number;
		Node node;
		Device device;
	};
	void scan();
	void open(const Node &node);
	void watch();
	void unwatch();
	void takeNotices();
	void close(std::vector<Opened>::iterator opened);
	bool readOpened(InputReport &report);
	bool sleep(XrTime deadline);

	const InputPlaces places_;
	const std::vector<std::string> wanted_;
	const UniqueFd notices_, woken_; ///< inotify of the folder of devices; eventfd
	int watch_ = -1;                 ///< of inotify; -1: the folder is not watched
	bool isStale_ = true;
	uint32_t next_ = 1;
	std::vector<Opened> opened_;
	std::map<std::string, std::string> complaints_; ///< by node: what was said of it last
	std::deque<InputReport> comings_;               ///< and goings, not told yet
};

} // namespace arift::evdev
