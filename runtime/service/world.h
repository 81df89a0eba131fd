// What all clients share: the pages, who runs, and the devices once they are open.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/base/guarded.h"
#include "runtime/base/trace.h"
#include "runtime/gpu/device.h"
#include "runtime/ipc/messages.h"
#include "runtime/ipc/shared_memory.h"
#include "runtime/motion/pose_history.h"
#include "runtime/service/applications.h"
#include "runtime/service/config.h"
#include "runtime/service/overrides.h"
#include "runtime/service/realtime.h"
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace arift
{

class Compositor;
class Session;

/// Where views and spaces are: the service's copy, published as a whole with every change. Thread-safe.
class Views
{
public:
	explicit Views(ipc::SystemPage &page) : page_(page) {}
	template <typename Change> void update(Change change)
	{
		table_.update([&](ipc::ViewTable &table) {
			change(table);
			page_.views.write(table);
		});
	}

private:
	ipc::SystemPage &page_;
	Guarded<ipc::ViewTable> table_{};
};

/// How far the service has come since it listens.
enum class Stage {
	opening,
	identified /**< GPU and Rig are known: Hello can be answered */,
	ready /**< images are composed */,
	failed,
	stopping
};

struct Opened {
	Stage stage = Stage::opening;
	std::string problem;        ///< failed: one sentence
	bool fault = false;         ///< failed: after it has been ready
	ipc::Welcome welcome;       ///< from identified on
	std::string headsetProblem; ///< empty, or why there is no headset: there will be no session
	uint32_t headset = 0;       ///< counts the headsets that there have been
	/// When ready. Another pair takes their place when the GPU was lost: identified until it is there.
	std::shared_ptr<gpu::Device> device;
	std::shared_ptr<Compositor> compositor;
	/// From ready on: headset, cameras and tracker as `arift status` shows them.
	std::function<void(nlohmann::json &)> describeHeadset;
};

struct World {
	World(const Config &configuration, Clock &systemClock) : config(configuration), clock(systemClock) {}
	const Config &config;
	Clock &clock;
	ipc::SharedPage<ipc::SystemPage> system{"arift-system"};
	ipc::SharedPage<PoseRing> poses{"arift-poses"};
	Views views{*system};
	Applications applications;
	Guarded<Opened> opened{};
	std::unique_ptr<Trace> trace; ///< null: none is wanted
	Realtime realtime;
	Overrides overrides;
	Guarded<ApplicationTable> applicationSettings{config.applications};
	std::function<void()> requestStop;
	/// What a session wants of the gamepad's motors. It is felt only while it has the focus.
	std::function<void(uint32_t session, const ipc::Vibrate &)> vibrate;
	/// One line per client for `arift status`.
	std::function<void(nlohmann::json &)> describeClients;
	/// Calls it for every session with its application's name, without a lock.
	std::function<void(const std::function<void(const std::string &, Session &)> &)> forEachSession;

	/// What the user decided about the application of that name, with what holds for all where nothing was.
	ApplicationSettings settingsOf(const std::string &name);

	/// Waits until the service has come to `stage`, at most `limit` of real time. Throws Refused with the reason where it does not.
	Opened await(Stage stage, XrDuration limit);
	/// LOCAL and all that hangs on it begin where the head is now, for everybody. Thread-safe.
	void recenter();
};

} // namespace arift
