#include "runtime/openxr/session.h"
#include "runtime/openxr/ext/extx_overlay.h"
#include "runtime/openxr/ext/khr_vulkan_enable.h"
#include "runtime/openxr/opengl/gl_graphics.h"

namespace arift::openxr
{

Session::Granted Session::ask(Instance &instance, const Graphics *graphics, const XrSessionCreateInfoOverlayEXTX *overlay)
{
	ipc::CreateSession request;
	request.headless = graphics == nullptr;
	request.overlay = overlay != nullptr;
	request.placement = overlay ? overlay->sessionLayersPlacement : 0;
	request.hasDepth = instance.has(Extension::KHR_composition_layer_depth);
	if (graphics) {
		request.deviceUuid = graphics->deviceUuid();
		request.driverUuid = graphics->driverUuid();
	}
	const uint64_t newsBefore = instance.service.client().eventCount.load(std::memory_order_acquire);
	try {
		return {newsBefore, instance.service.ask<ipc::SessionCreated>(request, Service::openingLimit)};
	} catch (const Error &error) {
		// The service says so of a headset it cannot open; it is not among xrCreateSession's results.
		if (error.result != XR_ERROR_RUNTIME_UNAVAILABLE) throw;
		throw Error(XR_ERROR_INITIALIZATION_FAILED, "{}", error.what());
	}
}

Session::Session(Instance &owner, std::unique_ptr<Graphics> &&graphics, Granted granted)
	: instance(owner),
	  serviceDevices(owner.paths),
	  graphics_(std::move(graphics)),
	  sharing_(graphics_ ? agree(*graphics_, granted.answer.reply, granted.answer.fds[1]) : ImageSharing{}),
	  id_(granted.answer.reply.session),
	  life_(std::make_shared<SessionLife>(instance, id_, !graphics_, granted.newsBefore)),
	  frames_(std::make_unique<ipc::Socket>(std::move(granted.answer.fds[0])))
{
}

Session::Session(Instance &owner, std::unique_ptr<Graphics> graphics, const XrSessionCreateInfoOverlayEXTX *overlay)
	: Session(owner, std::move(graphics), ask(owner, graphics.get(), overlay))
{
	if (frames_->fd() < 0) throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service sent no frame channel");
	framesClosedInChildren_ = std::make_unique<ClosedInChildren>(frames_->fd());
	if (graphics_) submitter_ = std::make_unique<Submitter>(*frames_, [life = life_] { life->lose(); });
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
	instance.hasSession = false;
}

void Session::announce()
{
	instance.setSession(life_);
	life_->announce(handleOf(*this));
}

void Session::tellStops()
{
	untoldStops_.update([this](uint32_t &motors) {
		if (motors != 0 && frames_->send(ipc::Vibrate{.motors = motors, .duration = 0}, 0) != ipc::Transfer::timeout) motors = 0;
	});
}

void Session::vibrate(const ipc::Vibrate &message)
{
	tellStops(); // in their order
	const bool isDropped = frames_->send(message, 0) == ipc::Transfer::timeout;
	if (isDropped && message.duration == 0) untoldStops_.update([&](uint32_t &motors) { motors |= message.motors; });
}

void Session::tellService(bool running)
{
	instance.service.ask<ipc::Done>(ipc::SessionRunning{.session = id_, .running = running ? 1u : 0u});
}

void Session::begin(XrViewConfigurationType type)
{
	// A headless session has no views: XR_MND_headless lets the type be 0.
	if (graphics_ || int(type) != 0) requireStereo(type);
	{
		const auto life = life_->lock();
		if (life->facts.begun) throw Error(XR_ERROR_SESSION_RUNNING, "the session is running already");
		if (life->state != XR_SESSION_STATE_READY)
			throw Error(XR_ERROR_SESSION_NOT_READY, "the session's state is {}, not READY", int(life->state));
	}
	tellService(true);
	life_->change([&](Life &life) {
		life.facts.begun = true;
		life.facts.frameSynchronized = !graphics_; // without frames there is nothing to be in step with
		if (!graphics_) life.facts.visible = life.facts.focused = true;
		life.order = {};
	});
}

void Session::end()
{
	{
		const auto life = life_->lock();
		life->requireRunning();
		if (life->state != XR_SESSION_STATE_STOPPING)
			throw Error(XR_ERROR_SESSION_NOT_STOPPING, "the session's state is {}, not STOPPING", int(life->state));
	}
	drainSubmissions();
	tellService(false);
	life_->change([](Life &life) { life.facts.begun = life.facts.frameSynchronized = life.facts.visible = life.facts.focused = false; });
}

void Session::requestExit()
{
	life_->change([](Life &life) {
		life.requireRunning();
		life.facts.exitRequested = true;
	});
}

void Session::drainSubmissions()
{
	if (submitter_) submitter_->drain(second);
}

namespace
{

/// For the binding in the chain; null where there is none, which a headless session does without.
std::unique_ptr<Graphics> graphicsFor(Instance &instance, const XrSessionCreateInfo &info)
{
	if (instance.options.extensions.hasAnyOf({Extension::KHR_vulkan_enable, Extension::KHR_vulkan_enable2}))
		if (const auto *binding = findInChain<XrGraphicsBindingVulkanKHR>(info.next)) return makeVulkanGraphics(instance, *binding);
	std::unique_ptr<Graphics> graphics = makeGlGraphics(instance, info.next);
	if (!graphics && !instance.has(Extension::MND_headless))
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "no graphics binding of an enabled extension is in the chain of XrSessionCreateInfo");
	return graphics;
}

} // namespace

void createSession(Instance &instance, const XrSessionCreateInfo &info, XrSession &session)
{
	if (info.createFlags != 0) throw Error(XR_ERROR_VALIDATION_FAILURE, "createFlags is {:#x}, not 0", info.createFlags);
	instance.requireSystem(info.systemId);
	const XrSessionCreateInfoOverlayEXTX *overlay = overlayIn(instance, info.next);
	std::unique_ptr<Graphics> graphics = graphicsFor(instance, info);
	if (instance.hasSession.exchange(true)) throw Error(XR_ERROR_LIMIT_REACHED, "the instance has a session already");
	try {
		auto made = std::make_unique<Session>(instance, std::move(graphics), overlay);
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
void requestExitSession(Session &session) { session.requestExit(); }

} // namespace arift::openxr
