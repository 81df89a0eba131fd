// The library as a guest in other people's processes: what it brings, what it needs, what it leaves alone.
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"
#include <csignal>
#include <cstdio>
#include <fstream>
#include <link.h>
#include <sstream>
#include <thread>

namespace arift
{
namespace
{

/// What a program of the tool chain prints, line by line.
std::vector<std::string> linesOf(const std::string &command)
{
	FILE *const pipe = ::popen(command.c_str(), "r");
	if (!pipe) throw std::runtime_error("cannot run " + command);
	std::string text;
	for (char part[4096]; std::fgets(part, sizeof part, pipe);) text += part;
	EXPECT_EQ(::pclose(pipe), 0) << command;
	std::istringstream stream(text);
	std::vector<std::string> lines;
	for (std::string line; std::getline(stream, line);) lines.push_back(line);
	return lines;
}

bool isLoaded(const char *library)
{
	std::ifstream maps("/proc/self/maps");
	for (std::string line; std::getline(maps, line);)
		if (line.find(library) != line.npos) return true;
	return false;
}

TEST(ForeignProcess, OneSymbolIsExported)
{
	const auto symbols = linesOf("nm -D --defined-only " OPENXR_ARIFT_LIBRARY);
	ASSERT_EQ(symbols.size(), 1u);
	EXPECT_NE(symbols[0].find(" T xrNegotiateLoaderRuntimeInterface"), std::string::npos) << symbols[0];
}

TEST(ForeignProcess, TheCLibraryIsAllThatIsNeeded)
{
	size_t needed = 0;
	for (const std::string &line : linesOf("readelf -d " OPENXR_ARIFT_LIBRARY)) {
		if (line.find("(NEEDED)") == line.npos) continue;
		++needed;
		EXPECT_TRUE(line.find("[libc.so") != line.npos || line.find("[libm.so") != line.npos || line.find("[ld-linux") != line.npos)
			<< line;
	}
	EXPECT_GT(needed, 0u);
}

/// Neither when the process ends nor when one of its threads does: other threads may still be in the middle of a call.
TEST(ForeignProcess, NothingOfOursIsLeftToBeDestroyedAtExit)
{
	size_t symbols = 0;
	for (const std::string &line : linesOf("nm -A " OPENXR_ARIFT_ARCHIVES)) {
		++symbols;
		EXPECT_EQ(line.find("__cxa_atexit"), line.npos) << line;
		EXPECT_EQ(line.find("__cxa_thread_atexit"), line.npos) << line;
	}
	EXPECT_GT(symbols, 1000u);
}

TEST(ForeignProcess, GraphicsAndWindowsAreLeftAloneUntilAskedFor)
{
	FakeService service;
	const Application application({"XR_MND_headless", "XR_KHR_vulkan_enable2"});
	const XrSession session = application.session();
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	EXPECT_TRUE(isLoaded("libopenxr_arift")) << "what the test goes by";
	for (const char *library : {"libvulkan", "libGL", "libEGL", "libX11", "libxcb", "libwayland"})
		EXPECT_FALSE(isLoaded(library)) << library;
}

TEST(ForeignProcess, InstancesLiveSideBySide)
{
	FakeService service;
	const Application first({"XR_MND_headless"});
	const XrSession session = first.session();
	{
		const Application second({"XR_MND_headless"});
		const XrSession other = second.session();
		EXPECT_NE(first.instance, second.instance);
		EXPECT_EQ(first.begin(session), XR_SUCCESS);
		EXPECT_EQ(second.begin(other), XR_SUCCESS);
	}
	XrFrameState frame;
	EXPECT_EQ(first.wait(session, frame), XR_SUCCESS) << "the other's end is not its own";
}

/// An application that ends without a word, while one of its threads polls and another waits for a frame.
[[noreturn]] void exitInTheMiddle()
{
	auto &service = *new FakeService; // like much else in a process that just ends
	auto &application = *new Application({"XR_MND_headless"});
	const XrSession session = application.session();
	application.begin(session);
	service.setPace(5 * millisecond);
	std::atomic<int> frames{0};
	std::thread([&] {
		for (XrFrameState frame; application.wait(session, frame) == XR_SUCCESS; ++frames)
			if (XR_FAILED(application.beginFrame(session))) return;
	}).detach();
	std::thread([&] {
		for (XrEventDataBuffer event;;) application.poll(event);
	}).detach();
	while (frames < 3) std::this_thread::yield();
	std::exit(7);
}

TEST(ForeignProcess, AProcessMayEndInTheMiddle)
{
	GTEST_FLAG_SET(death_test_style, "threadsafe");
	for (int i = 0; i < 3; ++i) EXPECT_EXIT(exitInTheMiddle(), testing::ExitedWithCode(7), "");
}

TEST(ForeignProcess, SignalHandlersAreTheHosts)
{
	FakeService service;
	std::vector<struct sigaction> before(32);
	for (int number = 1; number < 32; ++number) ::sigaction(number, nullptr, &before[size_t(number)]);
	const Application application({"XR_MND_headless"});
	const XrSession session = application.session();
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	for (int number = 1; number < 32; ++number) {
		struct sigaction now {
		};
		::sigaction(number, nullptr, &now);
		EXPECT_EQ(now.sa_handler, before[size_t(number)].sa_handler) << number;
	}
}

} // namespace
} // namespace arift
