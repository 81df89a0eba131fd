// XR_EXT_active_action_set_priority: action sets with another priority for one synchronization.
#pragma once
#include "runtime/openxr/action.h"

namespace arift::openxr
{

/// Of an active action set, by the chain of XrActionsSyncInfo. Throws XR_ERROR_VALIDATION_FAILURE.
inline uint32_t priorityOf(const ActionSet &set, const void *next)
{
	const auto *priorities = findInChain<XrActiveActionSetPrioritiesEXT>(next);
	if (!priorities) return set.core->priority;
	if (priorities->actionSetPriorityCount > 0 && !priorities->actionSetPriorities)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "actionSetPriorities is null");
	for (const auto &priority : std::span(priorities->actionSetPriorities, priorities->actionSetPriorityCount))
		if (priority.actionSet == handleOf(set)) return priority.priorityOverride;
	return set.core->priority;
}

} // namespace arift::openxr
