// A small OpenXR application that shows a transparent image, and stops where it is told to:   stopping_application POINT FRAMES
// It stops itself when it is first at the named point after FRAMES frames; at the point "never" it goes on for ever.
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include "runtime/ipc/messages.h"
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace
{

using arift::ipc::MessageType;

std::string_view stopPoint = "never";
std::atomic<bool> mayStop = false; ///< for good once it does: what a frame submits may be sent when the next one has begun
std::atomic<bool> hasStopped = false;

void pass(std::string_view point)
{
	if (mayStop && point == stopPoint && !hasStopped.exchange(true)) ::raise(SIGSTOP);
}

} // namespace

/// In the place of the C library's: the points inside the runtime's own calls are those where it is about to tell the service something.
extern "C" __attribute__((visibility("default"))) ssize_t sendmsg(int fd, const msghdr *message, int flags)
{
	MessageType type{};
	if (message->msg_iovlen == 1 && message->msg_iov[0].iov_len >= sizeof type)
		std::memcpy(&type, message->msg_iov[0].iov_base, sizeof type);
	if (type == MessageType::submission) pass("inside xrEndFrame");
	const ssize_t sent = ::syscall(SYS_sendmsg, fd, message, flags);
	if (type == MessageType::waitFrame) pass("inside xrWaitFrame");
	return sent;
}

namespace
{

using namespace arift::e2e;

class StoppingApplication final : public DrawingApplication
{
public:
	explicit StoppingApplication(long frames)
		: DrawingApplication("stopping_application"),
		  frames_(frames),
		  space_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  images_(session_, {256, 256}, 1),
		  pool_(vulkan_.device, {.queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = uint32_t(2 * images_.count())})
	{
		constexpr std::array clear{0.0f, 0.0f, 0.0f, 0.0f};
		for (size_t image = 0; image < images_.count(); ++image)
			for (const size_t pending : {0, 1}) {
				const vk::raii::CommandBuffer &commands = commands_[2 * image + pending];
				commands.begin({.flags = vk::CommandBufferUsageFlagBits::eSimultaneousUse});
				recordFill(commands, images_[image], images_.format, clear, pending ? 2000 : 1); // not finished for a long time
				commands.end();
			}
	}

private:
	void frame() override
	{
		if (frames_-- == 0) mayStop = true;
		pass("before xrWaitFrame");
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		pass("after xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		pass("after xrBeginFrame");
		draw();
		std::array<XrView, 2> views;
		locate(state.predictedDisplayTime, space_, views);
		const ProjectionLayer layer(space_, views, {images_.all(), images_.all()});
		endFrame(state.predictedDisplayTime, {layer.header()});
		pass("after xrEndFrame");
	}
	void draw()
	{
		uint32_t index = 0;
		check(xrAcquireSwapchainImage(images_.handle(), nullptr, &index), "xrAcquireSwapchainImage");
		pass("image acquired");
		const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
		check(xrWaitSwapchainImage(images_.handle(), &wait), "xrWaitSwapchainImage");
		pass("image waited for");
		const bool pending = mayStop && !hasStopped && (stopPoint == "work submitted" || stopPoint == "image released");
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands_[2 * index + (pending ? 1 : 0)]});
		pass("work submitted");
		images_.release();
		pass("image released");
	}

	long frames_;
	const Space space_;
	const DrawnImages images_;
	const vk::raii::CommandPool pool_;
	const vk::raii::CommandBuffers commands_;
};

} // namespace

int main(int count, char **arguments)
{
	if (count != 3) {
		std::fprintf(stderr, "usage: stopping_application POINT FRAMES\n");
		return 2;
	}
	stopPoint = arguments[1];
	constexpr int never = 0;
	return runApplication("stopping_application", [&] { StoppingApplication(std::atol(arguments[2])).run(never); });
}
