// Turns a C++ function whose parameter types state its preconditions into an OpenXR C entry point. Handles, null pointers, structure types,
// the two-call idiom and the only catch site exist once, here.
//   Session &            a live handle of the right kind          const T &        a non-null structure of the right type
//   EvenIfLost<Session>  the same, also when its service is gone  const T *        may be null
//   InputArray<T>        count and pointer                        OutputArray<T>   capacity, count and pointer
#pragma once
#include "runtime/openxr/handle_table.h"
#include <algorithm>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

namespace arift::openxr
{

template <typename T> void requireType(const T *structure)
{
	using Struct = std::remove_const_t<T>;
	if constexpr (structureType<Struct> != XR_TYPE_UNKNOWN)
		if (structure->type != structureType<Struct>)
			throw Error(XR_ERROR_VALIDATION_FAILURE, "the structure's type is {}, not {}", int(structure->type),
						nameOf(structureType<Struct>));
}

template <typename T> struct InputArray : std::span<const T> {
	using std::span<const T>::span;
};

/// An array the application asks the size of first. OpenXR 1.1, "Buffer Size Parameters".
template <typename T> struct OutputArray {
	uint32_t capacity;
	uint32_t *count;
	T *elements;

	XrResult assign(std::span<const T> values) const
	{
		return fill(uint32_t(values.size()), [&](uint32_t i, T &element) { element = values[i]; });
	}
	/// Elements with `type` and `next` keep them: write(i, element) sets the rest.
	template <typename Write> XrResult fill(uint32_t size, Write write) const
	{
		*count = size;
		if (capacity == 0) return XR_SUCCESS;
		if (capacity < size) return XR_ERROR_SIZE_INSUFFICIENT;
		if (!elements) throw Error(XR_ERROR_VALIDATION_FAILURE, "the array is null but its capacity is {}", capacity);
		for (uint32_t i = 0; i < size; ++i) requireType(&elements[i]);
		for (uint32_t i = 0; i < size; ++i) write(i, elements[i]);
		return XR_SUCCESS;
	}
};

/// A text in a buffer of the application's; its terminating NUL counts.
inline XrResult assignText(const OutputArray<char> &buffer, std::string_view text)
{
	return buffer.fill(uint32_t(text.size() + 1), [&](uint32_t i, char &c) { c = i < text.size() ? text[i] : '\0'; });
}

/// A live handle of the right kind, whether or not its service can still be reached.
template <HandleObject T> struct EvenIfLost {
	T *object;
	T *operator->() const { return object; }
	T &operator*() const { return *object; }
};

template <typename P> constexpr bool isHandle = false;
template <HandleObject T> constexpr bool isHandle<T &> = true;
template <HandleObject T> constexpr bool isHandle<EvenIfLost<T>> = true;

// ---- From<Parameter>: how many C arguments a parameter takes, and how it is made of them and checked

template <typename P> struct From {
	static constexpr size_t arity = 1;
	static P make(P value) { return value; }
};
template <typename T> struct From<T &> {
	static constexpr size_t arity = 1;
	static T &make(T *pointer)
	{
		if (!pointer) throw Error(XR_ERROR_VALIDATION_FAILURE, "a required pointer is null");
		requireType(pointer);
		return *pointer;
	}
};
template <typename T> struct From<const T *> {
	static constexpr size_t arity = 1;
	static const T *make(const T *pointer)
	{
		if (pointer) requireType(pointer);
		return pointer;
	}
};
template <HandleObject T> struct From<T &> {
	static constexpr size_t arity = 1;
	static T &make(typename HandleOf<std::remove_const_t<T>>::type handle)
	{
		T &object = handles.at<T>(handle);
		object.requireAlive();
		return object;
	}
};
template <HandleObject T> struct From<EvenIfLost<T>> {
	static constexpr size_t arity = 1;
	static EvenIfLost<T> make(typename HandleOf<std::remove_const_t<T>>::type handle) { return {&handles.at<T>(handle)}; }
};
template <typename T> struct From<InputArray<T>> {
	static constexpr size_t arity = 2;
	static InputArray<T> make(uint32_t count, const T *elements)
	{
		if (count > 0 && !elements) throw Error(XR_ERROR_VALIDATION_FAILURE, "an array is null but its count is {}", count);
		return {elements, count};
	}
};
template <typename T> struct From<OutputArray<T>> {
	static constexpr size_t arity = 3;
	static OutputArray<T> make(uint32_t capacity, uint32_t *count, T *elements)
	{
		if (!count) throw Error(XR_ERROR_VALIDATION_FAILURE, "the pointer to the count is null");
		return {capacity, count, elements};
	}
};

template <typename Parameter, size_t first, typename Arguments> Parameter makeParameter(const Arguments &arguments)
{
	return [&]<size_t... i>(std::index_sequence<i...>)->Parameter { return From<Parameter>::make(std::get<first + i>(arguments)...); }
	(std::make_index_sequence<From<Parameter>::arity>{});
}

/// The text of a template argument.
template <size_t size> struct FixedText {
	char text[size];
	constexpr FixedText(const char (&from)[size]) { std::copy_n(from, size, text); }
};

/// EntryPoint<"xrWaitFrame", PFN_xrWaitFrame, waitFrame>::call has exactly the C signature.
template <FixedText name, typename Pfn, auto function> struct EntryPoint;
template <FixedText name, typename... Raw, typename Result, typename... Parameters, Result (*function)(Parameters...)>
struct EntryPoint<name, XrResult (*)(Raw...), function> {
	/// Where in the C arguments each parameter begins.
	static constexpr auto firsts = [] {
		std::array<size_t, sizeof...(Parameters) + 1> at{};
		size_t next = 0, parameter = 0;
		((at[parameter++] = next, next += From<Parameters>::arity), ...);
		at[parameter] = next;
		return at;
	}();
	static_assert(firsts.back() == sizeof...(Raw));

	static XRAPI_ATTR XrResult XRAPI_CALL call(Raw... raw)
	{
		try {
			return checked(std::tuple<Raw...>(raw...), std::index_sequence_for<Parameters...>{});
		} catch (...) {
			return report(name.text, handleIn(raw...));
		}
	}

private:
	/// The handle a function is called with, which is its first argument; 0 for a function without one.
	static uint64_t handleIn(auto first, auto...)
	{
		if constexpr (isHandle<std::tuple_element_t<0, std::tuple<Parameters...>>>)
			return reinterpret_cast<uint64_t>(first);
		else
			return 0;
	}
	template <size_t... i> static XrResult checked(const std::tuple<Raw...> &raw, std::index_sequence<i...>)
	{
		std::tuple<Parameters...> parameters{makeParameter<Parameters, firsts[i]>(raw)...}; // braces: left to right
		if constexpr (std::is_void_v<Result>) {
			std::apply(function, parameters);
			return XR_SUCCESS;
		} else {
			return std::apply(function, parameters);
		}
	}
};

} // namespace arift::openxr
