// The panel in a window whose swapchain, surface, display or owner does not stay.
#include "tests/common/temporary_folder.h"
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/x_server.h"
#include <csignal>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <xcb/xcb.h>

using namespace arift::e2e;
using namespace std::chrono_literals;

namespace
{

template <typename T> using Reply = std::unique_ptr<T, decltype([](T *reply) { std::free(reply); })>;

template <typename Condition> bool await(Condition holds, std::chrono::seconds limit = 60s)
{
	for (const auto end = std::chrono::steady_clock::now() + limit; std::chrono::steady_clock::now() < end;
		 std::this_thread::sleep_for(20ms))
		if (holds()) return true;
	return false;
}

class WindowFaults : public testing::Test
{
protected:
	void SetUp() override
	{
		if (!XServer::isThere()) GTEST_SKIP() << "there is no Xvfb (package xvfb)";
		server_.emplace(tree_);
		auto environment = tree_.environment();
		environment["DISPLAY"] = server_->display();
		environment["VK_INSTANCE_LAYERS"] = "VK_LAYER_ARIFT_faults";
		environment["VK_LAYER_PATH"] = FAULT_LAYERS;
		environment["ARIFT_FAULTS"] = faults_.path().string();
		service_.emplace(std::vector<std::string>{(programDirectory() / "arift-service").string(), "--set", "headset.driver=synthetic",
												  "--set", "compositor.target=window", "--set", "synthetic.motion=rest"},
						 environment, tree_.root() / "service.log");
		ASSERT_TRUE(await([&] { return shown() > 5; })) << service_->output();
	}
	nlohmann::json status() const
	{
		const Ran answer = runArift(tree_, {"status", "--json"});
		return answer.status == 0 ? nlohmann::json::parse(answer.output) : nlohmann::json();
	}
	uint64_t shown() const
	{
		const auto now = status();
		return now.is_null() ? 0 : now["frames"]["shown"].get<uint64_t>();
	}
	bool goesOn() const
	{
		const uint64_t before = shown();
		return before > 0 && await([&] { return shown() > before + 5; }, 20s);
	}
	bool isTaken(const char *fault) const
	{
		return await([&] { return !std::filesystem::exists(faults_.path() / fault); }, 20s);
	}
	bool says(const std::string &text) const { return service_->output().find(text) != std::string::npos; }

	/// Sends the service's window an event, as a window manager or a keyboard would.
	void send(const std::function<void(xcb_connection_t *, xcb_window_t)> &event) const
	{
		const std::unique_ptr<xcb_connection_t, decltype([](xcb_connection_t *c) { xcb_disconnect(c); })> connection(
			xcb_connect(server_->display().c_str(), nullptr));
		xcb_connection_t *const c = connection.get();
		const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(c)).data->root;
		const Reply<xcb_query_tree_reply_t> windows{xcb_query_tree_reply(c, xcb_query_tree(c, root), nullptr)};
		ASSERT_TRUE(windows && xcb_query_tree_children_length(windows.get()) > 0);
		event(c, xcb_query_tree_children(windows.get())[0]);
		xcb_flush(c);
		const Reply<xcb_get_input_focus_reply_t> done{xcb_get_input_focus_reply(c, xcb_get_input_focus(c), nullptr)}; // has arrived
	}
	void close() const
	{
		send([](xcb_connection_t *c, xcb_window_t window) {
			const auto atom = [&](const char *name) {
				const auto cookie = xcb_intern_atom(c, 1, uint16_t(std::strlen(name)), name);
				const Reply<xcb_intern_atom_reply_t> reply{xcb_intern_atom_reply(c, cookie, nullptr)};
				return reply ? reply->atom : xcb_atom_t(0);
			};
			xcb_client_message_event_t message{};
			message.response_type = XCB_CLIENT_MESSAGE;
			message.format = 32;
			message.window = window;
			message.type = atom("WM_PROTOCOLS");
			message.data.data32[0] = atom("WM_DELETE_WINDOW");
			xcb_send_event(c, 0, window, 0, reinterpret_cast<const char *>(&message));
		});
	}
	void pressEscape() const
	{
		send([](xcb_connection_t *c, xcb_window_t window) {
			const xcb_setup_t *setup = xcb_get_setup(c);
			const uint8_t first = setup->min_keycode;
			const Reply<xcb_get_keyboard_mapping_reply_t> keys{
				xcb_get_keyboard_mapping_reply(c, xcb_get_keyboard_mapping(c, first, uint8_t(setup->max_keycode - first + 1)), nullptr)};
			const xcb_keysym_t *symbols = xcb_get_keyboard_mapping_keysyms(keys.get());
			uint8_t code = first;
			while (symbols[(code - first) * keys->keysyms_per_keycode] != 0xff1b) ++code; // XK_Escape
			xcb_key_press_event_t press{};
			press.response_type = XCB_KEY_PRESS;
			press.detail = code;
			press.event = window;
			xcb_send_event(c, 0, window, 0, reinterpret_cast<const char *>(&press));
		});
	}

