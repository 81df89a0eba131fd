// Values of every type that OpenXR's structures are made of: by the types and names of the members.
#pragma once
#include "runtime/openxr/extensions.h"
#include "tests/fuzz/entry_points/enumerations.h"
#include "tests/fuzz/entry_points/making.h"
#include "tests/fuzz/entry_points/members.h"

namespace arift::fuzz
{

/// Structures with `type` and `next`, as an application would chain them; null for none.
void *chooseChain(Making &making);
/// A structure behind one of the headers that stand for several: XrCompositionLayerBaseHeader, XrHapticBaseHeader … Null for none.
template <typename Header> const Header *chooseHeaded(Making &making);
template <> const XrCompositionLayerBaseHeader *chooseHeaded(Making &making);
template <> const XrHapticBaseHeader *chooseHeaded(Making &making);
template <> const XrBindingModificationBaseHeaderKHR *chooseHeaded(Making &making);
/// Terminated; lives as long as the call.
const char *chooseTextPointer(Making &making, std::string_view name);
/// Into a field of so many characters. It may fill it without an end.
void chooseTextField(Making &making, std::string_view name, std::span<char> field);
XrQuaternionf chooseOrientation(Making &making);
/// Looks at everything that the library hands to it.
XrBool32 XRAPI_CALL hearMessage(XrDebugUtilsMessageSeverityFlagsEXT, XrDebugUtilsMessageTypeFlagsEXT,
								const XrDebugUtilsMessengerCallbackDataEXT *data, void *);

template <typename T> inline constexpr bool hasHead = openxr::structureType<T> != XR_TYPE_UNKNOWN;
template <typename T> inline constexpr bool isHeader = std::is_same_v<T, const XrCompositionLayerBaseHeader> ||
													   std::is_same_v<T, const XrHapticBaseHeader> ||
													   std::is_same_v<T, const XrBindingModificationBaseHeaderKHR>;

template <typename T> void fill(Making &making, T &value, std::string_view name);

/// Counts that stand before an array in a structure: each says how long it is.
class Counts
{
public:
	void note(uint32_t &count, std::string_view name)
	{
		const bool isCount =
			name.find("ount") != name.npos || name.find("apacity") != name.npos || name.ends_with("Size") || name.ends_with("size");
		if (!isCount) return;
		if (isUsed_) counts_.clear();
		isUsed_ = false;
		counts_.push_back(&count);
	}
	/// Of the array that follows. Several arrays may share their counts.
	Size choose(Making &making, uint32_t usual)
	{
		if (!isUsed_) size_ = chooseSize(making, making.mayGrow() ? usual : 0);
		isUsed_ = true;
		if (!making.mayGrow()) size_ = {0, true, 0};
		for (uint32_t *count : counts_) *count = size_.told;
		return size_;
	}

private:
	std::vector<uint32_t *> counts_;
	bool isUsed_ = true;
	Size size_;
};

/// The number of elements where the input says nothing: a view for each eye, all extensions, else one.
uint32_t usualCount(std::string_view name);

/// An array behind a pointer.
template <typename Element> void fillArray(Making &making, Element *&array, std::string_view name, Counts &counts)
{
	using Plain = std::remove_const_t<Element>;
	const Size size = counts.choose(making, usualCount(name));
	array = nullptr;
	if (size.isNull) return;
	auto *elements = making.memory.make<Plain>(size.count);
	for (uint32_t i = 0; i < size.count; ++i) {
		if constexpr (std::is_same_v<Plain, const char *>)
			if (name == "enabledExtensionNames" && size.count == usualCount(name)) {
				elements[i] = openxr::extensionInfos[i].name;
				continue;
			}
		fill(making, elements[i], name);
	}
	array = elements;
}

/// All but `type`.
template <typename T> void fillMembers(Making &making, T &structure)
{
	Counts counts;
	++making.depth;
	Members<T>::visit(structure, [&](std::string_view name, auto &member) {
		using Member = std::remove_reference_t<decltype(member)>;
		using Target = std::remove_pointer_t<Member>;
		if (hasHead<T> && (name == "type" || name == "next")) return;
		constexpr bool isArray = std::is_pointer_v<Member> && !isHandle<Member> && !isHeader<Target> && !std::is_void_v<Target> &&
								 !std::is_function_v<Target> && !std::is_same_v<Target, const char>;
		if constexpr (isArray)
			fillArray(making, member, name, counts);
		else
			fill(making, member, name);
		if constexpr (std::is_same_v<Member, uint32_t>) counts.note(member, name);
	});
	--making.depth;
}

/// A structure where the library knows by the function what it is: its type may be wrong.
template <typename T> void fillStructure(Making &making, T &structure)
{
	if constexpr (hasHead<T>) {
		const uint8_t wrong = making.choices.byte();
		structure.type = wrong < 250 ? openxr::structureType<T> : XrStructureType(making.choices.raw<uint32_t>() & uint32_t(INT32_MAX));
		structure.next = static_cast<decltype(structure.next)>(chooseChain(making));
		making.memory.watch(&structure);
	}
	fillMembers(making, structure);
}

/// A structure that is told by its type, which is right.
template <typename T> void *makeHeaded(Making &making)
{
	T &structure = *making.memory.make<T>(1);
	structure.type = openxr::structureType<T>;
	making.memory.watch(&structure);
	++making.depth;
	structure.next = static_cast<decltype(structure.next)>(chooseChain(making));
	--making.depth;
	fillMembers(making, structure);
	return &structure;
}

template <typename T, size_t size> void fillElements(Making &making, T (&array)[size], std::string_view name)
{
	if constexpr (std::is_same_v<T, char>) {
		chooseTextField(making, name, array);
	} else {
		// Long ones are all the same but for one, which need not be there.
		fill(making, array[0], name);
		for (size_t i = 1; i < size; ++i) array[i] = array[0];
		if (const uint8_t other = making.choices.byte(); other != 0) fill(making, array[other % size], name);
	}
}

template <typename T> void fillPointer(Making &making, T *&pointer, std::string_view name)
{
	if constexpr (isHandle<T *>)
		pointer = making.state.handles.choose<T *>(making.choices);
	else if constexpr (isHeader<T>)
		pointer = chooseHeaded<std::remove_const_t<T>>(making);
	else if constexpr (std::is_same_v<T, const char>)
		pointer = chooseTextPointer(making, name);
	else if constexpr (std::is_same_v<T *, PFN_xrDebugUtilsMessengerCallbackEXT>)
		pointer = making.choices.byte() == 1 ? nullptr : hearMessage;
	else if constexpr (std::is_void_v<T>)
		pointer = nullptr;
	else
		static_assert(std::is_void_v<T>, "arrays are for fillArray");
}

template <typename T> void fill(Making &making, T &value, std::string_view name)
{
	if constexpr (std::is_array_v<T>)
		fillElements(making, value, name);
	else if constexpr (std::is_pointer_v<T>)
		fillPointer(making, value, name);
	else if constexpr (std::is_same_v<T, XrQuaternionf>)
		value = chooseOrientation(making);
	else if constexpr (std::is_class_v<T>)
		fillStructure(making, value);
	else if constexpr (std::is_enum_v<T>)
		value = T(chooseEnum(making, valuesOf<T>));
	else if constexpr (std::is_same_v<T, float>)
		value = chooseFloat(making, name);
	else if constexpr (std::is_same_v<T, uint32_t>)
		value = chooseUnsigned(making, name);
	else if constexpr (std::is_same_v<T, int32_t>)
		value = chooseSigned(making, name);
	else if constexpr (std::is_same_v<T, uint64_t>)
		value = chooseUnsigned64(making, name);
	else if constexpr (std::is_same_v<T, int64_t>)
		value = chooseSigned64(making, name);
	else
		value = making.choices.raw<T>();
}

} // namespace arift::fuzz
