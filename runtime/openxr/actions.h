// What a session knows of actions: which action sets are attached to it. OpenXR 1.1, chapter "Input and Haptics".
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/openxr/error.h"
#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace arift::openxr
{

/// Names that must not be given twice.
struct Names {
	std::set<std::string, std::less<>> names;
	std::set<std::string, std::less<>> localizedNames;

	/// Throws XR_ERROR_NAME_DUPLICATED or XR_ERROR_LOCALIZED_NAME_DUPLICATED and takes neither.
	void take(const std::string &name, const std::string &localizedName)
	{
		if (names.contains(name)) throw Error(XR_ERROR_NAME_DUPLICATED, "the name \"{}\" is taken", name);
		if (localizedNames.contains(localizedName))
			throw Error(XR_ERROR_LOCALIZED_NAME_DUPLICATED, "the name \"{}\" is taken", localizedName);
		names.insert(name);
		localizedNames.insert(localizedName);
	}
	void giveBack(const std::string &name, const std::string &localizedName)
	{
		names.erase(name);
		localizedNames.erase(localizedName);
	}
};

/// What an action set is to its actions and to the sessions it is attached to; lives on when its handle is destroyed.
struct ActionSetCore {
	std::string name;
	std::string localizedName;
	std::atomic<bool> attached{false}; ///< to any session: unchangeable from then on
	Guarded<Names> actionNames;
	/// Subaction paths that some action of the set was made with.
	Guarded<std::set<XrPath>> subactionPaths;
};

/// The action sets attached to a session. Thread-safe.
class ActionState
{
public:
	/// Throws XR_ERROR_ACTIONSETS_ALREADY_ATTACHED.
	void attach(std::vector<std::shared_ptr<ActionSetCore>> sets)
	{
		auto attached = attached_.lock();
		if (!attached->empty()) throw Error(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "action sets were attached to this session before");
		for (const auto &set : sets) set->attached = true;
		*attached = std::move(sets);
	}
	/// Throws XR_ERROR_ACTIONSET_NOT_ATTACHED.
	void requireAttached(const ActionSetCore &set)
	{
		const auto attached = attached_.lock();
		for (const auto &other : *attached)
			if (other.get() == &set) return;
		throw Error(XR_ERROR_ACTIONSET_NOT_ATTACHED, "action set \"{}\" is not attached to the session", set.name);
	}
	bool hasAny() { return !attached_.lock()->empty(); }

private:
	Guarded<std::vector<std::shared_ptr<ActionSetCore>>> attached_;
};

} // namespace arift::openxr
