// What action sets and actions are to those that outlive their handles: bindings and sessions. OpenXR 1.1, chapter "Input and Haptics".
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/openxr/error.h"
#include <atomic>
#include <memory>
#include <set>
#include <string>

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
	uint32_t priority = 0;
	std::atomic<bool> attached{false}; ///< to any session: unchangeable from then on
	Guarded<Names> actionNames;
	/// Subaction paths that some action of the set was made with.
	Guarded<std::set<XrPath>> subactionPaths;
};

/// What an action is to its bindings and to action spaces. Immutable.
struct ActionCore {
	std::shared_ptr<ActionSetCore> set;
	XrActionType type;
	std::string name;
	std::string localizedName;
	std::set<XrPath> subactionPaths;
};

} // namespace arift::openxr
