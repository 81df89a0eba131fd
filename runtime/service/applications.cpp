#include "runtime/service/applications.h"
#include <algorithm>

namespace arift
{

void Applications::write(ipc::ClientPage &page, const ipc::Event &event)
{
	const uint64_t count = page.eventCount.load(std::memory_order_relaxed);
	page.events[count % ipc::ClientPage::eventSlots].write(event);
	page.eventCount.store(count + 1, std::memory_order_release);
}

void Applications::settle(State &state, XrTime now)
{
	const auto tell = [now](Running &running, bool focused) {
		if (running.told && running.focused == focused) return;
		running.told = true;
		running.focused = focused;
		write(*running.page,
			  {.type = ipc::EventType::visibilityChanged, .session = running.session, .time = now, .visible = 1, .focused = focused});
	};
	if (state.running.empty()) return;
	// The focus is taken before it is given: no two sessions believe they have it.
	for (size_t i = 0; i + 1 < state.running.size(); ++i) tell(state.running[i], false);
	tell(state.running.back(), true);
}

void Applications::introduce(ipc::ClientPage &page)
{
	state_.update([&](State &state) { state.pages.push_back(&page); });
}

void Applications::forget(ipc::ClientPage &page)
{
	state_.update([&](State &state) {
		std::erase(state.pages, &page);
		std::erase_if(state.running, [&](const Running &running) { return running.page == &page; });
	});
}

void Applications::begin(ipc::ClientPage &page, uint32_t session, XrTime now)
{
	state_.update([&](State &state) {
		std::erase_if(state.running, [&](const Running &running) { return running.session == session; });
		state.running.push_back({&page, session});
		settle(state, now);
	});
}

void Applications::end(ipc::ClientPage &page, uint32_t session, XrTime now)
{
	state_.update([&](State &state) {
		if (std::erase_if(state.running, [&](const Running &running) { return running.session == session; }) == 0) return;
		write(page, {.type = ipc::EventType::visibilityChanged, .session = session, .time = now, .visible = 0, .focused = 0});
		settle(state, now);
	});
}

void Applications::tellRecentered(const XrPosef &pose, XrTime now)
{
	state_.update([&](State &state) {
		for (ipc::ClientPage *page : state.pages) write(*page, {.type = ipc::EventType::recentered, .time = now, .pose = pose});
	});
}

} // namespace arift
