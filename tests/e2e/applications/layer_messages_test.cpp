// The reader of layer messages sees what layers print, and only that; otherwise "silent" would mean nothing.
#include "tests/e2e/applications/layer_messages.h"
#include <fstream>
#include <gtest/gtest.h>

namespace arift::e2e
{

TEST(LayerMessages, FindsEachLayersErrorsAndWarnings)
{
	const std::string text = "Validation Error: [ VUID-vkCmdDraw-None-02859 ] Object 0: handle = 0x1\n"
							 "Validation Performance Warning: [ UNASSIGNED-slow ] | MessageID = 0x1\n"
							 "[3.1 s][VALID_ERROR | VUID-xrEndFrame-session-parameter | xrEndFrame] : bad\n"
							 "[3.1 s][VALID_DEBUG | VUID-CoreValidation-Initialize | xrCreateApiLayerInstance] : fine\n"
							 "Error [GENERAL | xrCreateInstance | OpenXR-Loader] : failed\n"
							 "an application's own Error: [ 5 ]\n";
	const auto found = unexpectedMessages(text, {});
	ASSERT_EQ(found.size(), 4u);
	EXPECT_TRUE(found[0].starts_with("VUID-vkCmdDraw-None-02859: "));
	EXPECT_TRUE(found[1].starts_with("UNASSIGNED-slow: "));
	EXPECT_TRUE(found[2].starts_with("VUID-xrEndFrame-session-parameter: "));
	EXPECT_TRUE(found[3].starts_with("OpenXR-Loader: "));
	EXPECT_EQ(unexpectedMessages(text, {"UNASSIGNED-slow"}).size(), 3u);
}

TEST(LayerMessages, AnExpectedIdNeedsAReason)
{
	const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "expected_messages.txt";
	std::ofstream(file) << "# comment\n\nVUID-a because of b\n";
	EXPECT_EQ(expectedMessages(file), std::vector<std::string>{"VUID-a"});
	std::ofstream(file) << "VUID-a   # no reason\n";
	EXPECT_THROW(expectedMessages(file), std::runtime_error);
}

} // namespace arift::e2e
