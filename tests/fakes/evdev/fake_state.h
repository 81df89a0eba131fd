// What a fake device of input is, in a file beside its node that both ends map.
#pragma once
#include <linux/input.h>

namespace arift::fake
{

constexpr int wordBits = 8 * sizeof(unsigned long);
template <int count> struct Bits {
	unsigned long words[(count + wordBits - 1) / wordBits]{};
	void set(int bit, bool on = true)
	{
		const unsigned long mask = 1ul << bit % wordBits;
		words[bit / wordBits] = on ? words[bit / wordBits] | mask : words[bit / wordBits] & ~mask;
	}
};

struct InputState {
	char name[64]{};
	input_id id{};
	Bits<EV_CNT> types;
	Bits<KEY_CNT> keys, pressed;
	Bits<REL_CNT> relative;
	Bits<ABS_CNT> absolute;
	Bits<FF_CNT> effects;
	input_absinfo axes[ABS_CNT]{};
};

/// The file's name is the node's with this behind it.
constexpr const char *stateEnding = ".state";

} // namespace arift::fake
