#include "runtime/service/client.h"
#include "runtime/compositor/compositor.h"
#include "runtime/ipc/request.h"
#include "runtime/service/build.h"
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

std::atomic<uint32_t> nextSession{1};

/// A library says hello as soon as it is connected (real time): who does not keeps a place from others.
constexpr XrDuration helloLimit = 5 * second;

ipc::Header headerOf(const Request &request)
{
	return std::visit([](const auto &message) { return message.header; }, request);
}

} // namespace

Client::Client(ipc::Socket socket, World &world)
	: world_(world),
	  socket_(std::move(socket)),
	  peerPid_(uint32_t(ipc::peerOf(socket_).pid)),
	  page_(std::make_shared<ipc::SharedPage<ipc::ClientPage>>("arift-client")),
	  thread_([this](const std::stop_token &stop) { serve(stop); })
{
}

Client::~Client()
{
	thread_.request_stop();
	socket_.hangUp();
}

void Client::refuse(const ipc::Header &request, XrResult result, const std::string &text)
{
	ipc::Failed failed;
	failed.result = result;
	ipc::copyText(failed.text, text);
	reply(request, failed);
}

void Client::serve(const std::stop_token &stop)
{
	ipc::Received received;
	const XrTime connected = realTime();
	try {
		while (!stop.stop_requested()) {
			const ipc::Transfer transfer = socket_.receive(received, realTime() + second);
			if (!greeted_ && transfer == ipc::Transfer::timeout && realTime() - connected > helloLimit)
				throw Malformed("no hello within {} s", helloLimit / second);
			if (transfer == ipc::Transfer::hungUp) break;
			if (transfer == ipc::Transfer::malformed) throw Malformed("message longer than {} bytes", ipc::maxMessageSize);
			if (transfer == ipc::Transfer::done) answer(decodeRequest(received));
		}
	} catch (const Malformed &problem) {
		log::warning("client {} is disconnected: {}", peerPid_, problem.what());
	} catch (const std::exception &problem) {
		log::error("client {} is disconnected: {}", peerPid_, problem.what());
	}
	socket_.hangUp();
	stopSession();
	swapchains_.reset();
	compositor_.reset();
	device_.reset();
	if (application_) world_.applications.forget(**page_);
	finished_ = true;
}

void Client::answer(const Request &request)
{
	const bool isHello = std::holds_alternative<ipc::Hello>(request);
	if (isHello == greeted_) throw Malformed("{}", greeted_ ? "a second hello" : "a request before hello");
	if (greeted_ && application_ == ipc::isForMonitors(headerOf(request).type)) throw Malformed("a request that is not for its role");
	try {
		std::visit([this](const auto &message) { answer(message); }, request);
	} catch (const Refused &problem) {
		log::debug("client {}: {}", peerPid_, problem.what());
		refuse(headerOf(request), problem.result, problem.what());
	} catch (const std::runtime_error &problem) {
		if (dynamic_cast<const Malformed *>(&problem)) throw;
		log::warning("client {}: {}", peerPid_, problem.what());
		refuse(headerOf(request), XR_ERROR_RUNTIME_FAILURE, problem.what());
	}
}

void Client::answer(const ipc::Hello &message)
{
	greeted_ = true;
	const bool isApplication = message.role == ipc::Role::application;
	about_->update([&](About &about) {
		about = {
			.pid = peerPid_, .name = ipc::textOf(message.applicationName), .application = isApplication, .session = {}, .swapchains = {}};
	});
	if (message.protocol != ipc::protocol) {
		refuse(message.header, XR_ERROR_RUNTIME_UNAVAILABLE,
			   fmt::format("this library ({}) speaks protocol {}, the running service ({}) speaks {}: restart the service (arift stop)",
						   ipc::textOf(message.build), message.protocol, buildId, ipc::protocol));
		socket_.hangUp();
		return;
	}
	application_ = isApplication;
	Opened opened = world_.await(Stage::identified, ipc::openingLimit);
	if (application_) world_.applications.introduce(**page_);
	const std::vector<XrEnvironmentBlendMode> modes = world_.settingsOf(ipc::textOf(message.applicationName)).blendModes;
	opened.welcome.blendModeCount = uint32_t(modes.size());
	std::ranges::copy(modes, opened.welcome.blendModes.begin());
	const std::array fds{world_.system.fd(), world_.poses.fd(), page_->fd()};
	reply(message.header, opened.welcome, std::span(fds).first(application_ ? 3 : 2));
}

