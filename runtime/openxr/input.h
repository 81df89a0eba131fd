// What a session knows of its actions: which sets are attached, what they are bound to, and their states as of the last synchronization.
// OpenXR 1.1, chapter "Input and Haptics", above all "Reading Input Action State". Knows no clock and no device.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/openxr/bindings.h"
#include "runtime/openxr/input_devices.h"
#include <algorithm>
#include <span>

namespace arift::openxr
{

/// One of XrActionsSyncInfo's active action sets.
struct ActiveSet {
	const ActionSetCore *set;
	XrPath subactionPath; ///< XR_NULL_PATH: all
	uint32_t priority;
};

/// An action's state for one subaction path, or for all together.
struct ActionResult {
	bool isActive = false;
	XrVector2f value{}; ///< x alone for numbers; 0 or 1 for booleans
	bool changed = false;
	XrTime lastChange = 0;
	std::optional<Placed> place; ///< poses
};

/// Thread-safe.
class Input
{
public:
	/// `suggestions`: what the instance's application has suggested. Throws XR_ERROR_ACTIONSETS_ALREADY_ATTACHED.
	void attach(std::vector<std::shared_ptr<ActionSetCore>> sets, const Suggestions &suggestions);
	/// Throws XR_ERROR_ACTIONSET_NOT_ATTACHED.
	void requireAttached(const ActionSetCore &set) const;
	bool hasAttached() const { return !state_.lock()->sets.empty(); }

	/// The devices, for whoever speaks for them.
	template <typename Change> void changeDevices(Change change)
	{
		state_.update([&](State &state) { change(state.devices); });
	}
	/// Every action's state as the devices have it at `now`. Says whether an interaction profile has changed. Allocates nothing where no
	/// device is.
	bool synchronize(std::span<const ActiveSet> active, XrTime now);
	/// The session has not the focus: every action is inactive.
	void rest();

	/// `subactionPath`: XR_NULL_PATH for all together.
	ActionResult result(const ActionCore &action, XrPath subactionPath) const;
	/// XR_NULL_PATH where no device is, or none for which something was suggested.
	XrPath profileOf(XrPath user) const;
	/// What is bound to the action at the moment. `subactionPath`: XR_NULL_PATH for all together.
	std::vector<XrPath> sourcesOf(const ActionCore &action, XrPath subactionPath) const;

private:
	struct Slot {
		const ActionCore *action;
		XrPath subactionPath;
		ActionResult now, before;
		XrPath placedBy = XR_NULL_PATH; ///< whose device places a pose: the first that did, for good
	};
	struct Bound {
		Binding binding;
		size_t identifier;     ///< index in highest
		size_t own, all;       ///< indices in slots: its user path's, and of all together
		bool isUsable = false; ///< by its device and its action set, at this synchronization
		uint32_t priority = 0; ///< of its action set, at this synchronization
		bool isOn = false;     ///< of a number that a boolean action is bound to
		Dpad dpad;
	};
	struct State {
		std::vector<std::shared_ptr<ActionSetCore>> sets;
		std::vector<Bound> bounds;
		std::vector<Slot> slots;
		std::vector<uint32_t> highest;     ///< priority that competes for each identifier
		std::map<XrPath, XrPath> profiles; ///< current, by user path
		InputDevices devices;
	};
	static size_t slotFor(State &state, const ActionCore &action, XrPath subactionPath);
	static void bind(State &state, const Binding &binding, std::map<XrPath, size_t> &identifiers);
	static bool updateProfiles(State &state);
	static void chooseUsable(State &state, std::span<const ActiveSet> active);
	static void read(State &state, Bound &bound);

	mutable Guarded<State> state_;
};

} // namespace arift::openxr
