#include "runtime/base/log.h"
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <unistd.h>

namespace arift::log
{

namespace
{

std::atomic<int> defaultLevel{int(Level::info)};

int levelFromEnvironment()
{
	const char *text = std::getenv("ARIFT_LOG");
	if (!text) return -1;
	constexpr std::string_view names[] = {"debug", "info", "warning", "error", "off"};
	for (int level = 0; level < 5; ++level)
		if (names[level] == text) return level;
	return -1;
}

} // namespace

Level threshold()
{
	static const int chosen = levelFromEnvironment();
	return Level(chosen >= 0 ? chosen : defaultLevel.load(std::memory_order_relaxed));
}

void setDefault(Level level) { defaultLevel.store(int(level), std::memory_order_relaxed); }

void write(Level level, std::string_view text)
{
	constexpr std::string_view names[] = {"debug", "info", "warning", "error", "off"};
	timespec now{};
	clock_gettime(CLOCK_MONOTONIC, &now);
	const std::string line = fmt::format("[{:6}.{:06}] arift {}: {}\n", now.tv_sec, now.tv_nsec / 1000, names[int(level)], text);
	[[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

} // namespace arift::log
