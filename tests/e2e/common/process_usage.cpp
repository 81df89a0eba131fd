#include "tests/e2e/common/process_usage.h"
#include "runtime/base/clock.h"
#include "tests/e2e/common/command.h"
#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace arift::e2e
{

namespace
{

namespace fs = std::filesystem;

size_t entriesOf(const fs::path &folder)
{
	std::error_code gone;
	return size_t(std::distance(fs::directory_iterator(folder, gone), fs::directory_iterator()));
}

} // namespace

ProcessUsage usageOf(int pid)
{
	const fs::path process = fs::path("/proc") / std::to_string(pid);
	const std::string maps = contentOf(process / "maps");
	size_t total = 0, resident = 0;
	std::ifstream(process / "statm") >> total >> resident;
	return {entriesOf(process / "fd"), size_t(std::ranges::count(maps, '\n')), entriesOf(process / "task"),
			double(resident) * double(::sysconf(_SC_PAGESIZE)) / (1 << 20)};
}

ProcessUsage settledUsage(int pid)
{
	ProcessUsage before, now = usageOf(pid);
	for (const XrTime end = realTime() + 60 * second; realTime() < end;) {
		std::this_thread::sleep_for(std::chrono::milliseconds(200));
		before = std::exchange(now, usageOf(pid));
		if (now.descriptors == before.descriptors && now.threads == before.threads && now.mappings == before.mappings) break;
	}
	return now;
}

double stolenSeconds()
{
	std::string cpu;
	double user = 0, nice = 0, system = 0, idle = 0, wait = 0, interrupts = 0, softInterrupts = 0, stolen = 0;
	std::ifstream("/proc/stat") >> cpu >> user >> nice >> system >> idle >> wait >> interrupts >> softInterrupts >> stolen;
	return stolen / double(::sysconf(_SC_CLK_TCK));
}

std::string describe(const ProcessUsage &usage)
{
	return fmt::format("{} descriptors, {} mappings, {} threads, {:.1f} MiB resident", usage.descriptors, usage.mappings, usage.threads,
					   usage.residentMiB);
}

} // namespace arift::e2e