	const PrivateTree tree_;
	const arift::test::TemporaryFolder faults_;
	std::optional<XServer> server_;
	std::optional<ChildProcess> service_;
};

} // namespace

TEST_F(WindowFaults, ASwapchainThatDoesNotFitAnyMoreIsMadeAnew)
{
	for (const char *fault : {"out_of_date", "suboptimal", "surface_lost"}) {
		std::ofstream(faults_.path() / fault) << "please";
		EXPECT_TRUE(isTaken(fault)) << fault << "\n" << service_->output();
		EXPECT_TRUE(goesOn()) << fault << "\n" << service_->output();
	}
	EXPECT_TRUE(says("the window's surface is lost: another is made"));
	EXPECT_FALSE(says("no images can be made")) << "neither is a reason to begin anew";
	EXPECT_EQ(service_->stop(), 0) << service_->output();
}

TEST_F(WindowFaults, AClosedWindowEndsTheServiceInOrder)
{
	close();
	EXPECT_EQ(service_->wait(20s), 0) << service_->output();
	EXPECT_TRUE(says("the window was closed")) << service_->output();
}

TEST_F(WindowFaults, WithoutItsDisplayImagesAreStillMade)
{
	::kill(server_->process().pid(), SIGKILL);
	EXPECT_TRUE(await([&] { return says("the window has gone: images are composed offscreen from here on"); }, 20s)) << service_->output();
	EXPECT_TRUE(goesOn()) << service_->output();
	EXPECT_EQ(service_->stop(), 0) << service_->output();
}

TEST_F(WindowFaults, EscapeShowsTheCamerasAloneAtOnceAndHologramsAgain)
{
	auto environment = tree_.environment();
	ChildProcess cube({(programDirectory() / "hologram_cube").string()}, environment, tree_.root() / "cube.log");
	ASSERT_TRUE(await([&] {
		const auto now = status();
		return !now.is_null() && !now["clients"].empty() && now["clients"][0]["shown"] > 5;
	})) << cube.output();
	const auto picture = [&](const char *name) {
		const auto file = tree_.root() / name;
		EXPECT_EQ(runArift(tree_, {"screenshot", file.string()}).status, 0);
		return contentOf(file);
	};
	pressEscape();
	ASSERT_TRUE(await([&] { return status()["passthrough"]["raw"] == true; }, 10s)) << service_->output();
	EXPECT_TRUE(says("key: the cameras alone are shown"));
	EXPECT_EQ(status()["clients"][0]["state"], "running") << "the application goes on unseen";
	pressEscape();
	ASSERT_TRUE(await([&] { return status()["passthrough"]["raw"] == false; }, 10s)) << service_->output();
	EXPECT_FALSE(picture("holograms.png").empty());
}
