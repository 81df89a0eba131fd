#include "tests/openxr/fake_service.h"
#include "runtime/ipc/request.h"
#include "runtime/ipc/runtime_directory.h"
#include <cstdlib>
#include <gtest/gtest.h>

namespace arift
{
namespace
{

ipc::ViewTable usualViews()
{
	ipc::ViewTable views{};
	views.eyeInHead = {XrPosef{identityOrientation, {-0.032f, 0, 0}}, XrPosef{identityOrientation, {0.032f, 0, 0}}};
	views.cameraInHead = {XrPosef{identityOrientation, {-0.03f, 0.01f, -0.08f}}, XrPosef{identityOrientation, {0.03f, 0.01f, -0.08f}}};
	views.fov = {XrFovf{-0.9f, 0.7f, 0.85f, -0.85f}, XrFovf{-0.7f, 0.9f, 0.85f, -0.85f}};
	views.viewOffset = 0;
	views.pivotInHead = NeckModel{}.pivotInHead;
	views.floorBelowLocal = 1.6f;
	views.localInOrigin = identityPose;
	views.stageBounds = {2, 3};
	return views;
}

template <typename Reply> void reply(ipc::Socket &socket, const ipc::Received &request, Reply message, std::span<const int> fds = {})
{
	message.header.sequence = request.header()->sequence;
	socket.send(message, fds, realTime() + second);
}

} // namespace

ipc::Welcome FakeService::usualWelcome()
{
	ipc::Welcome welcome;
	ipc::copyText(welcome.build, "fake");
	ipc::copyText(welcome.systemName, "Fake headset");
	welcome.recommendedWidth = 800;
	welcome.recommendedHeight = 1000;
	welcome.maxWidth = welcome.maxHeight = 4096;
	welcome.blendModeCount = 2;
	welcome.blendModes = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND};
	return welcome;
}

FakeService::FakeService(const ipc::Welcome &welcome, MakeImages makeImages) : welcome_(welcome), makeImages_(std::move(makeImages))
{
	::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
	::setenv("ARIFT_SERVICE", "/nonexistent", 1); // nothing but this service may answer
	system_->protocol = ipc::protocol;
	system_->heartbeat = realTime();
	system_->clock.write({});
	system_->views.write(usualViews());
	system_->timing.write({.displayPeriod = 16'690'000});
	listener_ = std::make_unique<ipc::Listener>(ipc::socketPath());
	heart_ = std::jthread([this](const std::stop_token &stop) { beat(stop); });
	acceptor_ = std::jthread([this](const std::stop_token &stop) { accept(stop); });
}

FakeService::~FakeService()
{
	acceptor_.request_stop();
	listener_->stop();
	acceptor_.join();
	hangUp();
	connections_.lock()->clear(); // each thread is told to stop and joined
	heart_ = {};
}

void FakeService::beat(const std::stop_token &stop)
{
	while (!stop.stop_requested()) {
		system_->heartbeat = realTime();
		std::this_thread::sleep_for(std::chrono::milliseconds(20));
	}
}

void FakeService::accept(const std::stop_token &stop)
{
	while (!stop.stop_requested())
		if (auto socket = listener_->accept(realTime() + second / 10))
			start(std::make_shared<ipc::Socket>(std::move(*socket)), &FakeService::serve);
}

void FakeService::start(std::shared_ptr<ipc::Socket> socket, void (FakeService::*work)(ipc::Socket &, const std::stop_token &))
{
	const auto connections = connections_.lock(); // whom it serves is among them before it is served
	std::jthread thread([this, socket, work](const std::stop_token &stop) { (this->*work)(*socket, stop); });
	connections->push_back({std::move(socket), std::move(thread)});
}

void FakeService::readFrames() { start(std::make_shared<ipc::Socket>(std::move(unread_.value())), &FakeService::serveFrames); }

void FakeService::hangUp()
{
	const auto connections = connections_.lock();
	for (const Connection &connection : *connections) connection.socket->hangUp();
}

void FakeService::forgetClients()
{
	hangUp();
	std::vector<Connection> ended;
	connections_.update([&](std::vector<Connection> &connections) { ended.swap(connections); });
	ended.clear(); // each thread is told to stop and joined
	client_->eventCount = client_->oldestHeldFrame = 0;
	record_.update([](Record &record) { record = {}; });
}

void FakeService::send(const ipc::Event &event)
{
	const uint64_t count = client_->eventCount.load();
	client_->events[count % ipc::ClientPage::eventSlots].write(event);
	client_->eventCount.store(count + 1);
}

FakeService::Record FakeService::waitFor(const std::function<bool(const Record &)> &ready)
{
	auto record = record_.lock();
	EXPECT_TRUE(record.waitFor({}, std::chrono::seconds(10), ready)) << "the library did not send what was expected";
	return *record;
}

