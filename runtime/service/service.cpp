#include "runtime/service/service.h"
#include "runtime/service/system.h"
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

constexpr XrDuration heartbeatPeriod = 50 * millisecond, lastWords = second / 2;
constexpr size_t maxClients = 64;

std::unique_ptr<Clock> makeClock(const Config &config)
{
	switch (config.clock) {
	case ClockMode::scaled: return makeScaledClock(config.rate);
	case ClockMode::stepped: return makeSteppedClock(realTime());
	case ClockMode::real: break;
	}
	return makeRealClock();
}

} // namespace

Service::Service(Options options, ipc::Listener &listener)
	: options_(std::move(options)),
	  listener_(listener),
	  clock_(makeClock(options_.config)),
	  world_(options_.config, *clock_),
	  lastSeen_(realTime())
{
	world_.system->protocol = ipc::protocol;
	const ClockAnchor anchor = clock_->anchor();
	world_.system->clock.write({anchor.realAnchor, anchor.xrAnchor, anchor.rate});
	world_.system->heartbeat = realTime();
	world_.requestStop = [this] { stop(); };
	world_.describeClients = [this](nlohmann::json &list) {
		const auto clients = clients_.lock();
		for (Client &client : *clients) client.describe(list);
	};
	opener_ = std::jthread([this] { open(); });
	heart_ = std::jthread([this](std::stop_token stop) { beat(stop); });
}

Service::~Service()
{
	opener_.join();
	// Out of the list first: a client that is describing all clients waits for the list's lock, and is waited for here.
	std::list<Client> leaving;
	clients_.update([&](std::list<Client> &clients) { leaving.swap(clients); });
	leaving.clear();
	system_.reset();
}

/// A thread of its own: nothing that the main loop waits for may look like the service's death.
void Service::beat(const std::stop_token &stop)
{
	while (!stop.stop_requested()) {
		world_.system->heartbeat.store(realTime(), std::memory_order_relaxed);
		std::this_thread::sleep_for(std::chrono::nanoseconds(heartbeatPeriod));
	}
}

void Service::open()
{
	const auto fail = [this](const std::string &problem) {
		world_.opened.update([&](Opened &opened) {
			opened.stage = Stage::failed;
			opened.problem = problem;
		});
	};
	try {
		system_ = std::make_unique<System>(world_);
	} catch (const std::exception &problem) {
		fail(problem.what());
	}
}

void Service::stop()
{
	stopping_ = true;
	listener_.stop();
}

void Service::removeFinished()
{
	std::list<Client> finished;
	clients_.update([&](std::list<Client> &clients) {
		for (auto client = clients.begin(); client != clients.end();) {
			const auto next = std::next(client);
			if (client->finished()) finished.splice(finished.end(), clients, client);
			client = next;
		}
		if (!clients.empty()) lastSeen_ = realTime();
	});
}

bool Service::mayLeave() { return options_.idleExit && realTime() - lastSeen_ > *options_.idleExit; }

void Service::admit(ipc::Socket socket)
{
	try {
		clients_.update([&](std::list<Client> &clients) { clients.emplace_back(std::move(socket), world_); });
	} catch (const std::exception &problem) { // no descriptor, thread or memory is left: the world stays visible
		log::error("a client is refused: {}", problem.what());
	}
}

std::string Service::run()
{
	XrTime failedAt = 0;
	while (!stopping_ && !mayLeave()) {
		auto socket = listener_.accept(realTime() + heartbeatPeriod);
		removeFinished();
		if (socket && clients_.lock()->size() < maxClients) {
			admit(std::move(*socket));
			lastSeen_ = realTime();
		}
		const Opened opened = *world_.opened.lock();
		if (opened.stage == Stage::failed && failedAt == 0) failedAt = realTime();
		// Who asked in the meantime is told the reason before the door closes.
		if (opened.stage == Stage::failed && realTime() - failedAt > lastWords) return opened.problem;
		if (opened.stage != Stage::ready) continue;
		if (const auto end = opened.compositor->ended()) return end->problem;
	}
	world_.opened.update([](Opened &opened) { opened.stage = opened.stage == Stage::failed ? Stage::failed : Stage::stopping; });
	return {};
}

} // namespace arift
