#include "runtime/ipc/pages.h"
#include "runtime/ipc/shared_memory.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <thread>

using namespace arift;
using namespace arift::ipc;

TEST(SharedMemory, AReaderSeesWhatTheWriterWrites)
{
	const SharedPage<SystemPage> page("test");
	const SharedPageView<SystemPage> view(UniqueFd(::dup(page.fd())));
	page->heartbeat = 42;
	EXPECT_EQ(view->heartbeat.load(), 42);
}

TEST(SharedMemory, AReaderCannotWriteResizeOrUnseal)
{
	const SharedPage<SystemPage> page("test");
	EXPECT_EQ(::mmap(nullptr, sizeof(SystemPage), PROT_READ | PROT_WRITE, MAP_SHARED, page.fd(), 0), MAP_FAILED);
	EXPECT_EQ(::ftruncate(page.fd(), 0), -1);
	EXPECT_EQ(::ftruncate(page.fd(), 1 << 20), -1);
	EXPECT_EQ(::write(page.fd(), "x", 1), -1);
	EXPECT_EQ(::fcntl(page.fd(), F_ADD_SEALS, F_SEAL_WRITE), -1);
}

TEST(SharedMemory, AMappingThatCouldShrinkOrIsTooSmallIsRefused)
{
	const UniqueFd unsealed(::memfd_create("test", MFD_CLOEXEC));
	ASSERT_EQ(::ftruncate(unsealed.get(), 4096), 0);
	EXPECT_THROW(mapReadOnly(unsealed.get(), 4096), std::runtime_error);
	const UniqueFd small = makeSharedMemory("test", 100);
	EXPECT_THROW(mapReadOnly(small.get(), 101), std::runtime_error);
}

TEST(SharedMemory, ASealedCopyHoldsTheBytes)
{
	const std::string text = "{\"frames\":1}";
	const UniqueFd fd = makeSealedCopy("test", std::as_bytes(std::span(text)));
	const Mapping mapping = mapReadOnly(fd.get(), text.size());
	EXPECT_EQ(std::string_view(static_cast<const char *>(mapping.address()), text.size()), text);
	EXPECT_EQ(::fcntl(fd.get(), F_GET_SEALS) & F_SEAL_WRITE, F_SEAL_WRITE);
}

TEST(Published, IsNeverTorn)
{
	const SharedPage<SystemPage> page("test");
	std::jthread writer([&](std::stop_token stop) {
		for (int64_t i = 1; !stop.stop_requested(); ++i) page->clock.write({i, -i, double(i)});
	});
	int seen = 0, overtaken = 0;
	for (int i = 0; i < 20'000 || seen == 0; ++i)
		if (const auto table = page->clock.read()) {
			ASSERT_EQ(table->xrAnchor, -table->realAnchor);
			ASSERT_TRUE(table->realAnchor == 0 || table->rate == double(table->realAnchor));
			seen += table->realAnchor > 0;
		} else {
			++overtaken;
		}
	EXPECT_GT(seen, 0);
	EXPECT_LT(overtaken, 20) << "though this writer writes without a pause";
}

TEST(Published, AWriterThatStopsHalfWayLeavesWhatItWroteBefore)
{
	Published<ClockTable> table;
	table.write({1, 2, 3});
	// The next one goes to slot 0, which begins behind the version: odd while it is written.
	const uint32_t odd = 3;
	std::memcpy(reinterpret_cast<char *>(&table) + 8, &odd, sizeof odd);
	const auto before = table.read();
	ASSERT_TRUE(before);
	EXPECT_EQ(before->xrAnchor, 2);
	table.write({4, 5, 6});
	EXPECT_EQ(table.read()->xrAnchor, 5);
}

TEST(Published, APageWithoutSenseIsNoValue)
{
	Published<ClockTable> table;
	const uint32_t version = 7; // whose slot says otherwise
	std::memcpy(static_cast<void *>(&table), &version, sizeof version);
	EXPECT_FALSE(table.read());
}
