// All entry points: how arguments for each are made, and what it may return.
#pragma once
#include "tests/fuzz/entry_points/call.h"

namespace arift::fuzz
{

struct EntryPoint {
	const char *name;
	/// Names of the parameters, where they say more than their types.
	std::string_view parameters;
	/// What it may return beside what all may, without XR_ and ERROR_. OpenXR 1.1, "Return Codes" of the function.
	std::string_view results;
	std::optional<XrResult> (*call)(Call &call, PFN_xrVoidFunction function);
	Belonging belonging;

	bool mayReturn(XrResult result) const;
};

/// A corpus names functions by their places.
std::span<const EntryPoint> entryPoints();
/// Functions of the library that take objects of a graphics API, or load one.
std::span<const char *const> leftOut();

} // namespace arift::fuzz
