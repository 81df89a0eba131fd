// The service's configuration. Input: the file, then what each --set asks for, separated by lines of four dashes.
#include "runtime/service/config.h"
#include "runtime/base/error.h"
#include "tests/fuzz/input.h"
#include <cmath>

using namespace arift;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const fuzz::Folder folder;
	fuzz::Bytes rest(data, size);
	const std::filesystem::path file = folder.write("config.toml", fuzz::nextPart(rest));
	std::vector<std::string> overrides;
	while (!rest.empty()) {
		const fuzz::Bytes part = fuzz::nextPart(rest);
		overrides.emplace_back(part.begin(), part.end());
		if (overrides.back().ends_with('\n')) overrides.back().pop_back();
	}
	try {
		const Config config = readConfig(file, overrides);
		fuzz::require(config.document != nullptr, "drivers have something to read");
		fuzz::require(config.rate >= 0.001 && config.rate <= 100, "the rate is in range");
		fuzz::require(config.passthroughDistance >= 0.1 && config.passthroughDistance <= 1000, "the distance is in range");
		fuzz::require(config.viewOffset >= 0 && config.viewOffset <= 1, "the view offset is in range");
		fuzz::require(config.blendModes.size() >= 1 && config.blendModes.size() <= 3, "there are blend modes, none twice");
		fuzz::require(config.recording.empty() || config.recording.is_absolute(), "paths begin where they are named");
	} catch (const InputError &error) {
		const std::string message = error.what();
		fuzz::require(message.starts_with(file.string()) || message.starts_with("--set "), "the complaint begins with the place");
	}
	return 0;
}
