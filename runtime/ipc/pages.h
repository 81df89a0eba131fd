// What the service publishes in shared memory that applications map read-only. Plain fixed-width data behind sequence words.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/base/gamepad.h"
#include "runtime/base/pose.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

namespace arift::ipc
{

/// One writer, many readers of a small plain value. Two slots in turn, each with a sequence word that is odd while the slot is written:
/// while one is written the other can be read, also when the writer sleeps half-way or has been killed.
template <typename T> class Published
{
	static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0);

public:
	void write(const T &value)
	{
		std::array<uint64_t, sizeof(T) / 8> words;
		std::memcpy(words.data(), &value, sizeof(T));
		const uint32_t next = version_.load(std::memory_order_relaxed) + 1;
		Slot &slot = slots_[next % 2];
		slot.sequence.store(2 * next - 1, std::memory_order_relaxed);
		std::atomic_thread_fence(std::memory_order_release);
		for (size_t i = 0; i < words.size(); ++i) slot.words[i].store(words[i], std::memory_order_relaxed);
		slot.sequence.store(2 * next, std::memory_order_release);
		version_.store(next, std::memory_order_release);
	}
	/// False only when the page holds what no writer leaves there, or when it was overtaken twice by the writer in every one of many
	/// tries; `value` is garbage then.
	bool read(T &value) const
	{
		for (int attempt = 0; attempt < 64; ++attempt) {
			const uint32_t newest = version_.load(std::memory_order_acquire);
			const Slot &slot = slots_[newest % 2];
			const uint32_t before = slot.sequence.load(std::memory_order_acquire);
			copyWords(slot, value, std::make_index_sequence<sizeof(T) / 8>{});
			std::atomic_thread_fence(std::memory_order_acquire);
			if (before == 2 * newest && before == slot.sequence.load(std::memory_order_relaxed)) return true;
		}
		return false;
	}
	std::optional<T> read() const
	{
		std::optional<T> value{std::in_place};
		if (!read(*value)) value.reset();
		return value;
	}
	/// Changes with every write: a cheap way to see that there is news.
	uint32_t version() const { return version_.load(std::memory_order_acquire); }

private:
	struct Slot {
		std::atomic<uint32_t> sequence{0};
		uint32_t reserved = 0;
		std::array<std::atomic<uint64_t>, sizeof(T) / 8> words{};
	};
	/// Without a loop: poses are asked for thousands of times a second.
	template <size_t... i> static void copyWords(const Slot &slot, T &value, std::index_sequence<i...>)
	{
		const auto copyWord = [&](size_t n) {
			const uint64_t word = slot.words[n].load(std::memory_order_relaxed);
			std::memcpy(reinterpret_cast<std::byte *>(&value) + 8 * n, &word, 8);
		};
		(copyWord(i), ...);
	}
	std::atomic<uint32_t> version_{0};
	uint32_t reserved_ = 0;
	std::array<Slot, 2> slots_{};
};

/// When a camera's images are taken and when they are there: exposures at reference + k * period, usable `delay` later.
struct CameraTiming {
	XrTime reference = 0;  ///< mid-exposure of a recent image
	XrDuration period = 0; ///< 0: no camera
	XrDuration delay = 0;  ///< from mid-exposure until the compositor can take it
};

/// Everything that decides where views are and how spaces lie. Changes rarely, always as a whole.
struct ViewTable {
	std::array<XrPosef, 2> eyeInHead;
	std::array<XrPosef, 2> cameraInHead;
	std::array<XrFovf, 2> fov;
	float viewOffset = 1; ///< 0 = views at the eyes, 1 = at the cameras
	float reserved = 0;
	XrVector3f pivotInHead{};             ///< the neck model's
	float floorBelowLocal = 0;            ///< metres from LOCAL's origin down to the floor
	XrPosef localInOrigin = identityPose; ///< level: heading and position only
	std::array<float, 2> stageBounds{};   ///< metres, width and depth around STAGE's origin
	uint32_t recenterCount = 0;
};

/// What an eye's lens shows of its view, in the plane z = -1: counter-clockwise around `centre`, within the field of view, with a point in
/// the direction of each of its corners.
struct LensOutline {
	static constexpr uint32_t mostPoints = 64;
	uint32_t count = 0;
	uint32_t reserved = 0;
	XrVector2f centre{};
	std::array<XrVector2f, mostPoints> points{};
};
/// By eye. Written once.
using LensOutlines = std::array<LensOutline, 2>;

/// Whether there is a headset to use.
struct HeadsetState {
	uint32_t isMissing = 0;
	uint32_t reserved = 0;
	char problem[240]{}; ///< where it is: why, in a sentence that says what to do
};

/// What changes with every camera image or refresh.
struct TimingTable {
	std::array<CameraTiming, 2> cameras;
	XrDuration displayPeriod = 0;      ///< measured
	XrTime lastDisplayTime = 0;        ///< of the middle line, of the newest image presented
	XrDuration latchBeforeDisplay = 0; ///< the compositor takes camera images this long before the middle line's display time
};

struct ClockTable {
	XrTime realAnchor = 0;
	XrTime xrAnchor = 0;
	double rate = 1;
};

/// One per service, mapped read-only by every client.
struct SystemPage {
	uint32_t protocol = 0;
	uint32_t reserved = 0;
	std::atomic<int64_t> heartbeat{0}; ///< CLOCK_MONOTONIC ns, at least every 100 ms of real time
	Published<ClockTable> clock;
	Published<ViewTable> views;
	Published<TimingTable> timing;
	Published<HeadsetState> headset;
	Published<LensOutlines> lensOutlines;
};

enum class EventType : uint32_t {
	none,
	visibilityChanged,
	exitRequested,
	recentered,
	lossPending,
	mainVisibilityChanged ///< for overlay sessions: of the main session
};

struct Event {
	EventType type = EventType::none;
	uint32_t session = 0;
	XrTime time = 0;
	uint32_t visible = 0, focused = 0;
	XrPosef pose = identityPose; ///< recentered: the new space's origin in the old one
	uint32_t flags = 0;          ///< mainVisibilityChanged: XrOverlayMainSessionFlagsEXTX
};

/// What a hand without a controller says by other devices: of khr/simple_controller.
struct HandState {
	uint32_t isThere = 0;
	uint32_t select = 0, menu = 0; ///< 1: pressed
	uint32_t reserved = 0;
	XrPosef aimInView = identityPose, gripInView = identityPose;
};

/// The devices of input that a person has switched on, as they are now; at rest for an application without the focus.
struct InputTable {
	std::array<HandState, 2> hands; ///< left, right
	uint32_t hasGamepad = 0;
	GamepadState gamepad;
};

/// One per application, mapped read-only by it alone.
struct ClientPage {
	static constexpr uint32_t eventSlots = 64;
	/// Events written so far; event n lies in slot n % eventSlots. A reader that falls behind by more has lost the oldest.
	std::atomic<uint64_t> eventCount{0};
	std::array<Published<Event>, eventSlots> events;
	Published<InputTable> input;
	/// The oldest submission (its frame number) whose images the compositor may still read. Images last used by an earlier one are free.
	std::atomic<uint64_t> oldestHeldFrame{0};
};

} // namespace arift::ipc
