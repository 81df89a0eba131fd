#include "runtime/base/trace.h"
#include "runtime/base/error.h"
#include "runtime/base/log.h"
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <unistd.h>

namespace arift
{

namespace
{

constexpr auto pause = std::chrono::milliseconds(100);
constexpr std::string_view opening = R"([
{"name":"process_name","ph":"M","pid":1,"tid":0,"args":{"name":"arift-service"}})";
constexpr std::string_view closing = "\n]\n";

std::string trackName(uint32_t track) { return track == 0 ? "compositor" : fmt::format("session {}", track); }

double inMicroseconds(XrDuration duration) { return double(duration) * 1e-3; }

} // namespace

Trace::Trace(const std::filesystem::path &file, uint64_t limit)
	: file_(file), limit_(limit), fd_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)), slots_(capacity)
{
	if (!fd_) throw InputError("ARIFT_TRACE={}: {}", file.string(), std::strerror(errno));
	for (size_t i = 0; i < capacity; ++i) slots_[i].turn.store(i, std::memory_order_relaxed);
	if (!write(std::string(opening))) throw InputError("ARIFT_TRACE={}: {}", file.string(), std::strerror(errno));
	writer_ = std::jthread([this](const std::stop_token &stop) {
		std::mutex mutex;
		std::condition_variable_any wake;
		std::unique_lock lock(mutex);
		while (!stop.stop_requested()) {
			wake.wait_for(lock, stop, pause, [] { return false; });
			drain();
		}
		drain(); // what came before the first turn, when it was also the last
	});
}

Trace::~Trace() = default;

void Trace::add(const Event &event) noexcept
{
	if (ended_.load(std::memory_order_relaxed)) return;
	for (uint64_t number = next_.load(std::memory_order_relaxed);;) {
		Slot &slot = slots_[number % capacity];
		const uint64_t turn = slot.turn.load(std::memory_order_acquire);
		if (turn < number) { // not yet written from the last time round
			dropped_.fetch_add(1, std::memory_order_relaxed);
			return;
		}
		if (turn > number) {
			number = next_.load(std::memory_order_relaxed);
			continue;
		}
		if (!next_.compare_exchange_weak(number, number + 1, std::memory_order_relaxed)) continue;
		slot.event = event;
		slot.turn.store(number + 1, std::memory_order_release);
		return;
	}
}

bool Trace::take(Event &event)
{
	Slot &slot = slots_[taken_ % capacity];
	if (slot.turn.load(std::memory_order_acquire) != taken_ + 1) return false;
	event = slot.event;
	slot.turn.store(taken_ + capacity, std::memory_order_release);
	taken_++;
	return true;
}

void Trace::append(const Event &event)
{
	if (named_.insert(event.track).second)
		text_ += fmt::format(R"(,
{{"name":"thread_name","ph":"M","pid":1,"tid":{},"args":{{"name":"{}"}}}})",
							 event.track + 1, trackName(event.track));
	text_ += fmt::format(R"(,
{{"name":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},"dur":{:.3f},"args":{{"frame":{}}}}})",
						 event.name, event.track + 1, inMicroseconds(event.begin), inMicroseconds(event.duration), event.number);
}

void Trace::drain()
{
	text_.clear();
	for (Event event; take(event);)
		if (!ended_) append(event);
	if (text_.empty()) return;
	if (end_ + text_.size() > limit_) {
		ended_ = true;
		log::warning("the trace {} has {} MiB: nothing more is written to it", file_.string(), end_ >> 20);
	} else if (!write(text_)) {
		ended_ = true;
		log::warning("the trace {} ends here: {}", file_.string(), std::strerror(errno));
	}
}

/// In place of the closing bracket, with a new one behind it; where that fails, as it was.
bool Trace::write(const std::string &text)
{
	const std::string whole = text + std::string(closing);
	ssize_t written = 0;
	while ((written = ::pwrite(fd_.get(), whole.data(), whole.size(), off_t(end_))) < 0 && errno == EINTR) {}
	if (written == ssize_t(whole.size())) {
		end_ += text.size();
		return true;
	}
	const int reason = written < 0 ? errno : ENOSPC;
	if (end_ > 0 && ::pwrite(fd_.get(), closing.data(), closing.size(), off_t(end_)) == ssize_t(closing.size())) [[maybe_unused]]
		const int cut = ::ftruncate(fd_.get(), off_t(end_ + closing.size()));
	errno = reason;
	return false;
}

} // namespace arift
