#include "runtime/openxr/session.h"
#include "runtime/openxr/ext/khr_vulkan_enable.h"

namespace arift::openxr
{

Session::Session(Instance &owner, std::unique_ptr<Graphics> graphics) : instance(owner), graphics_(std::move(graphics))
{
	ipc::CreateSession request;
	request.headless = graphics_ == nullptr;
	if (graphics_) {
		request.deviceUuid = graphics_->deviceUuid();
		request.driverUuid = graphics_->driverUuid();
	}
	auto answer = instance.service.ask<ipc::SessionCreated>(request, Service::openingLimit);
	id_ = answer.reply.session;
	if (answer.fdCount < 1) throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service sent no frame channel");
	frames_ = std::make_unique<ipc::Socket>(std::move(answer.fds[0]));
	framesClosedInChildren_ = std::make_unique<ClosedInChildren>(frames_->fd());
	if (graphics_) submitter_ = std::make_unique<Submitter>(*frames_);
}

Session::~Session()
{
	instance.setSession(nullptr);
	if (submitter_) submitter_.reset();
	try {
		if (!instance.service.isLost()) instance.service.ask<ipc::Done>(ipc::DestroySession{.session = id_});
	} catch (const std::exception &problem) {
		log::warning("xrDestroySession: {}", problem.what());
	}
	instance.events.dropEventsOf(handleOf(*this));
	instance.hasSession = false;
}

void Session::announce()
{
	instance.setSession(this);
	change([](SessionFacts &) {});
}

void Session::settleLocked(Life &life)
{
	life.state = settle(life.state, life.facts, [&](XrSessionState state) {
		XrEventDataSessionStateChanged event{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr, handleOf(*this), state, realTime()};
		if (!instance.service.isLost()) event.time = instance.service.now();
		instance.events.push(event);
	});
	state_.store(life.state, std::memory_order_relaxed);
}

template <typename Change> void Session::change(Change change)
{
	life_.update([&](Life &life) {
		change(life.facts);
		settleLocked(life);
	});
}

void Session::tellService(bool running)
{
	instance.service.ask<ipc::Done>(ipc::SessionRunning{.session = id_, .running = running ? 1u : 0u});
}

void Session::begin(XrViewConfigurationType type)
{
	// A headless session has no views: XR_MND_headless lets the type be anything.
	if (graphics_) requireStereo(type);
	{
		auto life = life_.lock();
		if (life->facts.begun) throw Error(XR_ERROR_SESSION_RUNNING, "the session is running already");
		if (life->state != XR_SESSION_STATE_READY)
			throw Error(XR_ERROR_SESSION_NOT_READY, "the session's state is {}, not READY", int(life->state));
	}
	tellService(true);
	life_.update([&](Life &life) {
		life.facts.begun = true;
		life.facts.frameSynchronized = !graphics_; // without frames there is nothing to be in step with
		if (!graphics_) life.facts.visible = life.facts.focused = true;
		life.order = {};
		settleLocked(life);
	});
}

void Session::end()
{
	{
		auto life = life_.lock();
		requireRunning(*life);
		if (life->state != XR_SESSION_STATE_STOPPING)
			throw Error(XR_ERROR_SESSION_NOT_STOPPING, "the session's state is {}, not STOPPING", int(life->state));
	}
	drainSubmissions();
	tellService(false);
	change([](SessionFacts &facts) { facts.begun = facts.frameSynchronized = facts.visible = facts.focused = false; });
}

void Session::requestExitByApplication()
{
	requireRunning(*life_.lock());
	requestExit();
}

void Session::requestExit()
{
	change([](SessionFacts &facts) { facts.exitRequested = true; });
}

void Session::setVisibility(bool visible, bool focused)
{
	if (!graphics_) return; // XR_MND_headless: visible and focused as long as it runs
	change([&](SessionFacts &facts) {
		facts.visible = visible;
		facts.focused = focused;
	});
}

void Session::lose()
{
	change([](SessionFacts &facts) { facts.lossPending = true; });
	lost_ = true;
}

void Session::tellRecentered(XrTime time, const XrPosef &poseInPrevious)
{
	const auto tell = [&](XrReferenceSpaceType type) {
		instance.events.push(XrEventDataReferenceSpaceChangePending{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING, nullptr,
																	handleOf(*this), type, time, XR_TRUE, poseInPrevious});
	};
	tell(XR_REFERENCE_SPACE_TYPE_LOCAL);
	if (instance.is1_1()) tell(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR);
}

void Session::requireRunning(const Life &life) const
{
	if (!life.facts.begun) throw Error(XR_ERROR_SESSION_NOT_RUNNING, "the session is not running: its state is {}", int(life.state));
}

void Session::drainSubmissions()
{
	if (submitter_) submitter_->drain(second);
}

void createSession(Instance &instance, const XrSessionCreateInfo &info, XrSession &session)
{
	if (info.createFlags != 0) throw Error(XR_ERROR_VALIDATION_FAILURE, "createFlags is {:#x}, not 0", info.createFlags);
	instance.requireSystem(info.systemId);
	const bool vulkan = instance.options.extensions.hasAnyOf({Extension::KHR_vulkan_enable, Extension::KHR_vulkan_enable2});
	const auto *binding = vulkan ? findInChain<XrGraphicsBindingVulkanKHR>(info.next) : nullptr;
	if (!binding && !instance.has(Extension::MND_headless))
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "no graphics binding of an enabled extension is in the chain of XrSessionCreateInfo");
	std::unique_ptr<Graphics> graphics;
	if (binding) graphics = makeVulkanGraphics(instance, *binding);
	if (instance.hasSession.exchange(true)) throw Error(XR_ERROR_LIMIT_REACHED, "the instance has a session already");
	try {
		auto made = std::make_unique<Session>(instance, std::move(graphics));
		Session &object = *made;
		session = handles.insert(std::move(made), &instance);
		object.announce();
	} catch (...) {
		instance.hasSession = false;
		throw;
	}
}

void destroySession(EvenIfLost<Session> session)
{
	if (session->instance.service.isOfAnotherProcess())
		handles.forget(*session);
	else
		handles.destroy(*session);
}

void beginSession(Session &session, const XrSessionBeginInfo &info) { session.begin(info.primaryViewConfigurationType); }
void endSession(Session &session) { session.end(); }
void requestExitSession(Session &session) { session.requestExitByApplication(); }

} // namespace arift::openxr
