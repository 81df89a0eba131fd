#include "runtime/service/input_map.h"
#include <algorithm>
#include <glm/trigonometric.hpp>

namespace arift
{
namespace
{

/// A mouse moves its ray within what is seen: about as far as the lenses show.
constexpr float widestAim = glm::radians(40.0f);
/// Where a hand is held, as seen by the person: metres.
constexpr float handAside = 0.2f, handBelow = 0.3f, handAhead = 0.4f;

bool contains(const std::vector<KeyCode> &keys, KeyCode key) { return std::ranges::find(keys, key) != keys.end(); }

} // namespace

InputMap::InputMap(InputSettings settings) : settings_(std::move(settings)) {}

void InputMap::aim(const XrVector2f &motion)
{
	const float perCount = glm::radians(float(settings_.mouseSpeed));
	aim_.x = std::clamp(aim_.x + motion.x * perCount, -widestAim, widestAim);
	aim_.y = std::clamp(aim_.y + motion.y * perCount, -widestAim, widestAim);
}

bool InputMap::isHeld(const std::vector<KeyCode> &keys) const
{
	return std::ranges::any_of(devices_, [&](const auto &device) {
		return std::ranges::any_of(device.second.keys, [&](KeyCode key) { return contains(keys, key); });
	});
}

std::optional<uint32_t> InputMap::gamepad() const
{
	const auto found = std::ranges::find_if(devices_, [](const auto &device) { return device.second.gamepad.has_value(); });
	return found == devices_.end() ? std::nullopt : std::optional(found->first);
}

/// The ray begins between the eyes: what it points at is what is seen there.
ipc::HandState InputMap::hand() const
{
	ipc::HandState hand;
	hand.isThere = 1;
	hand.select = isHeld(settings_.select);
	hand.menu = isHeld(settings_.menu);
	if (settings_.aim == Aim::mouse) hand.aimInView.orientation = rotationAbout({0, 1, 0}, -aim_.x) * rotationAbout({1, 0, 0}, aim_.y);
	hand.gripInView = {hand.aimInView.orientation, {*settings_.hand == 0 ? -handAside : handAside, -handBelow, -handAhead}};
	return hand;
}

Wishes InputMap::take(const InputReport &report)
{
	Wishes wishes;
	if (report.isThere) {
		Held &device = devices_[report.device];
		device.kind = report.kind;
		device.gamepad = report.gamepad;
		for (const auto &[key, isPressed] : report.keys) {
			if (isPressed)
				device.keys.insert(key);
			else
				device.keys.erase(key);
			wishes.recenter |= isPressed && contains(settings_.recenter, key);
			wishes.rawPassthrough |= isPressed && contains(settings_.rawPassthrough, key);
		}
		if (report.kind == InputKind::mouse) aim(report.motion);
	} else {
		devices_.erase(report.device);
	}
	if (wishes.recenter) aim_ = {};
	table_ = {};
	if (settings_.hand && !devices_.empty()) table_.hands[*settings_.hand] = hand();
	if (const auto pad = gamepad()) {
		table_.hasGamepad = 1;
		table_.gamepad = *devices_.at(*pad).gamepad;
	}
	return wishes;
}

} // namespace arift
