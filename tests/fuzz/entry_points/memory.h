// What a call's pointers point to: blocks of exactly the promised size, so that AddressSanitizer sees every byte beyond, and the structures
// whose `type` and `next` belong to the application.
#pragma once
#include "runtime/openxr/api.h"
#include "tests/fuzz/input.h"
#include <memory>
#include <vector>

namespace arift::fuzz
{

/// Of one call.
class Memory
{
public:
	/// `count` zeroed elements.
	template <typename T> T *make(size_t count)
	{
		static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
		constexpr size_t size = sizeof(T); // NOLINT(bugprone-sizeof-expression): OpenXR's handles are pointers
		std::byte *block = blocks_.emplace_back(new std::byte[count * size]()).get();
		return reinterpret_cast<T *>(block);
	}
	/// A structure that the call must leave its type and its place in the chain.
	void watch(void *structure) { heads_.push_back({static_cast<const XrBaseInStructure *>(structure), {}}); }
	/// How many are watched: what bounds the size of a call.
	size_t watched() const { return heads_.size(); }
	void beforeCall()
	{
		for (Head &head : heads_) head.before = *head.structure;
	}
	void afterCall() const
	{
		for (const auto &[structure, before] : heads_) {
			require(structure->type == before.type, "a structure keeps its type");
			require(structure->next == before.next, "a structure keeps its chain");
		}
	}

private:
	struct Head {
		const XrBaseInStructure *structure;
		XrBaseInStructure before;
	};
	std::vector<std::unique_ptr<std::byte[]>> blocks_;
	std::vector<Head> heads_;
};

} // namespace arift::fuzz
