// Every entry point of the OpenXR library with structures of every kind. Input: a program, see entry_points/program.h.
// Left out is what the specification leaves undefined: pointers to nothing, chains without an end, and objects of a graphics API that are
// none. So the bindings of graphics APIs are in no chain, sessions with graphics are made of a GPU that is none (FakeGraphics), and
// xrGetVulkanInstanceExtensionsKHR, xrGetVulkanDeviceExtensionsKHR, xrGetVulkanGraphicsDeviceKHR, xrGetVulkanGraphicsDevice2KHR,
// xrCreateVulkanInstanceKHR and xrCreateVulkanDeviceKHR, which take a VkInstance or make one, are not called.
#include "runtime/openxr/functions.h"
#include "tests/fuzz/entry_points/functions.h"
#include "tests/fuzz/entry_points/program.h"
#include <random>

using namespace arift;

extern "C" size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t maxSize);

namespace
{

/// A function that was added to the library and is not tried would be missed by nobody.
void requireAllFunctions()
{
	std::vector<std::string_view> known;
	for (const fuzz::EntryPoint &entry : fuzz::entryPoints()) known.push_back(entry.name);
	known.insert(known.end(), fuzz::leftOut().begin(), fuzz::leftOut().end());
	std::vector<const char *> names = openxr::functionNames();
	for (const char *name : names) {
		if (std::ranges::find(known, name) != known.end()) continue;
		std::fprintf(stderr, "%s is not among tests/fuzz/entry_points/functions.cpp\n", name);
		fuzz::require(false, "every function of the library is tried or left out");
	}
	fuzz::require(names.size() == known.size(), "every function that is tried is the library's");
}

/// A program that can be changed.
struct Draft {
	uint8_t what = 0;
	std::vector<uint8_t> choices;
};

std::vector<Draft> draftOf(fuzz::Bytes input)
{
	std::vector<Draft> drafts;
	for (const fuzz::Step &step : fuzz::stepsIn(input)) drafts.push_back({step.what, {step.choices.begin(), step.choices.end()}});
	return drafts;
}

std::vector<uint8_t> bytesOf(const std::vector<Draft> &drafts)
{
	std::vector<uint8_t> bytes;
	for (const auto &[what, choices] : drafts) {
		bytes.push_back(what);
		bytes.push_back(uint8_t(choices.size()));
		bytes.insert(bytes.end(), choices.begin(), choices.end());
	}
	return bytes;
}

void mutateChoices(Draft &draft)
{
	std::array<uint8_t, 255> bytes{};
	std::ranges::copy(draft.choices, bytes.begin());
	const size_t size = LLVMFuzzerMutate(bytes.data(), draft.choices.size(), bytes.size());
	draft.choices.assign(bytes.begin(), bytes.begin() + ptrdiff_t(size));
}

/// One step more, less, elsewhere, or with other choices.
void mutate(std::vector<Draft> &drafts, std::minstd_rand &random)
{
	const auto anyWhere = [&](size_t size) { return ptrdiff_t(random() % size); };
	if (drafts.empty() || random() % 4 == 0) {
		drafts.insert(drafts.begin() + anyWhere(drafts.size() + 1), {uint8_t(random()), {}});
		return;
	}
	const auto one = drafts.begin() + anyWhere(drafts.size());
	switch (random() % 6) {
	case 0: drafts.erase(one); break;
	case 1: {
		const Draft copy = *one;
		drafts.insert(drafts.begin() + anyWhere(drafts.size() + 1), copy);
		break;
	}
	case 2: std::swap(*one, drafts[size_t(anyWhere(drafts.size()))]); break;
	default: mutateChoices(*one);
	}
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int *, char ***)
{
	::setenv("ARIFT_LOG", "off", 0);
	requireAllFunctions();
	return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t maxSize, unsigned seed)
{
	std::minstd_rand random(seed);
	std::vector<Draft> drafts = draftOf({data, size});
	for (unsigned i = random() % 3; i < 3; ++i) mutate(drafts, random);
	const std::vector<uint8_t> bytes = bytesOf(drafts);
	const size_t taken = std::min(bytes.size(), maxSize);
	std::copy_n(bytes.begin(), taken, data);
	return taken;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static fuzz::World world;
	fuzz::Program(world).run({data, size});
	return 0;
}
