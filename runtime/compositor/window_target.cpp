// A window on an X display, for people without the panel: the panel image scaled to fit, black around it.
#include "runtime/base/log.h"
#include "runtime/compositor/target.h"
#include "runtime/gpu/handles.h"
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <stdexcept>
#include <xcb/xcb.h>

#include <vulkan/vulkan_xcb.h> // needs xcb's types

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

constexpr uint64_t acquireLimitNs = 50'000'000;
constexpr vk::ImageSubresourceLayers colourLayer{vk::ImageAspectFlagBits::eColor, 0, 0, 1};

/// Owns what malloc made, as xcb hands it out.
template <typename T> using Reply = std::unique_ptr<T, decltype([](T *reply) { std::free(reply); })>;

/// A window and its events.
class XcbWindow
{
public:
	XcbWindow(VkExtent2D size, const char *title) : connection_(xcb_connect(nullptr, nullptr))
	{
		if (xcb_connection_has_error(connection_.get())) throw std::runtime_error("no X display can be opened (DISPLAY)");
		const xcb_screen_t *screen = xcb_setup_roots_iterator(xcb_get_setup(connection_.get())).data;
		window_ = xcb_generate_id(connection_.get());
		const uint32_t values[] = {screen->black_pixel, XCB_EVENT_MASK_STRUCTURE_NOTIFY | XCB_EVENT_MASK_KEY_PRESS};
		xcb_create_window(connection_.get(), XCB_COPY_FROM_PARENT, window_, screen->root, 0, 0, uint16_t(size.width), uint16_t(size.height),
						  0, XCB_WINDOW_CLASS_INPUT_OUTPUT, screen->root_visual, XCB_CW_BACK_PIXEL | XCB_CW_EVENT_MASK, values);
		xcb_change_property(connection_.get(), XCB_PROP_MODE_REPLACE, window_, XCB_ATOM_WM_NAME, XCB_ATOM_STRING, 8,
							uint32_t(std::strlen(title)), title);
		const xcb_atom_t protocols = atom("WM_PROTOCOLS");
		deleteWindow_ = atom("WM_DELETE_WINDOW");
		xcb_change_property(connection_.get(), XCB_PROP_MODE_REPLACE, window_, protocols, XCB_ATOM_ATOM, 32, 1, &deleteWindow_);
		escapeKeys_ = keysFor(escape);
		xcb_map_window(connection_.get(), window_);
		xcb_flush(connection_.get());
	}

	/// What has happened since the last call.
	struct News {
		bool closed = false;  ///< by a person, or by another program: now or earlier
		uint32_t rawKeys = 0; ///< presses of the Escape key
	};
	News news()
	{
		News news;
		while (const Reply<xcb_generic_event_t> event{xcb_poll_for_event(connection_.get())}) {
			const uint8_t type = event->response_type & 0x7f;
			const auto *message = reinterpret_cast<const xcb_client_message_event_t *>(event.get());
			const auto *key = reinterpret_cast<const xcb_key_press_event_t *>(event.get());
			if (type == XCB_DESTROY_NOTIFY || (type == XCB_CLIENT_MESSAGE && message->data.data32[0] == deleteWindow_)) closed_ = true;
			if (type == XCB_KEY_PRESS && std::ranges::find(escapeKeys_, key->detail) != escapeKeys_.end()) news.rawKeys++;
		}
		news.closed = closed_;
		return news;
	}
	/// The display has gone away.
	bool isGone() const { return xcb_connection_has_error(connection_.get()) != 0; }
	xcb_connection_t *connection() const { return connection_.get(); }
	xcb_window_t window() const { return window_; }

private:
	xcb_atom_t atom(const char *name)
	{
		const auto cookie = xcb_intern_atom(connection_.get(), 0, uint16_t(std::strlen(name)), name);
		const Reply<xcb_intern_atom_reply_t> reply{xcb_intern_atom_reply(connection_.get(), cookie, nullptr)};
		return reply ? reply->atom : xcb_atom_t(XCB_ATOM_NONE);
	}
	/// The keys that make a symbol, in whatever row of the keyboard's table.
	std::vector<xcb_keycode_t> keysFor(xcb_keysym_t symbol)
	{
		const xcb_setup_t *setup = xcb_get_setup(connection_.get());
		const uint8_t first = setup->min_keycode, count = uint8_t(setup->max_keycode - first + 1);
		const auto cookie = xcb_get_keyboard_mapping(connection_.get(), first, count);
		const Reply<xcb_get_keyboard_mapping_reply_t> reply{xcb_get_keyboard_mapping_reply(connection_.get(), cookie, nullptr)};
		std::vector<xcb_keycode_t> keys;
		if (!reply || reply->keysyms_per_keycode == 0) return keys;
		const std::span symbols(xcb_get_keyboard_mapping_keysyms(reply.get()),
								size_t(xcb_get_keyboard_mapping_keysyms_length(reply.get())));
		for (size_t i = 0; i < symbols.size(); ++i)
			if (symbols[i] == symbol) keys.push_back(xcb_keycode_t(first + i / reply->keysyms_per_keycode));
		return keys;
	}

