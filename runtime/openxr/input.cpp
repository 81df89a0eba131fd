#include "runtime/openxr/input.h"
#include <cmath>

namespace arift::openxr
{
namespace
{

/// A number is a pressed button from here on, and until it is below the second.
constexpr float pressedFrom = 0.5f, pressedUntil = 0.4f;

/// A part of a vector, where the device says nothing of the part itself.
float partOf(const InputDevice &device, const Binding &binding)
{
	if (const InputValue *value = device.find(binding.source)) return value->vector.x;
	const InputValue *parent = device.find(binding.identifier);
	if (!parent) return 0;
	return binding.part == SourcePart::x ? parent->vector.x : parent->vector.y;
}

XrVector2f directionOf(const InputDevice &device, const Binding &binding, Dpad &dpad)
{
	if (const InputValue *value = device.find(binding.source)) return value->vector;
	const InputValue *pad = device.find(binding.identifier);
	const InputValue *press = binding.press != XR_NULL_PATH ? device.find(binding.press) : nullptr;
	const DpadRegions regions =
		dpad.update(binding.dpad, pad ? pad->vector : XrVector2f{}, {binding.press != XR_NULL_PATH, press ? press->vector.x : 0});
	return {regions & binding.direction ? 1.0f : 0.0f, 0};
}

float lengthOf(XrVector2f vector) { return std::hypot(vector.x, vector.y); }

/// "Multiple sources for a single action": of several the one furthest from rest; a boolean is true where one is.
void merge(ActionResult &result, XrVector2f value, const std::optional<Placed> &place)
{
	if (!result.isActive || lengthOf(value) > lengthOf(result.value)) result.value = value;
	if (!result.place) result.place = place;
	result.isActive = true;
}

bool isSame(XrVector2f a, XrVector2f b) { return a.x == b.x && a.y == b.y; }

bool canRead(XrActionType action, XrActionType source)
{
	const auto isNumber = [](XrActionType type) { return type == XR_ACTION_TYPE_BOOLEAN_INPUT || type == XR_ACTION_TYPE_FLOAT_INPUT; };
	return action == source || (isNumber(action) && isNumber(source));
}

} // namespace

size_t Input::slotFor(State &state, const ActionCore &action, XrPath subactionPath)
{
	for (size_t i = 0; i < state.slots.size(); ++i)
		if (state.slots[i].action == &action && state.slots[i].subactionPath == subactionPath) return i;
	state.slots.push_back({&action, subactionPath, {}, {}, XR_NULL_PATH});
	return state.slots.size() - 1;
}

void Input::bind(State &state, const Binding &binding, std::map<XrPath, size_t> &identifiers)
{
	if (std::ranges::find(state.sets, binding.action->set) == state.sets.end()) return;
	const auto [identifier, isNew] = identifiers.try_emplace(binding.identifier, state.highest.size());
	if (isNew) state.highest.push_back(0);
	const size_t own = slotFor(state, *binding.action, binding.user), all = slotFor(state, *binding.action, XR_NULL_PATH);
	state.bounds.push_back({binding, identifier->second, own, all});
	state.profiles.try_emplace(binding.user, XR_NULL_PATH);
}

void Input::attach(std::vector<std::shared_ptr<ActionSetCore>> sets, const Suggestions &suggestions)
{
	state_.update([&](State &state) {
		if (!state.sets.empty()) throw Error(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "action sets were attached to this session before");
		for (const auto &set : sets) set->attached = true;
		state.sets = std::move(sets);
		std::map<XrPath, size_t> identifiers;
		for (const auto &[profile, bindings] : suggestions)
			for (const Binding &binding : bindings) bind(state, binding, identifiers);
	});
}

void Input::requireAttached(const ActionSetCore &set) const
{
	const auto state = state_.lock();
	for (const auto &other : state->sets)
		if (other.get() == &set) return;
	throw Error(XR_ERROR_ACTIONSET_NOT_ATTACHED, "action set \"{}\" is not attached to the session", set.name);
}

bool Input::updateProfiles(State &state)
{
	bool changed = false;
	for (auto &[user, profile] : state.profiles) {
		XrPath now = XR_NULL_PATH;
		if (const auto device = state.devices.find(user); device != state.devices.end() && device->second.isActive)
			for (const Bound &bound : state.bounds)
				if (bound.binding.user == user && bound.binding.profile == device->second.profile) now = device->second.profile;
		changed |= now != profile;
		profile = now;
	}
	return changed;
}

/// Of the action sets that are bound to one input source, those of the highest priority have it.
void Input::chooseUsable(State &state, std::span<const ActiveSet> active)
{
	std::ranges::fill(state.highest, 0);
	for (Bound &bound : state.bounds) {
		const Binding &binding = bound.binding;
		bound.isUsable = false;
		if (state.profiles.at(binding.user) != binding.profile) continue;
		for (const ActiveSet &set : active) {
			if (set.set != binding.action->set.get()) continue;
			if (set.subactionPath != XR_NULL_PATH && set.subactionPath != binding.user) continue;
			bound.isUsable = true;
			bound.priority = set.priority;
			state.highest[bound.identifier] = std::max(state.highest[bound.identifier], set.priority);
		}
	}
	for (Bound &bound : state.bounds) bound.isUsable = bound.isUsable && bound.priority == state.highest[bound.identifier];
}

void Input::read(State &state, Bound &bound)
{
	const Binding &binding = bound.binding;
	if (!canRead(binding.action->type, binding.type)) return;
	const InputDevice &device = state.devices.at(binding.user);
	const InputValue *whole = device.find(binding.source);
	XrVector2f value = whole ? whole->vector : XrVector2f{};
	if (binding.part == SourcePart::dpad) value = directionOf(device, binding, bound.dpad);
	if (binding.part == SourcePart::x || binding.part == SourcePart::y) value = {partOf(device, binding), 0};
	if (binding.action->type == XR_ACTION_TYPE_BOOLEAN_INPUT) {
		bound.isOn = value.x >= (bound.isOn ? pressedUntil : pressedFrom);
		value = {bound.isOn ? 1.0f : 0.0f, 0};
	}
	const bool isPose = binding.type == XR_ACTION_TYPE_POSE_INPUT;
	const std::optional<Placed> place = !isPose ? std::nullopt : whole ? whole->place : device.place;
	merge(state.slots[bound.own].now, value, place);
	// "Action Spaces": of several devices one is picked, and it stays that one.
	Slot &all = state.slots[bound.all];
	if (place && all.placedBy == XR_NULL_PATH) all.placedBy = binding.user;
	merge(all.now, value, all.placedBy == binding.user ? place : std::nullopt);
}

bool Input::synchronize(std::span<const ActiveSet> active, XrTime now)
{
	const auto state = state_.lock();
	const bool profilesChanged = updateProfiles(*state);
	chooseUsable(*state, active);
	for (Slot &slot : state->slots) {
		slot.before = slot.now;
		slot.now = {};
	}
	for (Bound &bound : state->bounds)
		if (bound.isUsable) read(*state, bound);
	for (Slot &slot : state->slots) {
		if (!slot.now.isActive) continue;
		slot.now.changed = !isSame(slot.now.value, slot.before.value);
		slot.now.lastChange = slot.now.changed ? now : slot.before.lastChange;
	}
	return profilesChanged;
}

void Input::rest()
{
	state_.update([](State &state) {
		for (Slot &slot : state.slots) slot.now = {};
	});
}

ActionResult Input::result(const ActionCore &action, XrPath subactionPath) const
{
	const auto state = state_.lock();
	for (const Slot &slot : state->slots)
		if (slot.action == &action && slot.subactionPath == subactionPath) return slot.now;
	return {};
}

XrPath Input::profileOf(XrPath user) const
{
	const auto state = state_.lock();
	const auto found = state->profiles.find(user);
	return found == state->profiles.end() ? XR_NULL_PATH : found->second;
}

std::vector<XrPath> Input::sourcesOf(const ActionCore &action, XrPath subactionPath) const
{
	const auto state = state_.lock();
	std::vector<XrPath> sources;
	for (const Bound &bound : state->bounds) {
		const Binding &binding = bound.binding;
		const bool isMeant = subactionPath == XR_NULL_PATH || binding.user == subactionPath;
		if (binding.action.get() == &action && isMeant && state->profiles.at(binding.user) == binding.profile)
			sources.push_back(binding.source);
	}
	return sources;
}

} // namespace arift::openxr