void FakeService::serve(ipc::Socket &socket, const std::stop_token &stop)
{
	ipc::Received received;
	for (ipc::Transfer transfer = ipc::Transfer::timeout; transfer != ipc::Transfer::hungUp && !stop.stop_requested();) {
		transfer = socket.receive(received, realTime() + second / 10);
		if (transfer == ipc::Transfer::done && answering_) answer(socket, received);
	}
}

void FakeService::watch(const ipc::Received &received, bool isFrame)
{
	const Watch watcher = *watch_.lock();
	watcher(received, isFrame);
}

void FakeService::answer(ipc::Socket &socket, const ipc::Received &received)
{
	watch(received, false);
	if (const auto hello = received.as<ipc::Hello>()) {
		if (deaf_ > 0 && deaf_-- > 0) return socket.hangUp();
		record_.update([&](Record &record) { record.hellos.push_back(*hello); });
		return reply(socket, received, welcome_, std::array{system_.fd(), ring_.fd(), client_.fd()});
	}
	if (const auto asked = received.as<ipc::CreateSession>()) {
		if (refusal_ != XR_SUCCESS) return reply(socket, received, ipc::Failed{.result = refusal_});
		auto [ours, theirs] = ipc::Socket::pair();
		if (readingFrames_) {
			start(std::make_shared<ipc::Socket>(std::move(ours)), &FakeService::serveFrames);
		} else {
			while (theirs.send(ipc::Relinquish{}, 0) == ipc::Transfer::done) {}
			unread_.emplace(std::move(ours));
		}
		uint32_t number = 0;
		record_.update([&](Record &record) {
			number = ++record.sessionsCreated;
			record.sessions.push_back(*asked);
		});
		ipc::SessionCreated created{.session = number};
		const UniqueFd further = (*grant_.lock())(created);
		const std::array fds{theirs.fd(), further.get()};
		return reply(socket, received, created, std::span(fds).first(further ? 2 : 1));
	}
	if (const auto create = received.as<ipc::CreateSwapchain>()) {
		ipc::SwapchainCreated created;
		const std::vector<UniqueFd> images = makeImages_(*create, created);
		std::vector<int> fds;
		for (const UniqueFd &image : images) fds.push_back(image.get());
		record_.update([&](Record &record) {
			record.swapchains.push_back(*create);
			created.swapchain = uint32_t(record.swapchains.size());
		});
		created.imageCount = uint32_t(fds.size());
		return reply(socket, received, created, fds);
	}
	record_.update([&](Record &record) {
		if (received.as<ipc::DestroySession>()) ++record.sessionsDestroyed;
		if (received.as<ipc::DestroySwapchain>()) ++record.swapchainsDestroyed;
		if (const auto running = received.as<ipc::SessionRunning>()) record.running = running->running != 0;
		if (const auto show = received.as<ipc::ShowPassthrough>()) record.passthroughShown.push_back(*show);
		if (const auto style = received.as<ipc::StylePassthrough>()) record.passthroughStyles.push_back(*style);
	});
	reply(socket, received, ipc::Done{});
}

void FakeService::serveFrames(ipc::Socket &socket, const std::stop_token &stop)
{
	ipc::Received received;
	for (ipc::Transfer transfer = ipc::Transfer::timeout; transfer != ipc::Transfer::hungUp && !stop.stop_requested();) {
		transfer = socket.receive(received, realTime() + second / 10);
		if (transfer != ipc::Transfer::done || !answering_) continue;
		watch(received, true);
		record_.update([&](Record &record) { record.frameMessages.push_back(received.header()->type); });
		if (const auto wait = received.as<ipc::WaitFrame>()) {
			record_.update([&](Record &record) { record.waits.push_back(wait->header.sequence); });
			std::this_thread::sleep_for(std::chrono::nanoseconds(pace_.load()));
			const XrTime now = realTime();
			socket.send(
				ipc::FrameReady{.predictedDisplayTime = now + 30 * millisecond, .predictedDisplayPeriod = 16'690'000, .shouldRender = 1},
				now + second);
		} else if (const auto relinquish = received.as<ipc::Relinquish>()) {
			client_->oldestHeldFrame = relinquish->frame + 1;
			record_.update([&](Record &record) { record.relinquished.push_back(relinquish->frame); });
		} else if (const auto vibrate = received.as<ipc::Vibrate>()) {
			record_.update([&](Record &record) { record.vibrations.push_back(*vibrate); });
		} else if (received.header()->type == ipc::MessageType::submission) {
			ipc::Submission submission;
			std::memcpy(static_cast<void *>(&submission), received.bytes.data(), received.size);
			if (showing_) client_->oldestHeldFrame = submission.frame;
			record_.update([&](Record &record) { record.submissions.push_back(submission); });
		}
	}
}

} // namespace arift
