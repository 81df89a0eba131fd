// The handles that a program has made so far, the destroyed ones among them.
#pragma once
#include "runtime/openxr/handle_table.h"
#include "tests/fuzz/entry_points/choices.h"
#include <type_traits>

namespace arift::fuzz
{

template <typename T, typename = void> inline constexpr bool isComplete = false;
template <typename T> inline constexpr bool isComplete<T, std::void_t<decltype(sizeof(T))>> = true;
/// XrInstance and its like are pointers to structures that nobody defines.
template <typename T> inline constexpr bool isHandle =
	std::is_pointer_v<T> &&std::is_class_v<std::remove_pointer_t<T>> && !isComplete<std::remove_pointer_t<T>>;

/// Of one program.
class Handles
{
public:
	template <typename Handle> void add(Handle handle) { all_.push_back({&kind<Handle>, valueOf(handle)}); }

	/// One of the right kind, or none, or one of another kind, or a number that is no handle.
	template <typename Handle> Handle choose(Choices &choices) const
	{
		const uint64_t value = chooseOf(&kind<Handle>, choices);
		return reinterpret_cast<Handle>(value); // NOLINT(performance-no-int-to-ptr): OpenXR's handles are pointers
	}
	/// One of any kind.
	uint64_t chooseAny(Choices &choices) const
	{
		const uint8_t choice = choices.byte();
		if (choice == noHandle || all_.empty()) return nullHandle;
		return choice == 0 ? all_.back().value : all_[choice % all_.size()].value;
	}
	/// The one made last of those that are still alive; null where there is none.
	template <typename Handle> Handle newest() const
	{
		return reinterpret_cast<Handle>(newestOf(&kind<Handle>)); // NOLINT(performance-no-int-to-ptr)
	}
	template <typename Handle> std::vector<Handle> alive() const
	{
		std::vector<Handle> found;
		for (const Known &known : all_)
			if (known.kind == &kind<Handle> && isAlive(known.value)) found.push_back(reinterpret_cast<Handle>(known.value)); // NOLINT
		return found;
	}
	template <typename Handle> static uint64_t valueOf(Handle handle) { return reinterpret_cast<uint64_t>(handle); }

private:
	static constexpr uint64_t nullHandle = 0;
	static constexpr uint8_t noHandle = 1, otherKind = 2, noSuchHandle = 3;
	/// Its address stands for the kind.
	template <typename Handle> static inline const char kind = 0;
	struct Known {
		const char *kind;
		uint64_t value;
	};
	static bool isAlive(uint64_t value) { return openxr::handles.typeOf(value) != XR_OBJECT_TYPE_UNKNOWN; }
	uint64_t newestOf(const char *wanted) const
	{
		for (auto known = all_.rbegin(); known != all_.rend(); ++known)
			if (known->kind == wanted && isAlive(known->value)) return known->value;
		return nullHandle;
	}
	uint64_t chooseOf(const char *wanted, Choices &choices) const
	{
		const uint8_t choice = choices.byte();
		if (choice == 0) return newestOf(wanted);
		if (choice == noHandle) return nullHandle;
		if (choice == otherKind) return chooseAny(choices);
		// Generations count up from 1: one with this bit set was never given away, in whatever order the inputs are tried.
		if (choice == noSuchHandle) return choices.raw<uint64_t>() | uint64_t(1) << 63;
		std::vector<uint64_t> ofKind;
		for (const Known &known : all_)
			if (known.kind == wanted) ofKind.push_back(known.value);
		return ofKind.empty() ? nullHandle : ofKind[choice % ofKind.size()];
	}
	std::vector<Known> all_;
};

} // namespace arift::fuzz
