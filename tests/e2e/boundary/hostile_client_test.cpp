// Clients that do what no library of ours does. Only they are closed; the service keeps nothing of them, and their neighbour its frames.
#include "runtime/ipc/shared_memory.h"
#include "tests/e2e/boundary/raw_client.h"
#include <cmath>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

using namespace arift;
using namespace arift::e2e;

namespace
{

constexpr const char *configuration = "[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"real\"\n[compositor]\ntarget = \"offscreen\"\n";

/// An application that behaves, frame after frame.
class Neighbour
{
public:
	explicit Neighbour(const PrivateService &service) : client_(service)
	{
		if (!client_.begin() || !client_.makeSwapchain()) throw std::runtime_error("the neighbour cannot begin");
		thread_ = std::jthread([this](const std::stop_token &stop) {
			for (uint64_t number = 1; !stop.stop_requested() && client_.frame(number); ++number) frames_ = number;
			if (!stop.stop_requested()) frames_ = 0;
		});
	}
	/// Whether it gets so many frames more within a limit.
	bool goesOn(uint64_t frames = 3) const
	{
		const uint64_t from = frames_;
		for (const XrTime end = realTime() + patience; realTime() < end; std::this_thread::sleep_for(std::chrono::milliseconds(2)))
			if (frames_ >= from + frames) return true;
		return false;
	}

private:
	RawClient client_;
	std::atomic<uint64_t> frames_{0};
	std::jthread thread_;
};

size_t descriptorsOf(int pid)
{
	const std::filesystem::directory_iterator all("/proc/" + std::to_string(pid) + "/fd");
	return size_t(std::distance(begin(all), end(all)));
}

/// One service and one neighbour for all; after every test the service holds what it held before.
class HostileClient : public testing::Test
{
protected:
	static void SetUpTestSuite()
	{
		service_ = new PrivateService(configuration);
		neighbour_ = new Neighbour(*service_);
		if (!neighbour_->goesOn(5)) throw std::runtime_error("the neighbour gets no frames");
	}
	static void TearDownTestSuite()
	{
		delete neighbour_;
		delete service_;
	}
	HostileClient() : descriptors_(descriptorsOf(service_->process().pid())) {}
	void TearDown() override
	{
		EXPECT_TRUE(neighbour_->goesOn()) << "the neighbour has lost its frames";
		size_t now = 0;
		for (const XrTime end = realTime() + 20 * second; realTime() < end; std::this_thread::sleep_for(std::chrono::milliseconds(10)))
			if ((now = descriptorsOf(service_->process().pid())) <= descriptors_) return;
		ADD_FAILURE() << "the service has " << now << " descriptors instead of " << descriptors_;
	}
	PrivateService &service() { return *service_; }
	/// A new client for whom `misbehave` is the end.
	void expectClosed(const char *what, const std::function<void(RawClient &)> &misbehave)
	{
		SCOPED_TRACE(what);
		RawClient client(service());
		misbehave(client);
		EXPECT_TRUE(client.isClosed());
	}
	/// The same with a running session whose frame channel is told what it does.
	void expectFramesClosed(const char *what, const std::function<void(ipc::Submission &)> &change, size_t size = 0)
	{
		expectClosed(what, [&](RawClient &client) {
			ASSERT_TRUE(client.begin() && client.makeSwapchain());
			ipc::Submission submission = client.quad(1);
			change(submission);
			const std::span bytes(reinterpret_cast<const std::byte *>(&submission), size ? size : ipc::wireSize(client.quad(1)));
			client.frames->send(bytes, {}, realTime() + second);
		});
	}

private:
	static inline PrivateService *service_ = nullptr;
	static inline Neighbour *neighbour_ = nullptr;
	const size_t descriptors_;
};

using SubImageField = int32_t ipc::SubImage::*;

} // namespace

