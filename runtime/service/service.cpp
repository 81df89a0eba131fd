#include "runtime/service/service.h"
#include "runtime/service/places.h"
#include "runtime/service/system.h"
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

constexpr XrDuration heartbeatPeriod = 50 * millisecond, lastWords = second / 2;
constexpr XrDuration usbPeriod = second;
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

/// A trace is wanted by somebody who looks for something: that it cannot be written is no reason not to serve.
std::unique_ptr<Trace> makeTrace()
{
	const char *file = std::getenv("ARIFT_TRACE");
	if (!file || !*file) return nullptr;
	try {
		return std::make_unique<Trace>(file);
	} catch (const std::exception &problem) {
		log::warning("no trace is written: {}", problem.what());
		return nullptr;
	}
}

} // namespace

Service::Service(Options options, ipc::Listener &listener)
	: options_(std::move(options)),
	  listener_(listener),
	  clock_(makeClock(options_.config)),
	  world_(options_.config, *clock_),
	  input_(readInput()),
	  lastSeen_(realTime())
{
	world_.system->protocol = ipc::protocol;
	const ClockAnchor anchor = clock_->anchor();
	world_.system->clock.write({anchor.realAnchor, anchor.xrAnchor, anchor.rate});
	world_.system->heartbeat = realTime();
	world_.requestStop = [this] { stop(); };
	world_.describeClients = [this](nlohmann::json &list) { describeClients(list); };
	world_.vibrate = [this](uint32_t session, const ipc::Vibrate &vibration) {
		if (input_) input_->vibrate(session, vibration);
	};
	world_.applications.focusMoves = [this] {
		if (input_) input_->focusMoved();
	};
	world_.forEachSession = [this](const auto &call) { forEachSession(call); };
	world_.trace = makeTrace();
	opener_ = std::jthread([this] { open(); });
	heart_ = std::jthread([this](std::stop_token stop) { beat(stop); });
}

Service::~Service()
{
	opener_.request_stop();
	opener_.join();
	// Out of the list first: a client that asks for the list's lock is waited for here.
	std::list<Client> leaving;
	clients_.update([&](std::list<Client> &clients) { leaving.swap(clients); });
	leaving.clear();
	input_.reset(); // its keys reach the compositor
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

void Service::fail(const std::string &problem, bool fault)
{
	world_.opened.update([&](Opened &opened) {
		opened.stage = Stage::failed;
		opened.problem = problem;
		opened.fault = fault;
	});
}

void Service::open()
{
	try {
		system_ = std::make_unique<System>(world_);
		system_->announce();
	} catch (const std::exception &problem) {
		fail(problem.what(), false);
	}
}

/// Sessions end with the GPU that their images lie on; clients stay connected and may begin new ones.
void Service::recover(const std::string &problem)
{
	world_.opened.update([](Opened &opened) {
		opened.stage = Stage::identified;
		opened.device.reset();
		opened.compositor.reset();
	});
	endSessions();
	opener_ = std::jthread([this, problem](const std::stop_token &stop) {
		try {
			system_->recompose(problem, stop);
		} catch (const std::exception &last) {
			fail(last.what(), true);
		}
	});
}

/// Their applications are told, and may begin new ones.
void Service::endSessions()
{
	for (const auto &about : abouts())
		if (const auto session = about->lock()->session) session->hangUp();
}

void Service::followHeadset()
{
	if (realTime() < lookAtUsb_) return;
	lookAtUsb_ = realTime() + usbPeriod;
	if (system_->followHeadset()) endSessions();
}

std::vector<std::shared_ptr<Guarded<Client::About>>> Service::abouts()
{
	std::vector<std::shared_ptr<Guarded<Client::About>>> all;
	const auto clients = clients_.lock();
	for (const Client &client : *clients) all.push_back(client.about());
	return all;
}

void Service::forEachSession(const std::function<void(const std::string &, Session &)> &call)
{
	for (const auto &about : abouts()) {
		const Client::About copy = *about->lock();
		if (copy.session) call(copy.name, *copy.session);
	}
}

/// Nobody who comes or goes waits for this.
void Service::describeClients(nlohmann::json &list)
{
	for (const auto &about : abouts()) {
		const Client::About copy = *about->lock();
		describeClient(list, copy);
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

/// Without a device that is switched on nothing is read and no thread runs.
std::unique_ptr<InputThread> Service::readInput()
try {
	const InputSettings &settings = options_.config.input;
	if (settings.devices.empty()) return nullptr;
	const auto toggleRawPassthrough = [this] {
		if (const auto compositor = world_.opened.lock()->compositor) compositor->setRawPassthrough(!compositor->rawPassthrough());
	};
	return std::make_unique<InputThread>(settings, makeInputDevices(inputPlaces(), settings.devices),
										 InputThread::Deeds{[this](const ipc::InputTable &input) { world_.applications.tellInput(input); },
															[this] { world_.recenter(); }, toggleRawPassthrough,
															[this](uint32_t session) { return world_.applications.hasFocus(session); }});
} catch (const std::exception &problem) {
	log::error("no keyboards, mice and gamepads are read: {}", problem.what());
	return nullptr;
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

Service::End Service::run()
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
		if (opened.stage == Stage::failed && realTime() - failedAt > lastWords) return {opened.problem, opened.fault};
		if (opened.stage != Stage::ready) continue;
		followHeadset();
		const auto end = opened.compositor->ended();
		if (end && end->closed) {
			log::info("the window was closed");
			break;
		}
		if (end) recover(end->problem);
	}
	world_.opened.update([](Opened &opened) { opened.stage = opened.stage == Stage::failed ? Stage::failed : Stage::stopping; });
	return {};
}

} // namespace arift