	static constexpr xcb_keysym_t escape = 0xff1b; // XK_Escape of X11/keysymdef.h
	std::unique_ptr<xcb_connection_t, decltype([](xcb_connection_t *c) { xcb_disconnect(c); })> connection_;
	xcb_window_t window_ = 0;
	xcb_atom_t deleteWindow_ = XCB_ATOM_NONE;
	std::vector<xcb_keycode_t> escapeKeys_;
	bool closed_ = false;
};

vk::raii::SurfaceKHR makeSurface(const gpu::Device::Handles &gpu, const XcbWindow &window)
{
	if (!gpu.canPresent) throw std::runtime_error("the Vulkan device cannot show windows");
	const auto create = reinterpret_cast<PFN_vkCreateXcbSurfaceKHR>(gpu.instance.getProcAddr("vkCreateXcbSurfaceKHR"));
	if (!create) throw std::runtime_error("Vulkan has no VK_KHR_xcb_surface");
	const VkXcbSurfaceCreateInfoKHR info{VK_STRUCTURE_TYPE_XCB_SURFACE_CREATE_INFO_KHR, nullptr, 0, window.connection(), window.window()};
	VkSurfaceKHR surface = VK_NULL_HANDLE;
	if (create(*gpu.instance, &info, nullptr, &surface) != VK_SUCCESS) throw std::runtime_error("the window has no Vulkan surface");
	vk::raii::SurfaceKHR owned(gpu.instance, surface);
	if (!gpu.physical.getSurfaceSupportKHR(gpu.queueFamily, *owned))
		throw std::runtime_error("the Vulkan device cannot draw to this X display");
	return owned;
}

vk::SurfaceFormatKHR encodedFormat(const gpu::Device::Handles &gpu, const vk::raii::SurfaceKHR &surface)
{
	for (const auto &format : gpu.physical.getSurfaceFormatsKHR(*surface))
		if (format.format == vk::Format::eB8G8R8A8Srgb || format.format == vk::Format::eR8G8B8A8Srgb) return format;
	throw std::runtime_error("the X display offers no sRGB format");
}

/// The largest rectangle of the image's shape in the middle of the window.
std::array<vk::Offset3D, 2> fitted(VkExtent2D image, vk::Extent2D window)
{
	const double scale = std::min(double(window.width) / image.width, double(window.height) / image.height);
	const int width = int(image.width * scale), height = int(image.height * scale);
	const int x = (int(window.width) - width) / 2, y = (int(window.height) - height) / 2;
	return {vk::Offset3D{x, y, 0}, vk::Offset3D{x + width, y + height, 1}};
}

class WindowTarget final : public Target
{
public:
	WindowTarget(gpu::Device &device, Clock &clock, const Pacer::Settings &pacing, VkExtent2D size)
		: gpu_(device.handles()),
		  clock_(clock),
		  period_(pacing.period),
		  window_(size, "ARift"),
		  surface_(makeSurface(gpu_, window_)),
		  format_(encodedFormat(gpu_, surface_)),
		  pool_(gpu_.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, gpu_.queueFamily}),
		  commands_(gpu_.device, {*pool_, vk::CommandBufferLevel::ePrimary, 1}),
		  acquired_(gpu_.device, vk::FenceCreateInfo{}),
		  copied_(gpu_.device, vk::FenceCreateInfo{})
	{
	}

	Result present(VkImage image, VkExtent2D extent, const Pacer::Refresh &refresh) override
	{
		const XcbWindow::News news = window_.news();
		if (!window_.isGone() && !news.closed) show(image, extent);
		const XrDuration late = clock_.now() - refresh.vblank;
		const XrDuration refreshesLate = late <= 0 ? 0 : (late + period_ - 1) / period_;
		const Presented outcome = window_.isGone() ? Presented::gone : news.closed ? Presented::closed : Presented::shown;
		return {outcome, refresh.display + refreshesLate * period_, news.rawKeys};
	}
	std::string name() const override { return "window"; }

