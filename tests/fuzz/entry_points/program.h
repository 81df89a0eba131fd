// An input as a program: calls of entry points, and what happens around them. Records of a byte that says what, a byte that says how many
// bytes follow for it, and these.
#pragma once
#include "tests/fuzz/entry_points/world.h"
#include <map>
#include <set>

namespace arift::fuzz
{

struct Step {
	uint8_t what = 0;
	Bytes choices;
};
std::vector<Step> stepsIn(Bytes input);

/// Beside the functions, which are numbered from 0 as entryPoints() is.
enum Happening : uint8_t { hangUp = 251, fail, play, tell, makeSession };

class Program
{
public:
	explicit Program(World &world) : world_(world) {}
	void run(Bytes input);

private:
	void take(const Step &step);
	void call(size_t number, Choices choices);
	/// A function as the application has it: from the newest instance that has it, or from one before.
	PFN_xrVoidFunction find(const char *name);
	/// Nothing that would wait for the program's own next call is called.
	bool mayBegin(std::string_view name, uint64_t handle) const;
	/// What the program must remember of a call that succeeded.
	void note(std::string_view name, uint64_t handle);
	void destroyInstances();

	World &world_;
	State state_;
	std::map<std::string, PFN_xrVoidFunction, std::less<>> functions_;
	std::set<uint64_t> waited_;           ///< sessions with a frame that was waited for and not begun
	std::map<uint64_t, uint64_t> frames_; ///< of sessions with graphics: submitted
};

} // namespace arift::fuzz