void Client::answer(const ipc::CreateSession &message)
{
	if (session_) throw Refused(XR_ERROR_LIMIT_REACHED, "an instance may have one session at a time");
	const Opened opened = world_.await(Stage::ready, ipc::openingLimit);
	if (!opened.headsetProblem.empty()) throw Refused(XR_ERROR_INITIALIZATION_FAILED, opened.headsetProblem);
	device_ = opened.device;
	compositor_ = opened.compositor;
	sharing_ = sharingFor(message);
	ipc::SessionCreated created;
	created.session = nextSession++;
	created.sharing = sharing_;
	const std::vector<int64_t> formats = gpu::swapchainFormats(*device_);
	for (size_t i = 0; i < std::min(formats.size(), created.formats.size()); ++i) created.formats[i] = int32_t(formats[i]);
	// Two software devices may say the same of themselves and be of two builds.
	const bool isToBeProbed =
		sharing_ == ipc::Sharing::memory && !message.headless && device_->identity().deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
	const UniqueFd probe = isToBeProbed ? offerProbe(created) : UniqueFd();
	sharing_ = created.sharing;
	auto [ours, theirs] = ipc::Socket::pair();
	role_ = {message.headless != 0, message.overlay != 0, message.placement, message.hasDepth != 0};
	beginSession(created.session, std::move(ours));
	// What it was begun on may have gone meanwhile, unseen by whoever ends sessions.
	const Opened now = *world_.opened.lock();
	if (now.headset != opened.headset || now.compositor != opened.compositor) session_->hangUp();
	const std::array fds{theirs.fd(), probe.get()};
	reply(message.header, created, std::span(fds).first(probe ? 2 : 1));
}

void Client::beginSession(uint32_t number, ipc::Socket channel)
{
	swapchains_ = std::make_shared<Swapchains>(compositor_);
	session_ = std::make_shared<Session>(
		number, world_.clock, std::move(channel),
		Session::Images{[this](uint32_t swapchain) { return swapchains_->find(swapchain); },
						[this](const ipc::Submission &submission) { swapchains_->fetch(submission); },
						[this, number](const ipc::Vibrate &vibration) {
							// Who has no focus takes no motor from who has; whoever turns them looks again.
							if (world_.applications.hasFocus(number)) world_.vibrate(number, vibration);
						}},
		page_,
		[this](const std::string &problem) {
			log::warning("client {} is disconnected: {}", peerPid_, problem);
			socket_.hangUp();
		},
		role_.order());
	std::string name;
	about_->update([&](About &about) {
		about.session = session_;
		about.swapchains = swapchains_;
		name = about.name;
	});
	// Whoever changes the settings from now on finds the session; who did before changed what is asked for here.
	present(*session_, name);
	passthroughMaps_ = std::make_unique<PassthroughMaps>(device_, compositor_);
}

/// As the settings are by then: of two who change them, the later one's hold.
void Client::present(Session &session, const std::string &application) const
{
	session.present([&](Presentation &presentation) { presentation.forced = world_.settingsOf(application).passthrough; });
}

/// Where there is no memory for it, nothing is proven: images are copied.
UniqueFd Client::offerProbe(ipc::SessionCreated &created) const
{
	try {
		gpu::MemoryProbe probe = gpu::makeMemoryProbe(*device_);
		created.probeSize = probe.size;
		created.probeTypeIndex = probe.typeIndex;
		created.probePattern = probe.pattern;
		return std::move(probe.memory);
	} catch (const std::exception &problem) {
		log::warning("client {}'s images are copied through the CPU's memory: {}", peerPid_, problem.what());
		created.sharing = ipc::Sharing::copies;
		return {};
	}
}

