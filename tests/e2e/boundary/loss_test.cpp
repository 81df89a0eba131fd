// A service that is started by the first application, killed under it, and started again by the next: the library in this process, the
// service a process of its own.
#include "runtime/base/clock.h"
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include "tests/openxr/application.h"
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

using namespace arift;
using namespace arift::e2e;

namespace
{

using Steady = std::chrono::steady_clock;
double milliseconds(Steady::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }
double millisecondsSince(Steady::time_point begin) { return milliseconds(Steady::now() - begin); }

void printFigure(const char *what, double figure, double bar)
{
	std::printf("[ FIGURE ] %-48s %6.1f ms (at most %.0f)\n", what, figure, bar);
}

/// This process is an application of the service in a tree of its own.
class Loss : public testing::Test
{
protected:
	Loss()
	{
		for (const auto &[name, value] : tree_.environment()) ::setenv(name.c_str(), value.c_str(), 1);
		::unsetenv("ARIFT_SERVICE");
	}
	int servicePid() const
	{
		const Ran answer = runArift(tree_, {"status", "--json"});
		return answer.status == 0 ? nlohmann::json::parse(answer.output)["service"]["pid"].get<int>() : -1;
	}
	/// An instance, and how long its making took.
	static std::pair<std::unique_ptr<Application>, double> timedInstance()
	{
		const auto begin = Steady::now();
		auto made = std::make_unique<Application>(std::vector{"XR_MND_headless"});
		return {std::move(made), millisecondsSince(begin)};
	}

	const PrivateTree tree_;
	const ServiceEnd end_{tree_};
};

bool sleeps(pid_t thread)
{
	std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
	std::string text;
	std::getline(file, text);
	const size_t name = text.rfind(") ");
	return name != text.npos && text[name + 2] == 'S';
}

} // namespace

TEST_F(Loss, AnInstanceIsThereSoonWhetherOrNotTheServiceRuns)
{
	const auto [first, starting] = timedInstance();
	ASSERT_EQ(first->created, XR_SUCCESS);
	double running = 1e9;
	for (int i = 0; i < 7; ++i) {
		const auto [next, lasted] = timedInstance();
		ASSERT_EQ(next->created, XR_SUCCESS);
		running = std::min(running, lasted);
	}
	printFigure("xrCreateInstance, starting the service", starting, 600);
	printFigure("xrCreateInstance, the service running", running, 20);
	EXPECT_LE(running, 20);
#if defined(NDEBUG)
	EXPECT_LE(starting, 5 * 600) << "also where others use the machine";
#endif
}

TEST_F(Loss, AKilledServiceEndsTheFramesWaitAtOnceAndTheNextInstanceStartsAnother)
{
	auto application = timedInstance().first;
	ASSERT_EQ(application->created, XR_SUCCESS);
	const XrSession session = application->session();
	ASSERT_EQ(application->begin(session), XR_SUCCESS);
	application->states();
	const int service = servicePid();
	ASSERT_GT(service, 0);

	auto watch = connectTo(tree_);
	ASSERT_TRUE(watch);
	XrFrameState frame;
	ASSERT_EQ(application->wait(session, frame), XR_SUCCESS);
	ASSERT_EQ(application->beginFrame(session), XR_SUCCESS);
	ASSERT_EQ(application->endFrame(session, frame.predictedDisplayTime), XR_SUCCESS);
	ASSERT_EQ(::kill(service, SIGSTOP), 0); // so that it answers nothing, and what waits for it waits
	std::atomic<pid_t> waiter{0};
	XrResult result = XR_SUCCESS;
	Steady::time_point ended;
	std::jthread thread([&] {
		waiter = ::gettid();
		while (result == XR_SUCCESS) { // what it had sent before it stopped may end one wait or two
			XrFrameState state;
			result = application->wait(session, state);
			if (result == XR_SUCCESS) result = application->beginFrame(session);
		}
		ended = Steady::now();
	});
	const auto deadline = Steady::now() + std::chrono::seconds(1);
	while (Steady::now() < deadline && !sleeps(waiter)) std::this_thread::yield();
	const auto killed = Steady::now();
	ASSERT_EQ(::kill(service, SIGKILL), 0);
	ipc::Received nothing;
	EXPECT_EQ(watch->receive(nothing, realTime() + 20 * second), ipc::Transfer::hungUp);
	const auto died = Steady::now(); // the kernel has taken its memory apart and closes its sockets
	thread.join();
	EXPECT_EQ(result, XR_ERROR_INSTANCE_LOST);
	printFigure("from SIGKILL until the service's sockets close", milliseconds(died - killed), 1000);
	printFigure("from then until xrWaitFrame returns", milliseconds(ended - died), 100);
	EXPECT_LE(milliseconds(ended - died), 100);

	EXPECT_EQ(application->states(), (std::vector{XR_SESSION_STATE_LOSS_PENDING}));
	XrEventDataBuffer event;
	EXPECT_EQ(application->poll(event), XR_ERROR_INSTANCE_LOST) << "both losses were told";
	const auto begin = Steady::now();
	application.reset();
	EXPECT_LE(millisecondsSince(begin), 100) << "destroying what is lost waits for nothing";

	const auto next = timedInstance().first;
	ASSERT_EQ(next->created, XR_SUCCESS) << "the killed one's lock and socket are no hindrance";
	EXPECT_NE(servicePid(), service);
	const XrSession again = next->session();
	ASSERT_EQ(next->begin(again), XR_SUCCESS);
	EXPECT_EQ(next->wait(again, frame), XR_SUCCESS);
}
