// What all that makes arguments has at hand.
#pragma once
#include "tests/fuzz/entry_points/handles.h"
#include "tests/fuzz/entry_points/memory.h"

namespace arift::fuzz
{

/// What a program has so far.
struct State {
	Handles handles;
	unsigned texts = 0; ///< made so far
};

/// One call's arguments on the way.
struct Making {
	State &state;
	Choices choices;
	Memory memory;
	unsigned depth = 0; ///< of structures in structures
	/// Structures may have further ones in their chains, and arrays elements: a call has an end.
	bool mayGrow() const { return depth < 6 && memory.watched() < 100; }
};

/// The head's motion is known from `posesBegin` to `posesEnd`: a usual time lies between.
constexpr XrTime posesBegin = 1'000'000'000, usualTime = 1'050'000'000, posesEnd = 1'100'000'000;

// ---- numbers; `name` says what they mean
uint32_t chooseUnsigned(Making &making, std::string_view name);
int32_t chooseSigned(Making &making, std::string_view name);
/// A path, flags, a system, a version, a handle of any kind …
uint64_t chooseUnsigned64(Making &making, std::string_view name);
/// A time, a duration, a format …
int64_t chooseSigned64(Making &making, std::string_view name);
float chooseFloat(Making &making, std::string_view name);
/// One of an enumeration's, or about as large. `values` may be empty.
int32_t chooseEnum(Making &making, std::span<const int32_t> values);
/// How many elements an array gets; nothing: the array is null, though its count may say otherwise.
struct Size {
	uint32_t count = 0; ///< of elements that are there
	bool isNull = false;
	uint32_t told = 0; ///< what the application says: another number only of an array that is null
};
Size chooseSize(Making &making, uint32_t usual);

} // namespace arift::fuzz
