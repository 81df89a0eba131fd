#include "drivers/evdev/nodes.h"
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fnmatch.h>
#include <fstream>
#include <linux/input-event-codes.h>
#include <optional>
#include <unistd.h>

namespace arift::evdev
{

namespace fs = std::filesystem;

namespace
{

constexpr std::string_view prefix = "event";

/// The number behind "event"; nothing for whatever else lies there.
std::optional<int> numberOf(const std::string &id)
{
	int number = 0;
	if (!id.starts_with(prefix)) return std::nullopt;
	const char *const end = id.data() + id.size();
	const auto [rest, problem] = std::from_chars(id.data() + prefix.size(), end, number);
	if (problem != std::errc{} || rest != end) return std::nullopt;
	return number;
}

std::string lineOf(const fs::path &file)
{
	std::string line;
	std::ifstream in(file);
	std::getline(in, line);
	return line;
}

/// A set of codes as the kernel prints it: hexadecimal words of its own word size, the highest first.
class Capabilities
{
public:
	explicit Capabilities(const fs::path &file)
	{
		std::ifstream in(file);
		for (unsigned long word = 0; in >> std::hex >> word;) words_.insert(words_.begin(), word);
	}
	bool has(size_t code) const { return code / bits < words_.size() && (words_[code / bits] >> code % bits & 1) != 0; }
	bool hasAnyOf(size_t first, size_t last) const
	{
		for (size_t code = first; code <= last; ++code)
			if (has(code)) return true;
		return false;
	}

private:
	static constexpr size_t bits = 8 * sizeof(unsigned long);
	std::vector<unsigned long> words_; ///< the lowest first
};

InputKind kindOf(const fs::path &capabilities)
{
	const Capabilities keys(capabilities / "key"), relative(capabilities / "rel"), absolute(capabilities / "abs");
	if (keys.has(BTN_GAMEPAD) && absolute.has(ABS_X)) return InputKind::gamepad;
	if (keys.has(BTN_LEFT) && relative.has(REL_X) && relative.has(REL_Y)) return InputKind::mouse;
	if (keys.hasAnyOf(KEY_ESC, BTN_MISC - 1)) return InputKind::keyboard;
	return InputKind::other;
}

} // namespace

std::vector<Node> findNodes(const InputPlaces &places)
{
	std::vector<Node> nodes;
	std::error_code gone;
	for (fs::directory_iterator entry(places.devices, gone), end; !gone && entry != end; entry.increment(gone)) {
		const std::string id = entry->path().filename();
		if (!numberOf(id)) continue;
		const fs::path device = places.sysfs / "class/input" / id / "device";
		nodes.push_back({id, entry->path(), lineOf(device / "name"), kindOf(device / "capabilities")});
	}
	std::ranges::sort(nodes, {}, [](const Node &node) { return numberOf(node.id); });
	return nodes;
}

bool isWanted(const Node &node, const std::vector<std::string> &wanted)
{
	return std::ranges::any_of(wanted, [&](const std::string &name) { return ::fnmatch(name.c_str(), node.name.c_str(), 0) == 0; });
}

std::vector<InputDeviceInfo> describeNodes(const InputPlaces &places, const std::vector<std::string> &wanted)
{
	std::vector<InputDeviceInfo> all;
	for (const Node &node : findNodes(places)) {
		const bool isReadable = ::access(node.path.c_str(), R_OK) == 0;
		all.push_back({node.id, node.name, node.kind, isWanted(node, wanted), isReadable ? std::string() : std::strerror(errno)});
	}
	return all;
}

} // namespace arift::evdev
