// The panel in a window: what an X client sees there is what the service says it shows.
#include "tests/e2e/common/child_process.h"
#include "tests/e2e/common/private_tree.h"
#include "tests/e2e/common/x_server.h"
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <png.h>
#include <sstream>
#include <thread>
#include <unistd.h>
#include <xcb/xcb.h>

namespace arift::e2e
{
namespace
{

using namespace std::chrono_literals;

constexpr uint16_t panelWidth = 1280, panelHeight = 800;

template <typename T> using Reply = std::unique_ptr<T, decltype([](T *reply) { std::free(reply); })>;
using Pixels = std::vector<uint8_t>; ///< red, green, blue

template <typename Condition> bool await(std::chrono::seconds limit, Condition holds)
{
	for (const auto deadline = std::chrono::steady_clock::now() + limit; std::chrono::steady_clock::now() < deadline;) {
		if (holds()) return true;
		std::this_thread::sleep_for(50ms);
	}
	return false;
}

class XClient
{
public:
	explicit XClient(const std::string &display) : connection_(xcb_connect(display.c_str(), nullptr)) {}
	/// Pixels of a window of the panel's size, if there is one.
	Pixels panelWindow() const
	{
		xcb_connection_t *const c = connection_.get();
		if (xcb_connection_has_error(c)) return {};
		const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(c)).data->root;
		const Reply<xcb_query_tree_reply_t> tree{xcb_query_tree_reply(c, xcb_query_tree(c, root), nullptr)};
		for (int i = 0; tree && i < xcb_query_tree_children_length(tree.get()); ++i) {
			const xcb_window_t window = xcb_query_tree_children(tree.get())[i];
			const auto cookie = xcb_get_image(c, XCB_IMAGE_FORMAT_Z_PIXMAP, window, 0, 0, panelWidth, panelHeight, ~0u);
			const Reply<xcb_get_image_reply_t> image{xcb_get_image_reply(c, cookie, nullptr)};
			if (!image || xcb_get_image_data_length(image.get()) != 4 * panelWidth * panelHeight) continue;
			Pixels pixels;
			const uint8_t *at = xcb_get_image_data(image.get());
			for (size_t p = 0; p < size_t(panelWidth) * panelHeight; ++p, at += 4) pixels.insert(pixels.end(), {at[2], at[1], at[0]});
			return pixels;
		}
		return {};
	}

private:
	std::unique_ptr<xcb_connection_t, decltype([](xcb_connection_t *c) { xcb_disconnect(c); })> connection_;
};

Pixels readPng(const std::filesystem::path &file)
{
	png_image image{};
	image.version = PNG_IMAGE_VERSION;
	if (!png_image_begin_read_from_file(&image, file.c_str())) return {};
	image.format = PNG_FORMAT_RGB;
	Pixels pixels(PNG_IMAGE_SIZE(image));
	png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
	return pixels;
}

class Window : public testing::Test
{
protected:
	void SetUp() override
	{
		if (!XServer::isThere()) GTEST_SKIP() << "there is no Xvfb (package xvfb)";
		server_.emplace(tree_);
		display_ = server_->display();
	}

	std::map<std::string, std::string> environment() const
	{
		auto environment = tree_.environment();
		environment["DISPLAY"] = display_;
		return environment;
	}
	/// What `arift ARGUMENTS` prints; nothing where it fails.
	std::string arift(std::vector<std::string> arguments)
	{
		arguments.insert(arguments.begin(), (programDirectory() / "arift").string());
		ChildProcess command(arguments, environment(), tree_.root() / ("arift-" + std::to_string(++commands_) + ".log"));
		return command.wait(20s) == 0 ? command.output() : "";
	}
	uint64_t shown()
	{
		const auto status = nlohmann::json::parse(arift({"status", "--json"}), nullptr, false);
		return status.is_object() ? status["frames"]["shown"].get<uint64_t>() : 0;
	}

	PrivateTree tree_;
	std::optional<XServer> server_;
	std::string display_;
	int commands_ = 0;
};

TEST_F(Window, ShowsThePanel)
{
	const std::vector<std::string> settings{
		"headset.driver=synthetic",           "compositor.target=window",     "synthetic.motion=rest",
		"synthetic.tracker_noise=false",      "synthetic.camera_noise=false", "synthetic.tracker_quantisation=false",
		"synthetic.gyro_bias=[0.0, 0.0, 0.0]"};
	std::vector<std::string> command{(programDirectory() / "arift-service").string()};
	for (const std::string &setting : settings) command.insert(command.end(), {"--set", setting});
	ChildProcess service(command, environment(), tree_.root() / "service.log");
	ASSERT_TRUE(await(180s, [&] { return shown() > 60; })) << service.output();

	const std::filesystem::path picture = tree_.root() / "panel.png";
	const XClient client(display_);
	// The world is at rest: as soon as its images have faded in, the picture and the window are the same.
	const auto same = [&] {
		arift({"screenshot", picture.string()});
		const Pixels window = client.panelWindow(), panel = readPng(picture);
		size_t different = 0;
		for (size_t i = 0; i < panel.size() && window.size() == panel.size(); ++i) different += std::abs(window[i] - panel[i]) > 2;
		return !panel.empty() && window.size() == panel.size() && different < panel.size() / 1000;
	};
	EXPECT_TRUE(await(60s, same)) << service.output();
	const Pixels window = client.panelWindow();
	EXPECT_GT(std::ranges::count_if(window, [](uint8_t value) { return value > 40; }), std::ptrdiff_t(window.size() / 10))
		<< "something can be seen";
	EXPECT_EQ(service.stop(), 0) << service.output();
}

TEST_F(Window, WithoutTheDisplayItNamesTheServiceSaysSo)
{
	auto without = environment();
	without["DISPLAY"] = ":4711";
	ChildProcess service(
		{(programDirectory() / "arift-service").string(), "--set", "headset.driver=synthetic", "--set", "compositor.target=window"},
		without, tree_.root() / "service.log");
	EXPECT_TRUE(await(180s, [&] { return service.output().find("DISPLAY") != std::string::npos; })) << service.output();
}

} // namespace
} // namespace arift::e2e
