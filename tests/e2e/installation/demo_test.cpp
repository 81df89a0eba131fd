// tools/demo.sh as its reader runs it, but for installing packages and building: those are done before any test runs.
#include "tests/e2e/common/command.h"
#include <gtest/gtest.h>
#include <png.h>
#include <regex>

namespace arift::e2e
{
namespace
{

namespace fs = std::filesystem;

struct Picture {
	uint32_t width = 0, height = 0;
	std::vector<uint8_t> rgb;
};

Picture readPng(const fs::path &file)
{
	png_image image{};
	image.version = PNG_IMAGE_VERSION;
	if (!png_image_begin_read_from_file(&image, file.c_str())) return {};
	image.format = PNG_FORMAT_RGB;
	Picture picture{image.width, image.height, std::vector<uint8_t>(PNG_IMAGE_SIZE(image))};
	png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr);
	return picture;
}

double litShare(const Picture &picture)
{
	size_t lit = 0;
	for (const uint8_t value : picture.rgb) lit += value > 24;
	return double(lit) / double(picture.rgb.size());
}

/// The numbers of the table's row that begins with `label`; empty where there is no such row.
std::vector<double> row(const std::string &output, const std::string &label)
{
	std::smatch found;
	if (!std::regex_search(output, found, std::regex("\n  " + label + "[^\n]*? +([0-9.]+)(?: / ([0-9.]+))?\n"))) return {};
	std::vector<double> numbers{std::stod(found[1])};
	if (found[2].matched) numbers.push_back(std::stod(found[2]));
	return numbers;
}

class Demonstration : public testing::Test
{
protected:
	void SetUp() override
	{
		// Where the script looks for its checkout: its own folder is the real one, pictures are written here.
		fs::create_directories(checkout / "build");
		fs::create_directory_symlink(SOURCE_DIRECTORY "/tools", checkout / "tools");
		fs::create_directory_symlink(BUILD_DIRECTORY, checkout / "build/release");
		tool("dpkg-query", "echo install ok installed");
		tool("cmake", ":");
		tool("ninja", ":");
	}
	void tool(const std::string &name, const std::string &command) const
	{
		const fs::path file = tree.write("tools/" + name, "#!/bin/sh\n" + command + "\n");
		fs::permissions(file, fs::perms::owner_all);
	}
	Ran run(std::vector<std::string> arguments) const
	{
		arguments.insert(arguments.begin(), {"/bin/bash", (checkout / "tools/demo.sh").string()});
		auto environment = tree.environment();
		environment["PATH"] = (tree.root() / "tools").string() + ":" + environment["PATH"];
		return runCommand(tree, arguments, environment, std::chrono::seconds(240));
	}

	const PrivateTree tree;
	const fs::path checkout = tree.root() / "checkout";
};

TEST_F(Demonstration, WritesItsPicturesAndItsTable)
{
#ifdef ARIFT_SANITIZED
	GTEST_SKIP() << "figures of a build with sanitizers say nothing";
#endif
	const Ran demo = run({"--seconds", "2"});
	ASSERT_EQ(demo.status, 0) << demo.output;
	const Picture panel = readPng(checkout / "demo/panel.png"), eyes = readPng(checkout / "demo/eyes.png");
	EXPECT_EQ(panel.width, 1280u);
	EXPECT_EQ(panel.height, 800u);
	EXPECT_GT(litShare(panel), 0.3) << "the world is in it";
	EXPECT_GT(eyes.width, eyes.height) << "both eyes side by side";
	EXPECT_GT(litShare(eyes), 0.3);
	for (const char *label : {"start-up", "frames shown per second", "CPU per shown frame"}) {
		const std::vector<double> figure = row(demo.output, label);
		ASSERT_EQ(figure.size(), 1u) << label << '\n' << demo.output;
		EXPECT_GT(figure[0], 0) << label;
	}
	for (const char *label : {"age of the camera image when shown, ms", "age of the pose when shown, ms"}) {
		const std::vector<double> figure = row(demo.output, label);
		ASSERT_EQ(figure.size(), 2u) << label << '\n' << demo.output;
		EXPECT_GT(figure[0], 20) << "the panel alone takes 25 ms";
		EXPECT_GE(figure[1], figure[0]) << label;
	}
	const std::vector<double> registration = row(demo.output, "registration error, panel pixels");
	ASSERT_EQ(registration.size(), 2u) << demo.output;
	EXPECT_LE(registration[0], 1);
	EXPECT_LE(registration[1], 2);
}

TEST_F(Demonstration, WrongUseIsExplained)
{
	const struct {
		std::vector<std::string> arguments;
		const char *expected;
	} table[] = {{{"--seconds", "ten"}, "--seconds expects a whole number from 1 to 99999, found \"ten\""},
				 {{"--motion", "/no/such/file.csv"}, "/no/such/file.csv"},
				 {{"--recording", "/no/such/folder"}, "/no/such/folder"},
				 {{"--fly"}, "unknown option \"--fly\""}};
	for (const auto &use : table) {
		const Ran ran = run(use.arguments);
		EXPECT_EQ(ran.status, 2) << ran.output;
		EXPECT_NE(ran.output.find(use.expected), std::string::npos) << ran.output;
		EXPECT_FALSE(fs::exists(checkout / "demo")) << "nothing was begun";
	}
}

} // namespace
} // namespace arift::e2e
