// The one place where a client's bytes become values. Pure: the same bytes and the same swapchains always give the same answer.
#pragma once
#include "runtime/base/error.h"
#include "runtime/ipc/socket.h"
#include <functional>
#include <variant>

namespace arift
{

/// What a client may ask on its connection.
using Request = std::variant<ipc::Hello, ipc::CreateSession, ipc::DestroySession, ipc::SessionRunning, ipc::CreateSwapchain,
							 ipc::DestroySwapchain, ipc::ShowPassthrough, ipc::StylePassthrough, ipc::GetStatus, ipc::Screenshot,
							 ipc::SetSetting, ipc::Recenter, ipc::ShutDown, ipc::ForcePassthrough>;

/// What comes through a session's frame channel.
using FrameRequest = std::variant<ipc::WaitFrame, ipc::Submission, ipc::Relinquish, ipc::Vibrate>;

/// A client sent what no library of ours sends. It is to be disconnected; what() is for the log.
struct Malformed : InputError {
	using InputError::InputError;
};

/// Limits on what one client may ask for.
struct Quota {
	static constexpr uint32_t swapchains = 64;
	static constexpr uint32_t extent = 8192;           ///< texels, width and height
	static constexpr uint64_t imageBytes = 3ull << 30; ///< memory of all images together
};

/// What a submission's references are checked against: nothing where the session has no such swapchain.
struct SwapchainShape {
	uint32_t width = 0, height = 0, arraySize = 1, imageCount = 0; ///< arraySize: cubes, or array layers
	gpu::ImageKind kind = gpu::ImageKind::flat;
};
using FindSwapchain = std::function<std::optional<SwapchainShape>(uint32_t swapchain)>;

/// Throws Malformed.
Request decodeRequest(const ipc::Received &received);
/// Throws Malformed. Every index, rectangle, count and enum of a submission that is returned is in range, every number finite, every pose
/// valid.
FrameRequest decodeFrameRequest(const ipc::Received &received, const FindSwapchain &find);

} // namespace arift