TEST_F(HostileClient, HandshakesThatAreNone)
{
	expectClosed("a hello cut short", [](RawClient &client) { client.send(ipc::Hello{}, 20); });
	expectClosed("a hello of a later protocol cut short",
				 [](RawClient &client) { client.send(ipc::Hello{.protocol = 99}, offsetof(ipc::Hello, build)); });
	expectClosed("a hello that goes on", [](RawClient &client) {
		const std::pair<ipc::Hello, uint64_t> longer{};
		client.send(longer);
	});
	expectClosed("another magic number", [](RawClient &client) { client.send(ipc::Hello{.magic = 1}); });
	expectClosed("an unknown role", [](RawClient &client) { client.send(ipc::Hello{.role = ipc::Role(7)}); });
	expectClosed("a request before hello", [](RawClient &client) { client.send(ipc::CreateSession{}); });
	expectClosed("less than a header", [](RawClient &client) { client.send(uint16_t(1)); });
	expectClosed("nothing at all", [](RawClient &client) { ::send(client.socket.fd(), "", 0, MSG_NOSIGNAL); });
	expectClosed("more than any message", [](RawClient &client) {
		const std::array<char, 2 * ipc::maxMessageSize> large{};
		EXPECT_GT(::send(client.socket.fd(), large.data(), large.size(), MSG_NOSIGNAL), 0);
	});
	expectClosed("a second hello", [](RawClient &client) {
		ASSERT_TRUE(client.greet());
		client.send(ipc::Hello{});
	});
}

TEST_F(HostileClient, WhoSaysNothingIsLetGo)
{
	RawClient silent(service());
	EXPECT_TRUE(silent.isClosed(15 * second));
}

TEST_F(HostileClient, RequestsThatAreNone)
{
	const auto afterHello = [this](const char *what, const std::function<void(RawClient &)> &misbehave) {
		expectClosed(what, [&](RawClient &client) {
			ASSERT_TRUE(client.greet());
			misbehave(client);
		});
	};
	for (const uint32_t type : {0u, 2u, 10u, 11u, 99u, 102u, 201u, 1000u, ~0u})
		afterHello("a type that is no request", [&](RawClient &client) { client.send(ipc::Header{ipc::MessageType(type)}); });
	afterHello("a request cut short", [](RawClient &client) { client.send(ipc::CreateSession{}, sizeof(ipc::Header)); });
	afterHello("a monitor's request", [](RawClient &client) { client.send(ipc::ShutDown{}); });
	afterHello("a session of somebody else", [](RawClient &client) { client.send(ipc::SessionRunning{.session = 1, .running = 1}); });
	afterHello("a swapchain without a session", [](RawClient &client) { client.send(ipc::CreateSwapchain{.session = 1}); });
	afterHello("a swapchain of somebody else", [](RawClient &client) { client.send(ipc::DestroySwapchain{.swapchain = 1}); });
	expectClosed("an application's request by a monitor", [](RawClient &client) {
		ASSERT_TRUE(client.greet(ipc::Role::monitor));
		client.send(ipc::CreateSession{});
	});
	expectClosed("a setting that is no number", [](RawClient &client) {
		ASSERT_TRUE(client.greet(ipc::Role::monitor));
		client.send(ipc::SetSetting{.value = NAN});
	});
}

TEST_F(HostileClient, SwapchainsOutOfRange)
{
	const auto withSpec = [this](const char *what, const std::function<void(ipc::CreateSwapchain &)> &change) {
		expectClosed(what, [&](RawClient &client) {
			ASSERT_TRUE(client.begin());
			ipc::CreateSwapchain create{.session = client.session, .spec = RawClient::smallImages()};
			change(create);
			client.send(create);
		});
	};
	withSpec("no images", [](auto &create) { create.imageCount = 0; });
	withSpec("very many images", [](auto &create) { create.imageCount = ~0u; });
	withSpec("very wide", [](auto &create) { create.spec.width = 1u << 31; });
	withSpec("no height", [](auto &create) { create.spec.height = 0; });
	withSpec("very many layers", [](auto &create) { create.spec.arrayLayers = 1u << 30; });
	withSpec("more levels than there are", [](auto &create) { create.spec.mipLevels = 32; });
	withSpec("samples that no GPU has", [](auto &create) { create.spec.samples = 3; });
}

