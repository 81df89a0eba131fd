// An application reduced to its messages: what is sent is the test's own affair.
#pragma once
#include "tests/e2e/common/private_service.h"
#include <array>
#include <optional>

namespace arift::e2e
{

constexpr XrDuration patience = 60 * second; // real time: a busy machine is slow

class RawClient
{
public:
	explicit RawClient(const PrivateService &service) : socket(connectTo(service.tree()).value()) {}

	/// Sends the bytes of anything at all.
	template <typename Anything> ipc::Transfer send(const Anything &anything, size_t size = sizeof(Anything), std::span<const int> fds = {})
	{
		return socket.send({reinterpret_cast<const std::byte *>(&anything), size}, fds, realTime() + second);
	}
	/// A request and its reply; nothing where another kind of reply, or none, comes.
	template <typename Reply, typename Request> std::optional<Reply> ask(Request request, std::span<const int> fds = {})
	{
		request.header.sequence = ++sequence_;
		if (socket.send(request, fds, realTime() + second) != ipc::Transfer::done) return std::nullopt;
		if (socket.receive(received, realTime() + patience) != ipc::Transfer::done) return std::nullopt;
		return received.as<Reply>();
	}
	/// Says hello, as whom the test likes.
	bool greet(ipc::Role role = ipc::Role::application)
	{
		ipc::Hello hello;
		hello.role = role;
		ipc::copyText(hello.applicationName, "boundary test");
		if (!ask<ipc::Welcome>(hello)) return false;
		for (size_t i = 0; i < received.fdCount; ++i) pages[i] = std::move(received.fds[i]);
		return true;
	}
	/// A running session on the service's own GPU.
	bool begin()
	{
		if (!greet()) return false;
		const auto welcome = received.as<ipc::Welcome>();
		const auto created =
			ask<ipc::SessionCreated>(ipc::CreateSession{.deviceUuid = welcome->deviceUuid, .driverUuid = welcome->driverUuid});
		if (!created || received.fdCount < 1) return false; // the probe may be the second
		session = created->session;
		frames.emplace(std::move(received.fds[0]));
		return ask<ipc::Done>(ipc::SessionRunning{.session = session, .running = 1}).has_value();
	}
	/// Three small images. Their memory stays in `images`.
	bool makeSwapchain(gpu::ImageSpec spec = smallImages())
	{
		const auto created = ask<ipc::SwapchainCreated>(ipc::CreateSwapchain{.session = session, .spec = spec});
		if (!created) return false;
		swapchain = created->swapchain;
		for (size_t i = 0; i < received.fdCount; ++i) images[i] = std::move(received.fds[i]);
		return true;
	}
	static gpu::ImageSpec smallImages()
	{
		constexpr int32_t r8g8b8a8Srgb = 43;
		constexpr uint32_t sampledColourAttachment = 0x14;
		return {.format = r8g8b8a8Srgb, .usage = sampledColourAttachment, .width = 64, .height = 48};
	}
	/// A quad a metre ahead that shows the first image.
	ipc::Submission quad(uint64_t frame) const
	{
		ipc::Submission submission;
		submission.frame = frame;
		submission.displayTime = realTime();
		submission.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		submission.layerCount = 1;
		ipc::Layer &layer = submission.layers[0];
		layer.type = ipc::LayerType::quad;
		layer.views[0].pose = {{0, 0, 0, 1}, {0, 0, -1}};
		layer.views[0].image = {.swapchain = swapchain, .image = 0, .width = 64, .height = 48};
		layer.width = layer.height = 1;
		return submission;
	}
	/// Waits for a frame and submits one with the quad; says whether the service answered.
	bool frame(uint64_t number)
	{
		if (frames->send(ipc::WaitFrame{}, realTime() + second) != ipc::Transfer::done) return false;
		if (frames->receive(received, realTime() + patience) != ipc::Transfer::done) return false;
		return received.as<ipc::FrameReady>() && frames->send(quad(number), realTime() + second) == ipc::Transfer::done;
	}
	/// Whether the service ends the connection within a limit, whatever it says before.
	bool isClosed(XrDuration limit = patience)
	{
		for (const XrTime end = realTime() + limit; realTime() < end;)
			if (socket.receive(received, end) == ipc::Transfer::hungUp) return true;
		return false;
	}
	/// Whether the service still answers: with a session, or with why there is none.
	bool isServed() { return ask<ipc::Failed>(ipc::CreateSession{}) || received.as<ipc::SessionCreated>(); }

	ipc::Socket socket;
	ipc::Received received;
	std::array<UniqueFd, 3> pages;
	std::array<UniqueFd, ipc::maxImages> images;
	uint32_t session = 0, swapchain = 0;
	std::optional<ipc::Socket> frames;

private:
	uint32_t sequence_ = 0;
};

} // namespace arift::e2e