ipc::Sharing Client::sharingFor(const ipc::CreateSession &message) const
{
	const gpu::DeviceIdentity &ours = device_->identity();
	const bool isOurs = message.deviceUuid == ours.deviceUuid && message.driverUuid == ours.driverUuid;
	if (message.headless || (isOurs && world_.config.images == ImageSharing::automatic)) return ipc::Sharing::memory;
	log::warning("client {}'s images are copied through the CPU's memory: {}", peerPid_,
				 isOurs ? "the configuration wants it ([swapchains] images)"
						: fmt::format("it draws on another GPU or driver than the service, which uses {}", ours.name));
	return ipc::Sharing::copies;
}

Session &Client::sessionNumbered(uint32_t number)
{
	if (!session_ || session_->number() != number) throw Malformed("unknown session {}", number);
	return *session_;
}

void Client::stopSession()
{
	if (!session_) return;
	session_->close();
	compositor_->removeSource(*session_);
	world_.applications.end(**page_, session_->number(), world_.clock.now());
	about_->update([](About &about) {
		about.session.reset();
		about.swapchains.reset();
	});
	passthroughMaps_.reset();
	session_.reset(); // the compositor may hold the closed session for the rest of its frame
}

void Client::answer(const ipc::DestroySession &message)
{
	sessionNumbered(message.session);
	stopSession();
	swapchains_.reset();
	reply(message.header, ipc::Done{});
}

void Client::answer(const ipc::SessionRunning &message)
{
	Session &session = sessionNumbered(message.session);
	session.setRunning(message.running != 0);
	if (message.running) {
		compositor_->addSource(session_);
		world_.applications.begin(**page_, session.number(), world_.clock.now(), role_);
	} else {
		compositor_->removeSource(session);
		world_.applications.end(**page_, session.number(), world_.clock.now());
	}
	reply(message.header, ipc::Done{});
}

void Client::answer(const ipc::CreateSwapchain &message)
{
	sessionNumbered(message.session);
	if (compositor_->ended()) throw Refused(XR_ERROR_SESSION_LOST, "the GPU that the session drew on was lost");
	if (message.sharing < sharing_) throw Refused(XR_ERROR_FEATURE_UNSUPPORTED, "this session's images are copied, not shared");
	const Swapchains::Made made = swapchains_->make(*device_, message.spec, message.imageCount, message.sharing);
	std::vector<int> fds;
	for (const UniqueFd &memory : made.memory) fds.push_back(memory.get());
	ipc::SwapchainCreated created;
	created.swapchain = made.swapchain;
	created.imageCount = message.imageCount;
	created.memorySize = made.memorySize;
	created.memoryTypeIndex = made.memoryTypeIndex;
	reply(message.header, created, fds);
}

void Client::answer(const ipc::DestroySwapchain &message)
{
	if (!swapchains_ || !swapchains_->destroy(message.swapchain)) throw Malformed("unknown swapchain {}", message.swapchain);
	reply(message.header, ipc::Done{});
}

void Client::answer(const ipc::ShowPassthrough &message)
{
	sessionNumbered(message.session).present([&](Presentation &presentation) {
		const bool shown = message.shown != 0;
		if (message.layer == ipc::everyPassthroughLayer)
			presentation.passthroughRuns = shown;
		else
			presentation.passthrough.at(message.layer).shown = shown;
	});
	reply(message.header, ipc::Done{});
}

void Client::answer(const ipc::StylePassthrough &message)
{
	Session &session = sessionNumbered(message.session);
	PassthroughStyle style = styleOf(message);
	style.map = passthroughMaps_->make(message);
	session.present([&](Presentation &presentation) { presentation.passthrough.at(message.layer).style = style; });
	passthroughMaps_->replace(message.layer, style.map);
	reply(message.header, ipc::Done{});
}

} // namespace arift
