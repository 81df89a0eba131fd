#include "runtime/base/toml.h"
#include <gtest/gtest.h>

using namespace arift;

namespace
{
std::string complaint(const char *text, void (*read)(TomlTable &))
{
	const toml::table parsed = toml::parse(text);
	TomlTable table(parsed, "x.toml", "");
	try {
		read(table);
		table.finish();
	} catch (const InputError &error) {
		return error.what();
	}
	return "";
}
} // namespace

TEST(TomlTable, NamesFileLineValueAndWhatWasExpected)
{
	EXPECT_EQ(complaint("\na = 7", [](TomlTable &t) { t.number("a", 0, 5); }), "x.toml:2: a = 7, expected a number from 0 to 5");
	EXPECT_EQ(complaint("a = 'b'", [](TomlTable &t) { t.choice("a", {"x", "y"}, 0); }), "x.toml:1: a = 'b', expected one of \"x\", \"y\"");
	EXPECT_EQ(complaint("[s]\n\nb = 1", [](TomlTable &t) { t.table("s").finish(); }), "x.toml:3: unknown key s.b = 1");
	EXPECT_EQ(complaint("", [](TomlTable &t) { t.text("name"); }), "x.toml:1: name is missing, expected a text in quotes");
	EXPECT_EQ(complaint("a = [1, 'x']", [](TomlTable &t) { t.numbers("a", 2); }),
			  "x.toml:1: a = [ 1, 'x' ], expected an array of 2 numbers");
}

TEST(TomlTable, ReadsWhatIsThereAndDefaultsWhatIsNot)
{
	EXPECT_EQ(complaint("a = 3\nb = true\nc = [1, 2.5]\n[d]\n",
						[](TomlTable &t) {
							EXPECT_EQ(t.number("a", 0, 5), 3);
							EXPECT_TRUE(t.boolean("b", false));
							EXPECT_EQ(t.numbers("c", 0), (std::vector<double>{1, 2.5}));
							EXPECT_EQ(t.table("d").number("e", 0, 1, 0.25), 0.25);
							EXPECT_EQ(t.table("absent").text("f", "g"), "g");
						}),
			  "");
}
