// One call of an entry point: its arguments by the types of its parameters, and what must hold of what it leaves behind.
#pragma once
#include "tests/fuzz/entry_points/structures.h"
#include <functional>
#include <optional>

namespace arift::fuzz
{

/// What decides which losses a function can tell of.
enum class Belonging {
	none, ///< it has no handle
	instance,
	session,
	ends ///< xrDestroy…: works whatever is lost
};

struct Call {
	Making making;
	std::string_view parameters; ///< names of those to come
	/// Whether it may be called with this first argument: nothing is called that would wait for ever.
	std::function<bool(uint64_t handle)> mayBegin;
	std::vector<std::function<void(XrResult)>> afterwards{};
	uint64_t handle = 0; ///< the first argument
	// Of the array that is being made:
	uint32_t capacity = 0;
	uint32_t *count = nullptr;

	/// The next parameter's name.
	std::string_view takeName();
};

/// A pointer to one structure or value that the call reads; null at times.
template <typename Target> const Target *makeInput(Call &call)
{
	constexpr uint8_t none = 255;
	if (call.making.choices.byte() == none) return nullptr;
	auto *input = call.making.memory.make<Target>(1);
	if constexpr (std::is_same_v<Target, timespec>)
		*input = {.tv_sec = chooseSigned64(call.making, "time") / 1'000'000'000, .tv_nsec = chooseSigned(call.making, "nsec")};
	else
		fill(call.making, *input, "");
	const auto *bytes = reinterpret_cast<const uint8_t *>(input);
	call.afterwards.push_back([bytes, before = std::vector(bytes, bytes + sizeof(Target))](XrResult) {
		require(std::memcmp(bytes, before.data(), before.size()) == 0, "what a call only reads stays as it was");
	});
	return input;
}

/// Of xrEnumerate… and the like: exactly `capacity` elements.
template <typename Element> Element *makeElements(Call &call)
{
	constexpr uint8_t none = 255;
	if (call.making.choices.byte() == none) return nullptr;
	auto *elements = call.making.memory.make<Element>(call.capacity);
	if constexpr (hasHead<Element>)
		for (uint32_t i = 0; i < call.capacity; ++i) fill(call.making, elements[i], "");
	if (!call.count) return elements;
	call.afterwards.push_back([capacity = call.capacity, count = call.count](XrResult result) {
		if (result == XR_ERROR_SIZE_INSUFFICIENT) require(*count > capacity, "a size is insufficient where there is more");
		if (result == XR_SUCCESS && capacity > 0) require(*count <= capacity, "no more is there than there was room for");
	});
	if constexpr (std::is_same_v<Element, char>)
		call.afterwards.push_back([capacity = call.capacity, count = call.count, elements](XrResult result) {
			if (result == XR_SUCCESS && capacity > 0) require(*count > 0 && elements[*count - 1] == '\0', "a text is terminated");
		});
	return elements;
}

/// The session under test has Vulkan's images (FakeGraphics).
XrSwapchainImageBaseHeader *makeImages(Call &call);
/// As long as the parameter's name says.
char *makeTextBuffer(Call &call, std::string_view name);
/// xrPollEvent may change its type.
XrEventDataBuffer *makeEvent(Call &call);

/// A place for one thing that the call says.
template <typename Target> Target *makeOutput(Call &call, std::string_view name)
{
	constexpr uint8_t none = 255;
	if (call.making.choices.byte() == none) return nullptr;
	auto *output = call.making.memory.make<Target>(1);
	if constexpr (isHandle<Target>)
		call.afterwards.push_back([output, &handles = call.making.state.handles](XrResult result) {
			if (result >= 0) handles.add(*output);
		});
	else if constexpr (std::is_same_v<Target, PFN_xrVoidFunction>)
		call.afterwards.push_back([output](XrResult result) { require((result >= 0) == (*output != nullptr), "a function is there"); });
	else if constexpr (hasHead<Target>)
		fill(call.making, *output, name);
	return output;
}

uint32_t makeCapacity(Call &call);
uint32_t *makeCount(Call &call);

/// What a parameter is to its neighbours. OpenXR 1.1, "Buffer Size Parameters".
enum class Role { alone, capacity, count, elements };
template <typename... Parameters> constexpr auto rolesOf()
{
	constexpr std::array isNumber{std::is_same_v<Parameters, uint32_t>...}, isPointer{std::is_same_v<Parameters, uint32_t *>...};
	std::array<Role, sizeof...(Parameters)> roles{};
	for (size_t i = 0; i + 2 < roles.size(); ++i) {
		if (!isNumber[i] || !isPointer[i + 1]) continue;
		roles[i] = Role::capacity;
		roles[i + 1] = Role::count;
		roles[i + 2] = Role::elements;
	}
	return roles;
}

/// A pointer that stands alone.
template <typename Target> Target *makePointer(Call &call, std::string_view name)
{
	if constexpr (std::is_same_v<Target, const char>)
		return chooseTextPointer(call.making, name);
	else if constexpr (isHeader<Target>)
		return chooseHeaded<std::remove_const_t<Target>>(call.making);
	else if constexpr (std::is_const_v<Target>)
		return makeInput<std::remove_const_t<Target>>(call);
	else if constexpr (std::is_same_v<Target, XrEventDataBuffer>)
		return makeEvent(call);
	else if constexpr (std::is_same_v<Target, char>)
		return makeTextBuffer(call, name);
	else
		return makeOutput<Target>(call, name);
}

template <typename Parameter, Role role> Parameter makeArgument(Call &call)
{
	const std::string_view name = call.takeName();
	using Target = std::remove_pointer_t<Parameter>;
	if constexpr (role == Role::capacity) {
		return makeCapacity(call);
	} else if constexpr (role == Role::count) {
		return makeCount(call);
	} else if constexpr (role == Role::elements && std::is_same_v<Target, XrSwapchainImageBaseHeader>) {
		return makeImages(call);
	} else if constexpr (role == Role::elements) {
		return makeElements<Target>(call);
	} else if constexpr (!std::is_pointer_v<Parameter> || isHandle<Parameter>) {
		Parameter value{};
		fill(call.making, value, name);
		return value;
	} else {
		return makePointer<Target>(call, name);
	}
}

/// Which losses a function with this first parameter tells of.
template <typename Parameter> inline constexpr Belonging belongingWith =
	!isHandle<Parameter> ? Belonging::none
	: std::is_same_v<Parameter, XrInstance> || std::is_same_v<Parameter, XrActionSet> || std::is_same_v<Parameter, XrAction>
		? Belonging::instance
		: Belonging::session;

template <typename Pfn> struct Caller;
template <typename First, typename... Rest> struct Caller<XrResult (*)(First, Rest...)> {
	static constexpr Belonging belongingOf(std::string_view name)
	{
		return name.starts_with("xrDestroy") ? Belonging::ends : belongingWith<First>;
	}
	/// Nothing where it may not be called.
	static std::optional<XrResult> call(Call &call, PFN_xrVoidFunction function)
	{
		return callWith(call, reinterpret_cast<XrResult (*)(First, Rest...)>(function), std::index_sequence_for<First, Rest...>{});
	}

private:
	using Parameters = std::tuple<First, Rest...>;
	static constexpr auto roles = rolesOf<First, Rest...>();
	template <size_t... i>
	static std::optional<XrResult> callWith(Call &call, XrResult (*function)(First, Rest...), std::index_sequence<i...>)
	{
		Parameters arguments{makeArgument<std::tuple_element_t<i, Parameters>, roles[i]>(call)...}; // braces: left to right
		if constexpr (isHandle<First>) call.handle = Handles::valueOf(std::get<0>(arguments));
		if (!call.mayBegin(call.handle)) return std::nullopt;
		call.making.memory.beforeCall();
		const XrResult result = std::apply(function, arguments);
		call.making.memory.afterCall();
		for (const auto &check : call.afterwards) check(result);
		return result;
	}
};

} // namespace arift::fuzz
