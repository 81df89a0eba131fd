// The trace file: always whole JSON, bounded, and never in the way of who adds to it.
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include "runtime/base/trace.h"
#include "tests/common/temporary_folder.h"
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>

using namespace arift;

namespace
{

class TraceFile : public testing::Test
{
protected:
	nlohmann::json parsed() const { return nlohmann::json::parse(std::ifstream(file_)); }
	/// Numbers of the events called "stage", in the file's order.
	std::vector<uint64_t> numbers() const
	{
		std::vector<uint64_t> all;
		for (const auto &event : parsed())
			if (event["name"] == "stage") all.push_back(event["args"]["frame"]);
		return all;
	}
	/// What readers of the format do: an incomplete last line is none, and the closing bracket is optional.
	void dropTornLine() const
	{
		std::ifstream file(file_);
		std::string text((std::istreambuf_iterator<char>(file)), {});
		if (text.ends_with("\n]\n")) return;
		text.erase(text.find_last_of('\n'));
		if (text.ends_with(',')) text.pop_back();
		std::ofstream(file_) << text << "\n]\n";
	}
	template <typename Condition> static bool await(Condition holds)
	{
		for (const XrTime end = realTime() + 20 * second; realTime() < end; ::usleep(5000))
			if (holds()) return true;
		return false;
	}

	const test::TemporaryFolder folder_;
	const std::filesystem::path file_ = folder_.path() / "trace.json";
};

} // namespace

TEST_F(TraceFile, HasEveryEventWithItsTimes)
{
	{
		Trace trace(file_);
		EXPECT_EQ(parsed().size(), 1u) << "whole from the beginning";
		trace.add({"stage", 5'000'250, 1'500, 0, 1});
		trace.add({"stage", 6'000'000, 2'000, 7, 2});
	}
	const auto events = parsed();
	ASSERT_EQ(numbers(), (std::vector<uint64_t>{1, 2}));
	for (const auto &event : events) {
		if (event["name"] != "stage") continue;
		EXPECT_EQ(event["ph"], "X");
		const bool first = event["args"]["frame"] == 1;
		EXPECT_DOUBLE_EQ(event["ts"], first ? 5000.25 : 6000.0) << "microseconds";
		EXPECT_DOUBLE_EQ(event["dur"], first ? 1.5 : 2.0);
		EXPECT_EQ(event["tid"], first ? 1 : 8);
	}
	const auto named = [&](const std::string &name) {
		return std::ranges::any_of(events, [&](const auto &event) { return event["ph"] == "M" && event["args"]["name"] == name; });
	};
	EXPECT_TRUE(named("arift-service"));
	EXPECT_TRUE(named("compositor"));
	EXPECT_TRUE(named("session 7"));
}

TEST_F(TraceFile, ManyThreadsLoseNothingAndMixNothingUp)
{
	constexpr int threads = 4, each = 3000;
	{
		Trace trace(file_);
		std::vector<std::jthread> all;
		for (int thread = 0; thread < threads; ++thread)
			all.emplace_back([&, thread] {
				for (int i = 0; i < each; ++i) trace.add({"stage", thread, i, uint32_t(thread), uint64_t(thread * each + i)});
			});
		all.clear();
		EXPECT_EQ(trace.dropped(), 0u);
	}
	std::vector<uint64_t> found = numbers();
	std::ranges::sort(found);
	ASSERT_EQ(found.size(), size_t(threads * each));
	for (size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], i);
	for (const auto &event : parsed())
		if (event["name"] == "stage") {
			EXPECT_DOUBLE_EQ(event["dur"].get<double>() * 1000, double(event["args"]["frame"].get<int>() % each));
		}
}

TEST_F(TraceFile, WhatDoesNotFitIsDroppedAndCounted)
{
	Trace trace(file_);
	const XrTime begin = realTime();
	for (size_t i = 0; i < 20 * Trace::capacity; ++i) trace.add({"stage", 0, 0, 0, i});
	EXPECT_LT(realTime() - begin, 5 * second) << "nobody waits";
	EXPECT_GT(trace.dropped(), 0u);
}

/// The kernel ends a write between two pages of the file when a process is killed.
TEST_F(TraceFile, HasWholeLinesWhenItsProcessIsKilled)
{
	const pid_t child = ::fork();
	if (child == 0) {
		Trace trace(file_);
		for (uint64_t i = 0;; ++i, ::usleep(20)) trace.add({"stage", XrTime(i), 1, uint32_t(i % 5), i});
	}
	EXPECT_TRUE(await([&] { return std::filesystem::exists(file_) && std::filesystem::file_size(file_) > 100'000; }));
	::kill(child, SIGKILL);
	::waitpid(child, nullptr, 0);
	dropTornLine();
	const std::vector<uint64_t> found = numbers();
	ASSERT_GT(found.size(), 500u);
	for (size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], i);
}

TEST_F(TraceFile, EndsAtItsLimitAndStaysWhole)
{
	{
		Trace trace(file_, 10'000);
		for (uint64_t i = 0; i < 40; ++i) trace.add({"stage", 0, 0, 0, i});
		ASSERT_TRUE(await([&] { return std::filesystem::file_size(file_) > 2'000; }));
		for (uint64_t i = 40; i < 1000; ++i) trace.add({"stage", 0, 0, 0, i});
	}
	EXPECT_LE(std::filesystem::file_size(file_), 10'010u);
	EXPECT_EQ(numbers().size(), 40u);
}

TEST_F(TraceFile, AFullDiskLeavesWhatIsThere)
{
	// The kernel answers writes beyond this as it does on a full disk: some bytes, then none.
	std::signal(SIGXFSZ, SIG_IGN);
	rlimit before{};
	::getrlimit(RLIMIT_FSIZE, &before);
	{
		Trace trace(file_);
		for (uint64_t i = 0; i < 40; ++i) trace.add({"stage", 0, 0, 0, i});
		ASSERT_TRUE(await([&] { return std::filesystem::file_size(file_) > 2'000; }));
		const rlimit full{std::filesystem::file_size(file_) + 1'000, before.rlim_max};
		::setrlimit(RLIMIT_FSIZE, &full);
		for (uint64_t i = 40; i < 1000; ++i) trace.add({"stage", 0, 0, 0, i});
	}
	::setrlimit(RLIMIT_FSIZE, &before);
	EXPECT_EQ(numbers().size(), 40u);
}

TEST_F(TraceFile, AFileThatCannotBeWrittenIsSaid)
{
	EXPECT_THROW(Trace("/no/such/folder/trace.json"), InputError);
	EXPECT_THROW(Trace("/dev/full"), InputError);
}
