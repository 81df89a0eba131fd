#include "runtime/openxr/session_life.h"
#include "runtime/openxr/ext/extx_overlay.h"

namespace arift::openxr
{

void Life::requireRunning() const
{
	if (!facts.begun) throw Error(XR_ERROR_SESSION_NOT_RUNNING, "the session is not running: its state is {}", int(state));
}

SessionLife::SessionLife(const Instance &instance, uint32_t id, bool isHeadless, uint64_t newsBefore)
	: instance_(instance), id_(id), isHeadless_(isHeadless)
{
	life_.lock()->newsTaken = newsBefore;
}

void SessionLife::announce(XrSession handle)
{
	handle_ = handle;
	change([](Life &) {});
}

void SessionLife::takeNews() { takeNewsLocked(*life_.lock()); }

bool SessionLife::takeEvent(XrEventDataBuffer &event)
{
	const auto life = life_.lock();
	takeNewsLocked(*life);
	return life->events.pop(event);
}

void SessionLife::lose()
{
	change([](Life &life) { life.facts.lossPending = true; });
	lost_ = true;
}

void SessionLife::takeNewsLocked(Life &life)
{
	if (instance_.service.isLost()) return;
	const ipc::ClientPage &page = instance_.service.client();
	const uint64_t written = page.eventCount.load(std::memory_order_acquire);
	if (written > life.newsTaken + ipc::ClientPage::eventSlots) {
		life.events.lose(uint32_t(written - life.newsTaken - ipc::ClientPage::eventSlots));
		life.newsTaken = written - ipc::ClientPage::eventSlots;
	}
	for (; life.newsTaken < written; ++life.newsTaken)
		if (const auto news = page.events[life.newsTaken % ipc::ClientPage::eventSlots].read()) take(life, *news);
}

void SessionLife::take(Life &life, const ipc::Event &news)
{
	if (news.session != 0 && news.session != id_) return; // 0: whichever there is
	switch (news.type) {
	case ipc::EventType::visibilityChanged:
		if (isHeadless_) return; // XR_MND_headless: visible and focused as long as it runs
		life.facts.visible = news.visible != 0;
		life.facts.focused = news.focused != 0;
		break;
	case ipc::EventType::exitRequested: life.facts.exitRequested = true; break;
	case ipc::EventType::recentered: return tellRecentered(life, news);
	case ipc::EventType::mainVisibilityChanged: return life.events.push(mainVisibilityEvent(news));
	case ipc::EventType::lossPending:
		life.facts.lossPending = true;
		lost_ = true;
		break;
	case ipc::EventType::none: return;
	}
	settleLocked(life);
}

void SessionLife::tellRecentered(Life &life, const ipc::Event &news) const
{
	const auto tell = [&](XrReferenceSpaceType type) {
		life.events.push(XrEventDataReferenceSpaceChangePending{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING, nullptr, handle_, type,
																news.time, XR_TRUE, news.pose});
	};
	tell(XR_REFERENCE_SPACE_TYPE_LOCAL);
	if (instance_.hasLocalFloor()) tell(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR);
}

void SessionLife::settleLocked(Life &life)
{
	life.state = settle(life.state, life.facts, [&](XrSessionState state) {
		XrEventDataSessionStateChanged event{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr, handle_, state, realTime()};
		if (!instance_.service.isLost()) event.time = instance_.service.now();
		life.events.push(event);
	});
	state_.store(life.state, std::memory_order_relaxed);
}

} // namespace arift::openxr
