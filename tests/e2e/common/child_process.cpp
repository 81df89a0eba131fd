#include "tests/e2e/common/child_process.h"
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace arift::e2e
{
namespace
{

std::vector<char *> pointers(std::vector<std::string> &texts)
{
	std::vector<char *> all;
	for (std::string &text : texts) all.push_back(text.data());
	all.push_back(nullptr);
	return all;
}

[[noreturn]] void become(char **arguments, char **environment, int output)
{
	::prctl(PR_SET_PDEATHSIG, SIGKILL);
	::dup2(output, STDOUT_FILENO);
	::dup2(output, STDERR_FILENO);
	::execve(arguments[0], arguments, environment);
	::_exit(127);
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string> &command, const std::map<std::string, std::string> &environment,
						   std::filesystem::path output)
	: output_(std::move(output))
{
	std::vector<std::string> arguments = command, variables;
	for (const auto &[name, value] : environment) variables.push_back(name + "=" + value);
	std::vector<char *> argv = pointers(arguments), envp = pointers(variables);
	const int file = ::open(output_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
	if (file < 0) throw std::runtime_error("cannot write " + output_.string());
	pid_ = ::fork();
	if (pid_ == 0) become(argv.data(), envp.data(), file);
	::close(file);
	if (pid_ < 0) throw std::runtime_error("cannot start " + command.at(0));
}

ChildProcess::ChildProcess(ChildProcess &&other) noexcept
	: pid_(std::exchange(other.pid_, -1)), status_(other.status_), output_(std::move(other.output_))
{
}

ChildProcess::~ChildProcess()
{
	if (pid_ > 0) stop();
}

bool ChildProcess::stopsItself(std::chrono::milliseconds limit) const
{
	siginfo_t state{};
	const auto deadline = std::chrono::steady_clock::now() + limit;
	const auto hasStopped = [&] { return ::waitid(P_PID, id_t(pid_), &state, WSTOPPED | WNOHANG | WNOWAIT) == 0 && state.si_pid == pid_; };
	while (!hasStopped()) {
		if (std::chrono::steady_clock::now() >= deadline) return false;
		std::this_thread::sleep_for(std::chrono::milliseconds(5));
	}
	return true;
}

bool ChildProcess::running() { return !wait(std::chrono::milliseconds(0)); }

std::optional<int> ChildProcess::wait(std::chrono::milliseconds limit)
{
	const auto deadline = std::chrono::steady_clock::now() + limit;
	while (!status_) {
		int status = 0;
		if (::waitpid(pid_, &status, WNOHANG) == pid_) {
			status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
		} else if (std::chrono::steady_clock::now() >= deadline) {
			return std::nullopt;
		} else {
			std::this_thread::sleep_for(std::chrono::milliseconds(5));
		}
	}
	return status_;
}

std::optional<int> ChildProcess::stop(std::chrono::milliseconds limit)
{
	if (status_) return status_;
	::kill(pid_, SIGTERM);
	if (const auto status = wait(limit)) return status;
	::kill(pid_, SIGKILL);
	wait(std::chrono::seconds(5));
	return std::nullopt;
}

std::string ChildProcess::output() const
{
	std::ostringstream text;
	text << std::ifstream(output_).rdbuf();
	return text.str();
}

} // namespace arift::e2e
