// When a service that died is started again, and how its parent tells one end from another: with real processes that stand in for it.
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include "runtime/service/supervisor.h"
#include "tests/common/temporary_folder.h"
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace arift;

namespace
{

/// A process that is supervised; each life adds a character to a file and then ends as `live` says.
class Supervised
{
public:
	explicit Supervised(const std::function<int(int life)> &live)
	{
		parent_ = ::fork();
		if (parent_ != 0) return;
		const auto status = supervise([] {});
		if (status) ::_exit(*status);
		const int life = lives();
		std::ofstream(file_, std::ios::app) << '.';
		::_exit(live(life));
	}
	~Supervised()
	{
		if (!ended_) ::kill(parent_, SIGTERM);
		end();
	}
	int end()
	{
		int status = 0;
		if (!ended_) ::waitpid(parent_, &status, 0);
		ended_ = true;
		return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
	}
	int lives() const
	{
		std::ifstream file(file_);
		return int(std::string(std::istreambuf_iterator<char>(file), {}).size());
	}
	pid_t pid() const { return parent_; }

private:
	const test::TemporaryFolder folder_;
	const std::filesystem::path file_ = folder_.path() / "lives";
	pid_t parent_ = -1;
	bool ended_ = false;
};

} // namespace

TEST(RestartPolicy, WaitsLongerAfterEachQuickDeathAndGivesUp)
{
	RestartPolicy policy;
	std::vector<XrDuration> pauses;
	while (const auto pause = policy.died(second)) pauses.push_back(*pause);
	const std::vector<XrDuration> expected{100 * millisecond,  200 * millisecond,  400 * millisecond, 800 * millisecond,
										   1600 * millisecond, 3200 * millisecond, 5 * second,        5 * second};
	EXPECT_EQ(pauses, expected);
}

TEST(RestartPolicy, ALongLifeIsForgiven)
{
	RestartPolicy policy;
	for (int i = 0; i < RestartPolicy::mostQuick; ++i) policy.died(second);
	EXPECT_EQ(policy.died(RestartPolicy::quick), 100 * millisecond);
	EXPECT_EQ(policy.died(second), 100 * millisecond) << "the first of a new row";
	EXPECT_EQ(policy.died(second), 200 * millisecond);
}

TEST(Supervisor, AKilledServiceIsStartedAgain)
{
	const XrTime begin = realTime();
	Supervised service([](int life) {
		if (life < 2) ::raise(SIGKILL);
		return life == 2 ? exitAfterFault : 0;
	});
	EXPECT_EQ(service.end(), 0) << "it ends as the service does";
	EXPECT_EQ(service.lives(), 4);
	EXPECT_GE(realTime() - begin, 700 * millisecond) << "0.1, 0.2 and 0.4 s lie between the lives";
}

TEST(Supervisor, AServiceThatCannotServeAsAskedIsNot)
{
	Supervised service([](int) { return 1; });
	EXPECT_EQ(service.end(), 1);
	EXPECT_EQ(service.lives(), 1);
}

TEST(Supervisor, TheRequestToEndIsPassedOn)
{
	Supervised service([](int) {
		std::signal(SIGTERM, [](int) { ::_exit(0); });
		for (;;) ::pause();
		return 1;
	});
	while (service.lives() == 0) ::usleep(1000);
	::usleep(20'000); // it may not have its handler yet: then the signal ends it, which is the end as well
	::kill(service.pid(), SIGTERM);
	const int status = service.end();
	EXPECT_TRUE(status == 0 || status == 128 + SIGTERM) << status;
	EXPECT_EQ(service.lives(), 1);
}
