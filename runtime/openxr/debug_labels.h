// What an application says it is doing in a session (XR_EXT_debug_utils, "Session Labels").
#pragma once
#include "runtime/base/guarded.h"
#include <string>
#include <vector>

namespace arift::openxr
{

/// Thread-safe. Regions lie in one another; an individual label stands until the next call.
class DebugLabels
{
public:
	void begin(const char *name) { put({name, true}); }
	void insert(const char *name) { put({name, false}); }
	/// Ends the innermost region; without one nothing happens.
	void end()
	{
		const auto all = all_.lock();
		dropIndividual(*all);
		if (!all->empty()) all->pop_back();
	}
	/// The newest first.
	std::vector<std::string> names() const
	{
		const auto all = all_.lock();
		std::vector<std::string> names;
		for (auto label = all->rbegin(); label != all->rend(); ++label) names.push_back(label->name);
		return names;
	}

private:
	struct Label {
		std::string name;
		bool region;
	};
	static void dropIndividual(std::vector<Label> &all)
	{
		if (!all.empty() && !all.back().region) all.pop_back();
	}
	void put(Label label)
	{
		const auto all = all_.lock();
		dropIndividual(*all);
		all->push_back(std::move(label));
	}

	mutable Guarded<std::vector<Label>> all_;
};

} // namespace arift::openxr