TEST_F(HostileClient, SubmissionsOutOfRange)
{
	const auto withImage = [this](const char *what, const std::function<void(ipc::SubImage &)> &change) {
		expectFramesClosed(what, [&](ipc::Submission &submission) { change(submission.layers[0].views[0].image); });
	};
	withImage("an unknown swapchain", [](auto &image) { image.swapchain = 1u << 30; });
	withImage("the neighbour's swapchain", [](auto &image) { --image.swapchain; });
	withImage("an image beyond the last", [](auto &image) { image.image = 3; });
	withImage("an array layer beyond the last", [](auto &image) { image.arrayIndex = 1; });
	withImage("a rectangle beyond the image", [](auto &image) { image.width = 65; });
	withImage("a rectangle whose end wraps round", [](auto &image) { image.x = 0x7fffffff, image.width = 0x7fffffff; });
	withImage("a rectangle before the image", [](auto &image) { image.y = -1; });
	for (const float wrong : {NAN, INFINITY, -INFINITY, 1e30f}) {
		expectFramesClosed("a pose nowhere", [&](auto &submission) { submission.layers[0].views[0].pose.position.x = wrong; });
		expectFramesClosed("a size without end", [&](auto &submission) { submission.layers[0].width = wrong; });
	}
	expectFramesClosed("a quaternion of length 0", [](auto &submission) { submission.layers[0].views[0].pose.orientation = {}; });
	expectFramesClosed("very many layers", [](auto &submission) { submission.layerCount = ~0u; });
	expectFramesClosed("layers that are missing", [](auto &submission) { submission.layerCount = 16; });
	expectFramesClosed("an unknown kind of layer", [](auto &submission) { submission.layers[0].type = ipc::LayerType(9); });
	expectFramesClosed("an unknown blend mode", [](auto &submission) { submission.blendMode = 77; });
	expectFramesClosed("the number of a submission that has been", [](auto &submission) { submission.frame = 0; });
	expectFramesClosed("a request in the frame channel",
					   [](auto &submission) { submission.header.type = ipc::MessageType::createSession; });
	expectFramesClosed(
		"half a submission", [](auto &) {}, 40);
}

TEST_F(HostileClient, QuotasAreRefusedAndTheClientGoesOn)
{
	RawClient client(service());
	ASSERT_TRUE(client.begin());
	gpu::ImageSpec large = RawClient::smallImages();
	large.width = large.height = 8192;
	large.arrayLayers = 64;
	EXPECT_FALSE(client.makeSwapchain(large)) << "3 x 16 GiB";
	const auto refused = client.received.as<ipc::Failed>();
	ASSERT_TRUE(refused);
	EXPECT_EQ(refused->result, XR_ERROR_OUT_OF_MEMORY);
	EXPECT_NE(ipc::textOf(refused->text).find("MiB"), std::string::npos);
	EXPECT_TRUE(client.makeSwapchain()) << "what it may have it gets";
}

