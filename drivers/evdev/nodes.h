// Which devices of input there are, as the kernel lists them: nothing is opened, so that what is switched off stays off.
#pragma once
#include "runtime/device/input_devices.h"
#include <filesystem>
#include <string>
#include <vector>

namespace arift::evdev
{

/// One of /dev/input/event*.
struct Node {
	std::string id; ///< "event3"
	std::filesystem::path path;
	std::string name;
	InputKind kind = InputKind::other;
};

/// In the order of their numbers.
std::vector<Node> findNodes(const InputPlaces &places);

/// Whether one of `wanted` is the device's name; * and ? stand for any text and any character.
bool isWanted(const Node &node, const std::vector<std::string> &wanted);

/// Every device for people: which of them are `wanted`, and which this process may not read.
std::vector<InputDeviceInfo> describeNodes(const InputPlaces &places, const std::vector<std::string> &wanted);

} // namespace arift::evdev
