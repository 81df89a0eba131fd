// A child process that never outlives its owner.
#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace arift::e2e
{

/// Thread-bound. Ended with SIGTERM and, five seconds later, SIGKILL when destroyed; it dies with this process too.
class ChildProcess
{
public:
	/// `command[0]` is the program's path. What it prints goes to `output`. Throws std::runtime_error where it cannot be started.
	ChildProcess(const std::vector<std::string> &command, const std::map<std::string, std::string> &environment,
				 std::filesystem::path output);
	~ChildProcess();
	ChildProcess(ChildProcess &&other) noexcept;
	ChildProcess &operator=(ChildProcess &&) = delete;

	int pid() const { return pid_; }
	bool running();
	/// Whether it stops itself (SIGSTOP) within so long.
	bool stopsItself(std::chrono::milliseconds limit) const;
	/// Exit status (128 + signal where one ended it) once the child has ended.
	std::optional<int> wait(std::chrono::milliseconds limit);
	/// Asks it to end; its exit status, or nothing where it had to be killed.
	std::optional<int> stop(std::chrono::milliseconds limit = std::chrono::seconds(5));
	/// What it has printed so far.
	std::string output() const;

private:
	int pid_ = -1;
	std::optional<int> status_;
	std::filesystem::path output_;
};

} // namespace arift::e2e
