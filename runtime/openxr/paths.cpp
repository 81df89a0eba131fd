#include "runtime/openxr/paths.h"
#include <algorithm>

namespace arift::openxr
{

bool isWellFormedName(std::string_view name)
{
	const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.'; };
	return !name.empty() && std::ranges::all_of(name, allowed) && name.find_first_not_of('.') != name.npos;
}

bool isWellFormedPath(std::string_view path)
{
	if (path.size() < 2 || path.size() >= XR_MAX_PATH_LENGTH || path.front() != '/') return false;
	for (size_t begin = 1;;) {
		const size_t end = std::min(path.find('/', begin), path.size());
		if (!isWellFormedName(path.substr(begin, end - begin))) return false;
		if (end == path.size()) return true;
		begin = end + 1;
	}
}

XrPath PathTable::known(std::string_view text) const
{
	std::shared_lock lock(mutex_);
	const auto found = atoms_.find(text);
	return found == atoms_.end() ? XR_NULL_PATH : found->second;
}

XrPath PathTable::atom(std::string_view text)
{
	if (!isWellFormedPath(text)) throw Error(XR_ERROR_PATH_FORMAT_INVALID, "\"{}\" is not a well-formed path", text);
	if (const XrPath found = known(text); found != XR_NULL_PATH) return found;
	std::unique_lock lock(mutex_);
	if (const auto known = atoms_.find(text); known != atoms_.end()) return known->second;
	if (texts_.size() >= 1u << 20) throw Error(XR_ERROR_PATH_COUNT_EXCEEDED, "{} paths exist already", texts_.size());
	const std::string &kept = texts_.emplace_back(text);
	const XrPath added = texts_.size();
	atoms_.emplace(kept, added);
	return added;
}

const std::string &PathTable::text(XrPath path) const
{
	std::shared_lock lock(mutex_);
	if (path == XR_NULL_PATH || path > texts_.size()) throw Error(XR_ERROR_PATH_INVALID, "{} is not a path of this instance", path);
	return texts_[path - 1];
}

} // namespace arift::openxr
