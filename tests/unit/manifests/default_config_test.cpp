// The commented configuration tells the truth: every setting in it is read by somebody, and stands there with its default.
#include "drivers/synthetic/settings.h"
#include "runtime/base/toml_document.h"
#include "runtime/service/config.h"
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace arift
{
namespace
{

/// A file of manifests with the comment signs taken away from its settings, but not from those in `except`.
std::filesystem::path uncommented(const std::string &name, const std::vector<std::string> &except, const std::string &of = "config.toml")
{
	const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
	std::ifstream in(MANIFESTS "/" + of);
	EXPECT_TRUE(in.is_open());
	std::ofstream out(file);
	static const std::regex setting("^#([a-z_]+) = ");
	for (std::string line; std::getline(in, line);) {
		std::smatch match;
		const bool isSetting = std::regex_search(line, match, setting) && std::ranges::find(except, match[1].str()) == except.end();
		out << (isSetting ? line.substr(1) : line) << '\n';
	}
	return file;
}

TEST(DefaultConfiguration, ReadsAsTheDefaults)
{
	const Config given = readConfig(uncommented("config.toml", {"rate"}), {});
	const Config defaults = readConfig({}, {});
	EXPECT_EQ(given.driver, defaults.driver);
	EXPECT_EQ(given.rig, defaults.rig);
	EXPECT_EQ(given.clock, defaults.clock);
	EXPECT_EQ(given.passthroughDistance, defaults.passthroughDistance);
	EXPECT_EQ(given.viewOffset, defaults.viewOffset);
	EXPECT_EQ(given.blendModes, defaults.blendModes);
	EXPECT_EQ(given.eyeHeight, defaults.eyeHeight);
	EXPECT_EQ(given.bounds, defaults.bounds);
	EXPECT_EQ(given.target, defaults.target);
	EXPECT_EQ(given.images, defaults.images);
	EXPECT_EQ(given.input, defaults.input);
}

TEST(DefaultConfiguration, AnApplicationsSettingsAreItsDefaults)
{
	const std::filesystem::path file = uncommented("applications.toml", {}, "applications.toml");
	const ApplicationTable given = readConfig({}, {}, {.applications = file}).applications;
	ASSERT_EQ(given.size(), 1u);
	EXPECT_EQ(given.begin()->first, "Name of an application");
	EXPECT_EQ(given.begin()->second.passthrough, ForcedPassthrough{});
	EXPECT_EQ(given.begin()->second.blendModes, Config().blendModes);
	const ApplicationTable shipped = readConfig({}, {}, {.applications = MANIFESTS "/applications.toml"}).applications;
	EXPECT_TRUE(shipped.begin()->second.blendModes.empty()) << "nothing is set as long as nobody takes a comment sign away";
}

TEST(DefaultConfiguration, TheSyntheticHeadsetsSettingsAreItsDefaults)
{
	const synthetic::Settings given = synthetic::readSettings(std::make_shared<TomlDocument>(uncommented("synthetic.toml", {})));
	const synthetic::Settings defaults;
	EXPECT_EQ(given.motion, defaults.motion);
	EXPECT_EQ(given.motionDelay, defaults.motionDelay);
	EXPECT_EQ(given.seed, defaults.seed);
	EXPECT_EQ(given.errors.noise, defaults.errors.noise);
	EXPECT_EQ(given.errors.quantisation, defaults.errors.quantisation);
	for (int i = 0; i < 3; ++i) EXPECT_NEAR(given.errors.angularVelocityBias[i], defaults.errors.angularVelocityBias[i], 1e-4);
	EXPECT_EQ(given.trackerLatency, defaults.trackerLatency);
	EXPECT_EQ(given.reportRate, defaults.reportRate);
	EXPECT_EQ(given.cameraRate, defaults.cameraRate);
	EXPECT_EQ(given.exposure, defaults.exposure);
	EXPECT_EQ(given.cameraNoise, defaults.cameraNoise);
	EXPECT_EQ(given.transferDelay, defaults.transferDelay);
	EXPECT_EQ(given.cameraPhase, defaults.cameraPhase);
	EXPECT_EQ(given.cameraJitter, defaults.cameraJitter);
	EXPECT_EQ(given.blackLevel, defaults.blackLevel);
	EXPECT_EQ(given.motionFile, defaults.motionFile);
	EXPECT_EQ(given.truth, defaults.truth);
	EXPECT_EQ(given.markers.size(), defaults.markers.size());
}

/// What may stand at a place of the configuration: the complaint about a key that may not says it.
std::vector<std::string> keysOf(const std::string &prefix)
{
	try {
		readConfig({}, {prefix + "no_such_key=1"});
	} catch (const InputError &error) {
		const std::string message = error.what(), before = "expected one of: ";
		std::istringstream list(message.substr(message.find(before) + before.size()));
		std::vector<std::string> keys;
		for (std::string key; std::getline(list >> std::ws, key, ',');) keys.push_back(key);
		return keys;
	}
	ADD_FAILURE() << prefix;
	return {};
}

TEST(DefaultConfiguration, ListsEverySetting)
{
	std::map<std::string, std::set<std::string>> listed;
	std::ifstream in(MANIFESTS "/config.toml");
	std::string section;
	static const std::regex header("^\\[([a-z_]+)\\]"), setting("^#([a-z_]+) = ");
	for (std::string line; std::getline(in, line);) {
		std::smatch match;
		if (std::regex_search(line, match, header)) section = match[1];
		if (std::regex_search(line, match, setting)) listed[section].insert(match[1]);
	}
	std::set<std::string> ofApplications;
	std::ifstream applications(MANIFESTS "/applications.toml");
	for (std::string line; std::getline(applications, line);)
		if (std::smatch match; std::regex_search(line, match, setting)) ofApplications.insert(match[1]);
	const std::vector<std::string> ofOne = keysOf("applications.any.");
	EXPECT_EQ(ofApplications, std::set<std::string>(ofOne.begin(), ofOne.end()));
	const std::vector<std::string> sections = keysOf("");
	EXPECT_EQ(sections.size(), 10u);
	for (const std::string &name : sections) {
		if (name == "applications") continue; // a file of its own
		const std::vector<std::string> keys = keysOf(name + ".");
		EXPECT_EQ(listed[name], std::set<std::string>(keys.begin(), keys.end())) << name;
	}
}

} // namespace
} // namespace arift
