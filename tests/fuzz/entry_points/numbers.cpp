#include "runtime/openxr/extensions.h"
#include "tests/fuzz/entry_points/making.h"
#include "tests/fuzz/entry_points/texts.h"
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace arift::fuzz
{
namespace
{

template <typename Value> struct Usual {
	std::string_view name; ///< how the names end that have it
	Value value;
};
template <typename Value, size_t size> Value find(const std::array<Usual<Value>, size> &all, std::string_view name, Value other)
{
	for (const auto &[ending, value] : all)
		if (name.ends_with(ending)) return value;
	return other;
}

/// Small enough for every swapchain and every rectangle.
constexpr uint32_t extent = 16;

constexpr std::array unsignedOnes{
	Usual<uint32_t>{"width", extent}, Usual<uint32_t>{"height", extent}, Usual<uint32_t>{"sampleCount", 1}, Usual<uint32_t>{"faceCount", 1},
	Usual<uint32_t>{"arraySize", 1},  Usual<uint32_t>{"mipCount", 1},    Usual<uint32_t>{"isActive", 1},    Usual<uint32_t>{"enabled", 1},
	Usual<uint32_t>{"state", 1},      Usual<uint32_t>{"depthMask", 1},
};

constexpr std::array floats{
	Usual<float>{"minDepth", 0},
	Usual<float>{"maxDepth", 1},
	Usual<float>{"nearZ", 0.1f},
	Usual<float>{"farZ", 100},
	Usual<float>{"NearZ", 0},
	Usual<float>{"FarZ", 10},
	Usual<float>{"lowerVerticalAngle", -0.5f},
	Usual<float>{"angleLeft", -0.7f},
	Usual<float>{"angleRight", 0.7f},
	Usual<float>{"angleUp", 0.7f},
	Usual<float>{"angleDown", -0.7f},
	Usual<float>{"displayRefreshRate", 0},
};

constexpr std::array paths{
	Usual<std::string_view>{"interactionProfile", "/interaction_profiles/khr/simple_controller"},
	Usual<std::string_view>{"topLevelUserPath", "/user/hand/left"},
	Usual<std::string_view>{"topLevelPath", "/user/hand/left"},
	Usual<std::string_view>{"subactionPaths", "/user/hand/left"},
	Usual<std::string_view>{"subactionPath", ""},
	Usual<std::string_view>{"counterPath", "/perfmetrics_meta/app/cpu_frametime"},
	Usual<std::string_view>{"ourcePath", "/user/hand/left/input/select/click"},
	Usual<std::string_view>{"binding", "/user/hand/left/input/select/click"},
	Usual<std::string_view>{"path", "/user/hand/left"},
};

constexpr std::array flags{
	Usual<uint64_t>{"usageFlags", XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT},
	Usual<uint64_t>{"whichComponents", 7},
	Usual<uint64_t>{"everities", 0x1111},
	Usual<uint64_t>{"messageTypes", 15},
	Usual<uint64_t>{"everity", 0x1000},
	Usual<uint64_t>{"lags", 0},
};

template <typename Value, size_t size> bool isAmong(const std::array<Usual<Value>, size> &all, std::string_view name)
{
	return std::ranges::any_of(all, [&](const Usual<Value> &usual) { return name.ends_with(usual.name); });
}

uint64_t choosePath(Choices &choices, std::string_view name)
{
	const uint8_t choice = choices.byte();
	if (choice == 0) return knownPath(find(paths, name, std::string_view()));
	if (choice == 254) return choices.raw<uint64_t>();
	return choice == 255 ? UINT64_MAX : choice - 1u; // 0, an atom, or none as yet
}

uint64_t chooseFlags(Choices &choices, std::string_view name)
{
	const uint8_t choice = choices.byte();
	if (choice == 0) return find(flags, name, uint64_t(0));
	if (choice <= 64) return uint64_t(1) << (choice - 1);
	if (choice < 254) return choice - 65u;
	return choice == 254 ? choices.raw<uint64_t>() : UINT64_MAX;
}

uint64_t chooseVersion(Choices &choices)
{
	switch (choices.byte()) {
	case 0: return XR_API_VERSION_1_1;
	case 1: return XR_API_VERSION_1_0;
	case 2: return XR_MAKE_VERSION(1, 2, 0);
	case 3: return 0;
	default: return choices.raw<uint64_t>();
	}
}

int64_t chooseTime(Choices &choices)
{
	const uint8_t choice = choices.byte();
	if (choice == 0) return usualTime;
	if (choice < 200) return posesBegin - 20'000'000 + choice * 1'000'000; // before, within and after what is known of the head
	constexpr std::array extremes{int64_t(0), int64_t(-1), int64_t(1), INT64_MIN, INT64_MAX, INT64_MAX - 1, int64_t(1) << 62};
	return choice < 200 + extremes.size() ? extremes[choice - 200u] : choices.raw<int64_t>();
}

/// What is waited for comes at once, or never: nothing depends on how fast the machine is.
int64_t chooseDuration(Choices &choices)
{
	constexpr std::array all{int64_t(0), INT64_MAX, int64_t(-1), INT64_MIN, INT64_MAX - 1, int64_t(10'000'000'000)};
	return all[choices.byte() % all.size()];
}

int64_t chooseFormat(Choices &choices)
{
	constexpr std::array all{VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_D32_SFLOAT, VK_FORMAT_UNDEFINED, VK_FORMAT_B8G8R8A8_SRGB};
	const uint8_t choice = choices.byte();
	return choice < all.size() ? all[choice] : choices.raw<int64_t>();
}

} // namespace

uint32_t chooseUnsigned(Making &making, std::string_view name)
{
	const uint8_t choice = making.choices.byte();
	if (choice == 0) return find(unsignedOnes, name, 0u);
	if (choice < 240) return choice - 1u;
	constexpr std::array extremes{UINT32_MAX, uint32_t(INT32_MAX), 0x80000000u, 256u, 1024u, 4096u, 4097u};
	return choice < 240 + extremes.size() ? extremes[choice - 240u] : making.choices.raw<uint32_t>();
}

int32_t chooseSigned(Making &making, std::string_view name) { return int32_t(chooseUnsigned(making, name)); }

uint64_t chooseUnsigned64(Making &making, std::string_view name)
{
	if (isAmong(paths, name)) return choosePath(making.choices, name);
	if (isAmong(flags, name)) return chooseFlags(making.choices, name);
	if (name.ends_with("ersion")) return chooseVersion(making.choices);
	if (name == "objectHandle") return making.state.handles.chooseAny(making.choices);
	const uint8_t choice = making.choices.byte();
	if (choice == 0) return name == "systemId" ? 1 : 0;
	return choice == 255 ? making.choices.raw<uint64_t>() : choice - 1u;
}

int64_t chooseSigned64(Making &making, std::string_view name)
{
	if (name == "timeout" || name == "duration") return chooseDuration(making.choices);
	if (name == "format") return chooseFormat(making.choices);
	return chooseTime(making.choices);
}

float chooseFloat(Making &making, std::string_view name)
{
	using Limits = std::numeric_limits<float>;
	constexpr float pi = std::numbers::pi_v<float>;
	constexpr std::array special{0.0f,
								 -0.0f,
								 1.0f,
								 -1.0f,
								 Limits::quiet_NaN(),
								 Limits::infinity(),
								 -Limits::infinity(),
								 Limits::denorm_min(),
								 -Limits::denorm_min(),
								 Limits::max(),
								 Limits::lowest(),
								 Limits::min(),
								 pi,
								 -pi,
								 pi / 2,
								 2 * pi,
								 1e6f,
								 1e-6f};
	const uint8_t choice = making.choices.byte();
	if (choice == 0) return find(floats, name, 0.5f);
	if (choice <= special.size()) return special[choice - 1u];
	return choice < 240 ? float(choice - 128) / 32 : making.choices.raw<float>();
}

int32_t chooseEnum(Making &making, std::span<const int32_t> values)
{
	const uint8_t choice = making.choices.byte();
	if (choice < values.size()) return values[choice];
	// No negative ones: enumerations that have none of these have no room for them in C++.
	return int32_t((choice < 240 ? choice : making.choices.raw<uint32_t>()) & uint32_t(INT32_MAX));
}

Size chooseSize(Making &making, uint32_t usual)
{
	const uint8_t choice = making.choices.byte();
	if (choice == 0) return {usual, usual == 0, usual};
	if (choice == 1) return {0, true, 0};
	if (choice == 2) return {0, true, 1};
	const uint32_t count = choice < 200 ? choice % 17u : (choice - 199u) * 4;
	return {count, false, count};
}

} // namespace arift::fuzz