TEST_F(HostileClient, DescriptorsNobodyAskedForAreClosed)
{
	std::array<int, ipc::maxFds> kinds{};
	const UniqueFd file(::open("/dev/zero", O_RDWR | O_CLOEXEC)), folder(::open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
	const UniqueFd memory(::memfd_create("unsealed", MFD_CLOEXEC));
	for (size_t i = 0; i < kinds.size(); ++i) kinds[i] = i % 3 == 0 ? file.get() : i % 3 == 1 ? folder.get() : memory.get();
	RawClient client(service());
	ASSERT_TRUE(client.begin() && client.makeSwapchain());
	const size_t before = descriptorsOf(service().process().pid());
	for (int i = 0; i < 50; ++i) {
		ASSERT_TRUE(client.ask<ipc::Failed>(ipc::CreateSession{}, kinds)) << "a second session is refused, whatever comes with it";
		ASSERT_EQ(client.frames->send(client.quad(uint64_t(i) + 1), kinds, realTime() + second), ipc::Transfer::done);
	}
	// The last submissions may lie in the socket still, and what came with one be on its way to being closed.
	EXPECT_TRUE(eventually(service(), [&](const auto &) { return descriptorsOf(service().process().pid()) <= before + 8; }));
}

/// What the service reads while it composes must stay where it is.
TEST_F(HostileClient, SharedMemoryCanNeitherShrinkNorBeWritten)
{
	RawClient client(service());
	ASSERT_TRUE(client.begin() && client.makeSwapchain());
	for (uint64_t number = 1; number <= 2; ++number) ASSERT_TRUE(client.frame(number));
	for (const UniqueFd &page : client.pages) {
		EXPECT_NE(::ftruncate(page.get(), 0), 0);
		EXPECT_NE(::fcntl(page.get(), F_ADD_SEALS, F_SEAL_WRITE), 0);
		void *writable = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, page.get(), 0);
		EXPECT_EQ(writable, MAP_FAILED);
		void *readable = ::mmap(nullptr, 4096, PROT_READ, MAP_SHARED, page.get(), 0);
		ASSERT_NE(readable, MAP_FAILED);
		EXPECT_NE(::mprotect(readable, 4096, PROT_READ | PROT_WRITE), 0) << "nor made writable later";
		::munmap(readable, 4096);
	}
	for (const UniqueFd &image : client.images) {
		EXPECT_FALSE(image && ::ftruncate(image.get(), 0) == 0) << "an image that is being shown";
	}
	for (uint64_t number = 3; number <= 5; ++number) EXPECT_TRUE(client.frame(number));
}

TEST_F(HostileClient, WhoNeverReadsIsLetGo)
{
	RawClient client(service());
	ASSERT_TRUE(client.begin());
	for (const XrTime end = realTime() + 5 * second; realTime() < end;) // each is answered, and nobody takes the answers
		if (client.socket.send(ipc::CreateSession{}, realTime() + 4 * second) != ipc::Transfer::done) break;
	EXPECT_TRUE(client.isClosed());
	RawClient frames(service());
	ASSERT_TRUE(frames.begin() && frames.makeSwapchain());
	for (uint64_t number = 1; number <= 3000; ++number) { // a flood that hears nothing
		frames.frames->send(ipc::WaitFrame{}, 0);
		frames.frames->send(frames.quad(number), 0);
	}
	EXPECT_TRUE(frames.isServed()) << "the compositor waits for no reader";
}

TEST_F(HostileClient, WhoGoesInTheMiddleLeavesNothing)
{
	for (int stage = 0; stage < 5; ++stage) {
		SCOPED_TRACE(stage);
		RawClient client(service());
		if (stage == 1) client.send(ipc::Hello{});
		EXPECT_TRUE(stage != 2 || client.greet());
		EXPECT_TRUE(stage < 3 || (client.begin() && client.makeSwapchain()));
		if (stage == 4) {
			EXPECT_TRUE(client.frame(1));
			client.frames.reset(); // the frame channel alone
			EXPECT_TRUE(client.isServed());
		}
	}
}

/// More than the service takes: those who come too many are closed, and when they have gone there is room again.
TEST_F(HostileClient, ACrowdIsTurnedAwayAndForgotten)
{
	{
		std::vector<std::unique_ptr<RawClient>> crowd;
		for (int i = 0; i < 100; ++i) crowd.push_back(std::make_unique<RawClient>(service()));
		EXPECT_TRUE(crowd.back()->isClosed()) << "or let go of because it says nothing";
	}
	bool served = false;
	for (const XrTime end = realTime() + 20 * second; !served && realTime() < end;) {
		RawClient next(service());
		served = next.greet();
	}
	EXPECT_TRUE(served);
}
