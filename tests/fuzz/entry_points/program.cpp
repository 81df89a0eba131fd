#include "tests/fuzz/entry_points/program.h"
#include "runtime/openxr/functions.h"
#include "tests/fuzz/entry_points/functions.h"
#include "tests/fuzz/entry_points/texts.h"

namespace arift::fuzz
{
namespace
{

constexpr size_t mostSteps = 100, mostInstances = 3;

/// Where it does not hold it says of what.
void requireOf(const EntryPoint &entry, XrResult result, bool holds, const char *what)
{
	if (!holds) std::fprintf(stderr, "%s returned %d\n", entry.name, int(result));
	require(holds, what);
}

} // namespace

std::vector<Step> stepsIn(Bytes input)
{
	std::vector<Step> steps;
	while (input.size() >= 2 && steps.size() < mostSteps) {
		const size_t size = std::min<size_t>(input[1], input.size() - 2);
		steps.push_back({input[0], input.subspan(2, size)});
		input = input.subspan(2 + size);
	}
	return steps;
}

void Program::run(Bytes input)
{
	for (const Step &step : stepsIn(input)) take(step);
	destroyInstances();
	world_.end();
}

void Program::take(const Step &step)
{
	const Choices choices(step.choices);
	switch (step.what) {
	case Happening::hangUp: return world_.hangUp();
	case Happening::fail: return world_.fail(choices);
	case Happening::play: return world_.play(choices);
	case Happening::tell: return world_.tell(choices);
	case Happening::makeSession: return world_.makeSession(state_);
	default: return call(step.what % entryPoints().size(), choices);
	}
}

void Program::call(size_t number, Choices choices)
{
	const EntryPoint &entry = entryPoints()[number];
	const std::string_view name = entry.name;
	const PFN_xrVoidFunction function = find(entry.name);
	if (!function || (name == "xrCreateInstance" && state_.handles.alive<XrInstance>().size() >= mostInstances)) return;
	Call call{.making = {state_, choices, {}}, .parameters = entry.parameters, .mayBegin = [&](uint64_t handle) {
				  return mayBegin(name, handle);
			  }};
	const uint32_t before = openxr::handles.size();
	const std::optional<XrResult> result = entry.call(call, function);
	if (!result) return;
	static const bool isTold = std::getenv("ARIFT_FUZZ_TELL") != nullptr;
	if (isTold) std::fprintf(stderr, "%s: %s\n", entry.name, openxr::nameOf(*result));
	requireOf(entry, *result, entry.mayReturn(*result) || (*result == XR_ERROR_RUNTIME_FAILURE && world_.mayFail()),
			  "a function returns what the specification says of it");
	if (*result < 0) requireOf(entry, *result, openxr::handles.size() == before, "a call that fails makes and destroys nothing");
	if (*result >= 0) note(name, call.handle);
}

PFN_xrVoidFunction Program::find(const char *name)
{
	PFN_xrVoidFunction function = nullptr;
	openxr::getInstanceProcAddr(state_.handles.newest<XrInstance>(), name, &function);
	if (function) functions_[name] = function;
	const auto found = functions_.find(name);
	return found == functions_.end() ? nullptr : found->second;
}

bool Program::mayBegin(std::string_view name, uint64_t handle) const { return name != "xrWaitFrame" || !waited_.contains(handle); }

void Program::note(std::string_view name, uint64_t handle)
{
	if (name == "xrWaitFrame") waited_.insert(handle);
	if (name == "xrBeginFrame" || name == "xrBeginSession") waited_.erase(handle);
	if (name == "xrEndFrame") {
		const auto &session = openxr::handles.at<openxr::Session>(reinterpret_cast<XrSession>(handle)); // NOLINT(performance-no-int-to-ptr)
		if (session.graphics()) world_.settle(session, ++frames_[handle]);
	}
	if (name == "xrCreateInstance") {
		auto &instance = openxr::handles.at<openxr::Instance>(state_.handles.newest<XrInstance>());
		for (const char *path : knownPaths()) instance.paths.atom(path);
	}
}

void Program::destroyInstances()
{
	const std::vector<XrSession> sessions = state_.handles.alive<XrSession>();
	for (const XrInstance handle : state_.handles.alive<XrInstance>()) {
		const auto &instance = openxr::handles.at<openxr::Instance>(handle);
		const bool hasSession = std::ranges::any_of(
			sessions, [&](XrSession session) { return &openxr::handles.at<openxr::Session>(session).instance == &instance; });
		require(instance.hasSession == hasSession, "an instance knows whether it has a session");
	}
	const auto destroy = reinterpret_cast<PFN_xrDestroyInstance>(find("xrDestroyInstance"));
	for (const XrInstance instance : state_.handles.alive<XrInstance>())
		require(destroy(instance) == XR_SUCCESS, "an instance can be destroyed");
}

} // namespace arift::fuzz
