#include "runtime/base/toml_document.h"
#include <fstream>
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
	EXPECT_EQ(complaint("[s]\n\nb = 1", [](TomlTable &t) { t.table("s").finish(); }), "x.toml:3: unknown key s.b = 1, expected one of: ");
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

TEST(TomlTable, SaysWhatAnUnknownKeyCouldHaveBeen)
{
	EXPECT_EQ(complaint("sped = 1",
						[](TomlTable &t) {
							t.number("speed", 0, 1, 0);
							EXPECT_FALSE(t.has("rate"));
							t.boolean("loop", true);
						}),
			  "x.toml:1: unknown key sped = 1, expected one of: loop, rate, speed");
}

namespace
{
std::string complaintAbout(const TomlDocument &document, const char *table, const char *key)
{
	try {
		document.root().table(table).complain(key, "another");
	} catch (const InputError &error) {
		return error.what();
	}
}
} // namespace

TEST(TomlDocument, ValuesRememberWhereTheyStand)
{
	const auto folder = std::filesystem::path(testing::TempDir()) / "arift-toml-document";
	std::filesystem::create_directories(folder);
	const auto file = folder / "x.toml";
	std::ofstream(file) << "[a]\nb = 1\nc = 'd'\n";
	TomlDocument document(file);
	document.set("a.b=2");
	document.set("e.f=[1, 2]");
	document.set("e.g=bare/word");
	EXPECT_EQ(complaintAbout(document, "a", "b"), "--set a.b=2: a.b = 2, expected another");
	EXPECT_EQ(complaintAbout(document, "a", "c"), file.string() + ":3: a.c = 'd', expected another");
	EXPECT_EQ(complaintAbout(document, "a", "x"), file.string() + ":1: a.x is missing, expected another");
	EXPECT_EQ(complaintAbout(document, "e", "f"), "--set e.f=[1, 2]: e.f = [ 1, 2 ], expected another");
	EXPECT_EQ(complaintAbout(document, "none", "x"), file.string() + ": none.x is missing, expected another");
	EXPECT_EQ(document.root().table("a").path("c"), folder / "d");
	EXPECT_EQ(document.root().table("e").path("g"), std::filesystem::current_path() / "bare/word");
	std::filesystem::remove_all(folder);
}

TEST(TomlDocument, NoneSaysNothing)
{
	EXPECT_EQ(rootOf(nullptr).table("a").number("b", 0, 1, 0.5), 0.5);
	EXPECT_EQ(complaintAbout(TomlDocument(), "a", "b"), "configuration: a.b is missing, expected another");
}