private:
	/// False while the window has no size (minimised).
	bool makeSwapchain()
	{
		const auto limits = gpu_.physical.getSurfaceCapabilitiesKHR(*surface_);
		size_ = limits.currentExtent;
		if (size_.width == 0 || size_.height == 0 || size_.width == UINT32_MAX) return false;
		const uint32_t most = limits.maxImageCount ? limits.maxImageCount : UINT32_MAX;
		vk::SwapchainCreateInfoKHR info{{},
										*surface_,
										std::min(limits.minImageCount + 1, most),
										format_.format,
										format_.colorSpace,
										size_,
										1,
										vk::ImageUsageFlagBits::eTransferDst,
										vk::SharingMode::eExclusive,
										{},
										limits.currentTransform,
										vk::CompositeAlphaFlagBitsKHR::eOpaque,
										vk::PresentModeKHR::eFifo,
										true};
		swapchain_ = vk::raii::SwapchainKHR(gpu_.device, info);
		images_ = swapchain_.getImages();
		return true;
	}

	/// A surface may be lost because its X server is: then there is no other.
	void replaceSurface()
	{
		forgetSwapchain();
		surface_ = nullptr;
		if (window_.isGone()) return;
		log::warning("the window's surface is lost: another is made");
		try {
			surface_ = makeSurface(gpu_, window_);
		} catch (const std::runtime_error &) {
			if (!window_.isGone()) throw;
		}
	}

	/// A window that was resized or that does not take images just now misses this one.
	void show(VkImage image, VkExtent2D extent)
	{
		try {
			if (!*swapchain_ && !makeSwapchain()) return;
			const auto [result, index] = swapchain_.acquireNextImage(acquireLimitNs, {}, *acquired_);
			if (result == vk::Result::eTimeout || result == vk::Result::eNotReady) return;
			if (gpu_.device.waitForFences(*acquired_, true, uint64_t(gpu_.patience.count())) != vk::Result::eSuccess)
				throw std::runtime_error("the window's image is not handed over");
			gpu_.device.resetFences(*acquired_);
			record(image, extent, images_[index]);
			gpu_.submitAndWait(commands_.front(), copied_);
			const auto shown = gpu_.queue.lock()->presentKHR({{}, *swapchain_, index});
			if (shown == vk::Result::eSuboptimalKHR) forgetSwapchain();
		} catch (const vk::OutOfDateKHRError &) {
			forgetSwapchain();
		} catch (const vk::SurfaceLostKHRError &) {
			replaceSurface();
		} catch (const vk::SystemError &) {
			if (!window_.isGone()) throw;
			forgetSwapchain();
		}
	}

	void record(VkImage image, VkExtent2D extent, vk::Image target)
	{
		const vk::raii::CommandBuffer &commands = commands_.front();
		const auto barrier = [&](Access from, Access to, Layout before, Layout after) {
			commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {},
									 vk::ImageMemoryBarrier{from, to, before, after, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
															target, gpu::wholeColour});
		};
		commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
		barrier({}, Access::eTransferWrite, Layout::eUndefined, Layout::eTransferDstOptimal);
		commands.clearColorImage(target, Layout::eTransferDstOptimal, vk::ClearColorValue{}, gpu::wholeColour);
		barrier(Access::eTransferWrite, Access::eTransferWrite, Layout::eTransferDstOptimal, Layout::eTransferDstOptimal);
		const std::array from{vk::Offset3D{}, vk::Offset3D{int(extent.width), int(extent.height), 1}};
		commands.blitImage(image, Layout::eTransferSrcOptimal, target, Layout::eTransferDstOptimal,
						   vk::ImageBlit{colourLayer, from, colourLayer, fitted(extent, size_)}, vk::Filter::eLinear);
		barrier(Access::eTransferWrite, {}, Layout::eTransferDstOptimal, Layout::ePresentSrcKHR);
		commands.end();
	}

	void forgetSwapchain()
	{
		images_.clear();
		swapchain_ = nullptr;
	}

	gpu::Device::Handles &gpu_;
	Clock &clock_;
	XrDuration period_;
	XcbWindow window_;
	vk::raii::SurfaceKHR surface_;
	vk::SurfaceFormatKHR format_;
	vk::raii::SwapchainKHR swapchain_{nullptr};
	std::vector<vk::Image> images_;
	vk::Extent2D size_;
	vk::raii::CommandPool pool_;
	vk::raii::CommandBuffers commands_;
	vk::raii::Fence acquired_, copied_;
};

} // namespace

std::vector<const char *> windowExtensions()
{
	const char *display = std::getenv("DISPLAY");
	if (!display || !*display) return {};
	return {VK_KHR_SURFACE_EXTENSION_NAME, VK_KHR_XCB_SURFACE_EXTENSION_NAME};
}

std::unique_ptr<Target> makeWindowTarget(gpu::Device &device, Clock &clock, const Pacer::Settings &pacing, VkExtent2D size)
{
	return std::make_unique<WindowTarget>(device, clock, pacing, size);
}

} // namespace arift
