#include "runtime/service/applications.h"
#include <gtest/gtest.h>

using namespace arift;

namespace
{

/// The events of a page from `from` on, as short text.
std::vector<std::string> eventsOf(const ipc::ClientPage &page, uint64_t from = 0)
{
	std::vector<std::string> texts;
	for (uint64_t i = from; i < page.eventCount.load(); ++i) {
		const ipc::Event event = *page.events[i % ipc::ClientPage::eventSlots].read();
		if (event.type == ipc::EventType::recentered) texts.push_back("recentered");
		if (event.type == ipc::EventType::visibilityChanged)
			texts.push_back(std::to_string(event.session) + (event.visible ? " visible" : " hidden") + (event.focused ? " focused" : ""));
	}
	return texts;
}

using Texts = std::vector<std::string>;

} // namespace

TEST(Applications, TheNewestHasTheFocusAndAllAreVisible)
{
	Applications applications;
	ipc::ClientPage a, b;
	applications.introduce(a);
	applications.introduce(b);
	applications.begin(a, 1, 0);
	EXPECT_EQ(eventsOf(a), (Texts{"1 visible focused"}));
	applications.begin(b, 2, 0);
	EXPECT_EQ(eventsOf(a), (Texts{"1 visible focused", "1 visible"}));
	EXPECT_EQ(eventsOf(b), (Texts{"2 visible focused"}));
	applications.end(b, 2, 0);
	EXPECT_EQ(eventsOf(b, 1), (Texts{"2 hidden"}));
	EXPECT_EQ(eventsOf(a, 2), (Texts{"1 visible focused"})) << "the focus comes back";
}

TEST(Applications, EndingWhatDoesNotRunSaysNothing)
{
	Applications applications;
	ipc::ClientPage a;
	applications.introduce(a);
	applications.end(a, 1, 0);
	EXPECT_EQ(a.eventCount.load(), 0u);
}

TEST(Applications, ADeadClientGivesTheFocusBack)
{
	Applications applications;
	ipc::ClientPage a, b;
	applications.introduce(a);
	applications.introduce(b);
	applications.begin(a, 1, 0);
	applications.begin(b, 2, 0);
	applications.end(b, 2, 0);
	applications.forget(b);
	const uint64_t before = b.eventCount.load();
	applications.tellRecentered(identityPose, 5);
	EXPECT_EQ(eventsOf(a).back(), "recentered");
	EXPECT_EQ(b.eventCount.load(), before) << "its page may be gone";
}

TEST(Applications, ManyEventsWrapRound)
{
	Applications applications;
	ipc::ClientPage a;
	applications.introduce(a);
	for (XrTime time = 1; time <= 100; ++time) applications.tellRecentered(identityPose, time);
	EXPECT_EQ(a.eventCount.load(), 100u);
	EXPECT_EQ(a.events[99 % ipc::ClientPage::eventSlots].read()->time, 100);
}
