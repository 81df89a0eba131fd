// What an input says, one choice after another.
#pragma once
#include "tests/fuzz/input.h"
#include <cstring>

namespace arift::fuzz
{

/// Behind the end of the bytes every choice is 0, which stands for what applications usually do: a call without bytes is a good one.
class Choices
{
public:
	explicit Choices(Bytes bytes) : bytes_(bytes) {}
	uint8_t byte() { return raw<uint8_t>(); }
	template <typename T> T raw()
	{
		T value{};
		const size_t size = std::min(sizeof(T), bytes_.size());
		if (size > 0) std::memcpy(&value, bytes_.data(), size);
		bytes_ = bytes_.subspan(size);
		return value;
	}

private:
	Bytes bytes_;
};

} // namespace arift::fuzz
