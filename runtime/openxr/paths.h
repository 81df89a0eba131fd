// Path atoms: the texts an instance has met. OpenXR 1.1, chapter "Semantic Paths and Path Tree Hierarchy".
#pragma once
#include "runtime/openxr/error.h"
#include <deque>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace arift::openxr
{

/// "Well-Formed Path Strings": absolute, components of a-z 0-9 - _ . that are not only dots, no trailing slash, at most 255 characters.
bool isWellFormedPath(std::string_view path);
/// The same for a single component, as the names of actions and action sets must be.
bool isWellFormedName(std::string_view name);

/// Thread-safe. Atoms live as long as the table.
class PathTable
{
public:
	/// Throws XR_ERROR_PATH_FORMAT_INVALID.
	XrPath atom(std::string_view text);
	/// XR_NULL_PATH for what is no atom yet.
	XrPath known(std::string_view text) const;
	/// Throws XR_ERROR_PATH_INVALID for what atom() never returned.
	const std::string &text(XrPath path) const;

private:
	mutable std::shared_mutex mutex_;
	std::deque<std::string> texts_; ///< atom n is text n - 1; a deque's elements stay where they are
	std::unordered_map<std::string_view, XrPath> atoms_;
};

} // namespace arift::openxr
