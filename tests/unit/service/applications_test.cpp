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
		if (event.type == ipc::EventType::mainVisibilityChanged)
			texts.push_back(std::string(event.visible ? "main visible" : "main hidden") + (event.flags ? " with depth" : ""));
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

TEST(Applications, AnOverlayHasTheFocusBesideTheMainSessionAndHearsOfIt)
{
	Applications applications;
	ipc::ClientPage main, other, overlay;
	for (ipc::ClientPage *page : {&main, &other, &overlay}) applications.introduce(*page);
	const SessionRole onTop{.isOverlay = true, .placement = 3};
	applications.begin(overlay, 1, 0, onTop);
	EXPECT_EQ(eventsOf(overlay), (Texts{"1 visible focused"})) << "there is no main session yet";
	applications.begin(main, 2, 0, {.hasDepth = true});
	EXPECT_EQ(eventsOf(main), (Texts{"2 visible focused"}));
	EXPECT_EQ(eventsOf(overlay, 1), (Texts{"main visible with depth"})) << "it loses nothing to it";
	applications.begin(other, 3, 0);
	EXPECT_EQ(eventsOf(main, 1), (Texts{"2 visible"}));
	EXPECT_EQ(eventsOf(overlay, 2), Texts{}) << "there still is one";
	applications.end(other, 3, 0);
	EXPECT_EQ(eventsOf(main, 2), (Texts{"2 visible focused"}));
	applications.end(main, 2, 0);
	EXPECT_EQ(eventsOf(overlay, 2), (Texts{"main hidden"}));
	ipc::ClientPage late;
	applications.introduce(late);
	applications.begin(main, 4, 0);
	applications.begin(late, 5, 0, onTop);
	EXPECT_EQ(eventsOf(late), (Texts{"5 visible focused", "main visible"})) << "one that comes later is told, too";
	EXPECT_EQ(eventsOf(main, 4), (Texts{"4 visible focused"})) << "and takes no focus";
}

TEST(Applications, OverlaysLieInTheOrderOfTheirPlacementAboveAllOthers)
{
	EXPECT_EQ(SessionRole{}.order(), 0u);
	EXPECT_GT((SessionRole{.isOverlay = true, .placement = 0}).order(), SessionRole{}.order());
	EXPECT_GT((SessionRole{.isOverlay = true, .placement = 8}).order(), (SessionRole{.isOverlay = true, .placement = 7}).order());
	constexpr uint32_t highest = 0xffffffff;
	EXPECT_GT((SessionRole{.isOverlay = true, .placement = highest}).order(), SessionRole{}.order());
}

TEST(Applications, AHeadlessSessionTakesTheFocusFromNobody)
{
	Applications applications;
	ipc::ClientPage drawing, headless;
	applications.introduce(drawing);
	applications.introduce(headless);
	applications.begin(drawing, 1, 0);
	applications.begin(headless, 2, 0, {.isHeadless = true});
	EXPECT_EQ(eventsOf(drawing), (Texts{"1 visible focused"}));
	EXPECT_TRUE(applications.hasFocus(1) && applications.hasFocus(2));
}

TEST(Applications, WhoHasTheFocusHasTheInput)
{
	Applications applications;
	int moves = 0;
	applications.focusMoves = [&] { ++moves; };
	ipc::ClientPage a, b, idle;
	for (ipc::ClientPage *page : {&a, &b, &idle}) applications.introduce(*page);
	applications.begin(a, 1, 0);
	ipc::InputTable input;
	input.hands[1] = {.isThere = 1, .select = 1, .menu = 1, .aimInView = {{0, 0, 0, 1}, {1, 2, 3}}};
	input.hasGamepad = 1;
	input.gamepad.triggers = {0.5f, 1};
	applications.tellInput(input);
	const auto isTouched = [](const ipc::ClientPage &page) {
		const ipc::InputTable table = *page.input.read();
		EXPECT_TRUE(table.hands[1].isThere && table.hasGamepad) << "that devices are there is no secret";
		EXPECT_EQ(table.hands[1].aimInView.position.z, 3);
		const bool pressed = table.hands[1].select != 0;
		EXPECT_EQ(pressed, table.hands[1].menu != 0);
		EXPECT_EQ(pressed, table.gamepad.triggers[0] > 0);
		return pressed;
	};
	EXPECT_TRUE(isTouched(a));
	EXPECT_FALSE(isTouched(b) || isTouched(idle));
	applications.begin(b, 2, 0);
	EXPECT_FALSE(isTouched(a)) << "what is held is let go of for who loses the focus";
	EXPECT_TRUE(isTouched(b));
	EXPECT_FALSE(applications.hasFocus(1));
	ipc::ClientPage late;
	applications.introduce(late);
	EXPECT_FALSE(isTouched(late));
	applications.end(b, 2, 0);
	EXPECT_TRUE(isTouched(a));
	EXPECT_EQ(moves, 3);
}
