#include "runtime/service/applications.h"
#include <algorithm>
#include <openxr/openxr.h>

namespace arift
{
namespace
{

/// For applications without the focus: devices are there, and nobody touches them.
ipc::InputTable atRest(ipc::InputTable input)
{
	for (ipc::HandState &hand : input.hands) hand.select = hand.menu = 0;
	input.gamepad = {};
	return input;
}

} // namespace

void Applications::write(ipc::ClientPage &page, const ipc::Event &event)
{
	const uint64_t count = page.eventCount.load(std::memory_order_relaxed);
	page.events[count % ipc::ClientPage::eventSlots].write(event);
	page.eventCount.store(count + 1, std::memory_order_release);
}

void Applications::writeInput(State &state)
{
	for (ipc::ClientPage *page : state.pages) {
		const bool focused = std::ranges::any_of(state.running, [&](const Running &each) { return each.page == page && each.focused; });
		page->input.write(focused ? state.input : atRest(state.input));
	}
}

void Applications::tellOverlays(State &state, const Running *main, XrTime now)
{
	for (Running &running : state.running) {
		if (!running.role.isOverlay || running.mainVisible == (main != nullptr)) continue;
		running.mainVisible = main != nullptr;
		write(*running.page,
			  {.type = ipc::EventType::mainVisibilityChanged,
			   .session = running.session,
			   .time = now,
			   .visible = running.mainVisible,
			   .flags = main && main->role.hasDepth ? uint32_t(XR_OVERLAY_MAIN_SESSION_ENABLED_COMPOSITION_LAYER_INFO_DEPTH_BIT_EXTX) : 0});
	}
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
	const auto found = std::find_if(state.running.rbegin(), state.running.rend(), [](const Running &each) { return each.role.isMain(); });
	Running *const main = found == state.running.rend() ? nullptr : &*found;
	// The focus is taken before it is given: no two main sessions believe they have it.
	for (Running &running : state.running)
		if (running.role.isMain() && &running != main) tell(running, false);
	for (Running &running : state.running)
		if (!running.role.isMain() || &running == main) tell(running, true);
	tellOverlays(state, main, now);
	writeInput(state);
}

void Applications::introduce(ipc::ClientPage &page)
{
	state_.update([&](State &state) {
		state.pages.push_back(&page);
		writeInput(state);
	});
}

void Applications::forget(ipc::ClientPage &page)
{
	state_.update([&](State &state) {
		std::erase(state.pages, &page);
		std::erase_if(state.running, [&](const Running &running) { return running.page == &page; });
	});
}

void Applications::begin(ipc::ClientPage &page, uint32_t session, XrTime now, const SessionRole &role)
{
	state_.update([&](State &state) {
		std::erase_if(state.running, [&](const Running &running) { return running.session == session; });
		state.running.push_back({&page, session, role});
		settle(state, now);
	});
	focusMoves();
}

void Applications::end(ipc::ClientPage &page, uint32_t session, XrTime now)
{
	state_.update([&](State &state) {
		if (std::erase_if(state.running, [&](const Running &running) { return running.session == session; }) == 0) return;
		write(page, {.type = ipc::EventType::visibilityChanged, .session = session, .time = now, .visible = 0, .focused = 0});
		settle(state, now);
	});
	focusMoves();
}

bool Applications::hasFocus(uint32_t session)
{
	const auto state = state_.lock();
	return std::ranges::any_of(state->running, [&](const Running &running) { return running.session == session && running.focused; });
}

void Applications::tellRecentered(const XrPosef &pose, XrTime now)
{
	state_.update([&](State &state) {
		for (ipc::ClientPage *page : state.pages) write(*page, {.type = ipc::EventType::recentered, .time = now, .pose = pose});
	});
}

void Applications::tellInput(const ipc::InputTable &input)
{
	state_.update([&](State &state) {
		state.input = input;
		writeInput(state);
	});
}

} // namespace arift
