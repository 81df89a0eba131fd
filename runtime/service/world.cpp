#include "runtime/service/world.h"
#include "runtime/motion/spaces.h"
#include "runtime/service/swapchains.h"

namespace arift
{

Opened World::await(Stage stage, XrDuration limit)
{
	auto access = opened.lock();
	const bool settled = access.waitFor({}, std::chrono::nanoseconds(limit), [&](const Opened &now) { return now.stage >= stage; });
	if (!settled) throw Refused(XR_ERROR_RUNTIME_UNAVAILABLE, "arift-service has not opened its headset yet; its log says how far it is");
	if (access->stage == Stage::failed) throw Refused(XR_ERROR_RUNTIME_UNAVAILABLE, access->problem);
	if (access->stage == Stage::stopping) throw Refused(XR_ERROR_RUNTIME_UNAVAILABLE, "arift-service is being stopped");
	return *access;
}

void World::recenter()
{
	const XrTime now = clock.now();
	const HeadMotion head = PoseHistory(*poses).at(now);
	XrPosef moved = identityPose;
	views.update([&](ipc::ViewTable &table) {
		const XrPosef before = table.localInOrigin;
		table = recentred(table, head);
		moved = inverse(before) * table.localInOrigin;
	});
	applications.tellRecentered(moved, now);
}

ApplicationSettings World::settingsOf(const std::string &name)
{
	ApplicationSettings settings;
	if (const auto all = applicationSettings.lock(); all->contains(name)) settings = all->at(name);
	if (settings.blendModes.empty()) settings.blendModes = config.blendModes;
	return settings;
}

} // namespace arift
