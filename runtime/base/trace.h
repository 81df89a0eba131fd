// What happened when, for people: a file in the trace event format that Perfetto and chrome://tracing open (ARIFT_TRACE=file).
#pragma once
#include "runtime/base/unique_fd.h"
#include "runtime/base/xr.h"
#include <atomic>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace arift
{

/// add() takes no lock, allocates nothing and makes no system call: a thread of the trace's own writes the file. Events that come faster
/// than it writes are dropped and counted. The file is whole JSON after every write. A process that is killed in the middle of one leaves
/// whole lines, an event each, and perhaps a torn one behind them, without the closing bracket: readers of the format's array form do
/// without both ("Trace Event Format", JSON Array Format). A file that cannot grow any more, by its limit or because the disk is full,
/// stays as it is and the log says so once.
class Trace
{
public:
	static constexpr size_t capacity = 1 << 14; ///< events between two writes
	static constexpr uint64_t longestFile = uint64_t(64) << 20;

	struct Event {
		const char *name = nullptr; ///< a literal without characters that JSON escapes
		XrTime begin = 0;           ///< real
		XrDuration duration = 0;
		uint32_t track = 0;  ///< a line of its own in the viewer: 0 is the compositor, others are applications' sessions
		uint64_t number = 0; ///< of the frame
	};

	/// Throws InputError where the file cannot be written.
	explicit Trace(const std::filesystem::path &file, uint64_t limit = longestFile);
	~Trace();
	Trace(const Trace &) = delete;

	/// Thread-safe.
	void add(const Event &event) noexcept;
	uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

private:
	/// A slot's turn: n while it is free for event n, n + 1 once event n lies in it.
	struct Slot {
		std::atomic<uint64_t> turn;
		Event event;
	};

	bool take(Event &event);
	void append(const Event &event);
	void drain();
	bool write(const std::string &text);

	const std::filesystem::path file_;
	const uint64_t limit_;
	UniqueFd fd_;
	std::vector<Slot> slots_;
	std::atomic<uint64_t> next_{0}; ///< the number of the next event added
	std::atomic<uint64_t> dropped_{0};
	std::atomic<bool> ended_{false};
	uint64_t taken_ = 0; ///< from here on the writer's alone
	uint64_t end_ = 0;   ///< where the closing bracket stands
	std::set<uint32_t> named_;
	std::string text_;
	std::jthread writer_;
};

} // namespace arift
