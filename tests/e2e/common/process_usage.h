// What a process has of the system's, as /proc tells it.
#pragma once
#include <cstddef>
#include <string>

namespace arift::e2e
{

struct ProcessUsage {
	size_t descriptors = 0, mappings = 0, threads = 0;
	double residentMiB = 0;
};
/// Zeros where there is no such process.
ProcessUsage usageOf(int pid);
/// The same once it stays for a moment: clients, threads and descriptors go with a connection, a moment after it.
ProcessUsage settledUsage(int pid);
/// Time for which a virtual machine's processors, all together, were ready to run and its host ran others, since its start.
double stolenSeconds();
/// For people.
std::string describe(const ProcessUsage &usage);

} // namespace arift::e2e
