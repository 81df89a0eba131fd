// Texts that the library knows, and others.
#pragma once
#include "tests/fuzz/entry_points/choices.h"
#include <string>

namespace arift::fuzz
{

/// Every instance gets these as its first path atoms: number n is text n - 1.
std::span<const char *const> knownPaths();
/// The atom of one of them; XR_NULL_PATH for a text that is not among them.
uint64_t knownPath(std::string_view text);

/// A text for what is called `name`: a path, an extension or a function where that is meant, or something that is none. No byte of it is
/// 0. `made`: how many texts the program has made, so that names differ.
std::string chooseText(Choices &choices, std::string_view name, unsigned &made);

} // namespace arift::fuzz
