// Which devices of input there are, as the kernel lists them: nothing is opened, so that what is switched off stays off.
#pragma once
#include "runtime/device/input_devices.h"
#include <filesystem>
#include <string>
#include <vector>

namespace arift::evdev
{

/// Where to look: the kernel's own places, or a test's.
struct Places {
	std::filesystem::path devices = "/dev/input";
	std::filesystem::path sysfs = "/sys";
};

/// One of /dev/input/event*.
struct Node {
	std::string id; ///< "event3"
	std::filesystem::path path;
	std::string name;
	InputKind kind = InputKind::other;
};

/// In the order of their numbers.
std::vector<Node> findNodes(const Places &places);

/// Whether one of `wanted` is the device's name; * and ? stand for any text and any character.
bool isWanted(const Node &node, const std::vector<std::string> &wanted);

/// Every device for people: which of them are `wanted`, and which this process may not read.
std::vector<InputDeviceInfo> describeNodes(const Places &places, const std::vector<std::string> &wanted);

} // namespace arift::evdev
