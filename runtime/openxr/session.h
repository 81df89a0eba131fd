// XrSession: its life cycle, its frames and what it shares with the service. OpenXR 1.1, chapters "Session" and "Rendering".
#pragma once
#include "runtime/openxr/debug_labels.h"
#include "runtime/openxr/image_sharing.h"
#include "runtime/openxr/input.h"
#include "runtime/openxr/instance.h"
#include "runtime/openxr/passthrough_use.h"
#include "runtime/openxr/service_devices.h"
#include "runtime/openxr/session_life.h"
#include "runtime/openxr/submitter.h"

namespace arift::openxr
{

class Swapchain;

/// What the application's newest frame cost it.
struct FrameCost {
	uint64_t frames = 0;        ///< measured so far
	XrDuration application = 0; ///< from xrWaitFrame's return to xrEndFrame, real time
};

class Session : public Object
{
public:
	/// `graphics` is null for a headless session, `overlay` for one that is none (XR_EXTX_overlay).
	Session(Instance &instance, std::unique_ptr<Graphics> graphics, const XrSessionCreateInfoOverlayEXTX *overlay);
	~Session() override;
	void requireAlive() const override
	{
		instance.requireAlive();
		if (life_->isLost()) throw Error(XR_ERROR_SESSION_LOST, "the session is lost");
	}

	uint32_t id() const { return id_; }
	/// Null for a headless session.
	Graphics *graphics() const { return graphics_.get(); }
	/// Of no meaning for a headless session.
	const ImageSharing &sharing() const { return sharing_; }
	/// Posts the first states: only when the session has its handle.
	void announce();

	// ---- life cycle
	void begin(XrViewConfigurationType type);
	void end();
	void requestExit();
	void takeNews() { life_->takeNews(); }
	/// An event of an extension or of the input, in the order of all.
	template <typename Event> void tell(const Event &event) { life_->tell(event); }
	XrSessionState state() const { return life_->state(); }
	bool isFocused() const { return state() == XR_SESSION_STATE_FOCUSED; }

	// ---- frames
	XrFrameState waitFrame();
	bool beginFrame();
	void endFrame(const XrFrameEndInfo &info);

	/// Asks the compositor to give up submissions up to `frame`.
	void relinquish(uint64_t frame);
	/// Nothing that names this session's images is left unsent.
	void drainSubmissions();

	/// Tells the gamepad's motors. Where the service does not keep up, what should begin does not; what should stop is kept for
	/// tellStops().
	void vibrate(const ipc::Vibrate &message);
	/// Tells the motors to stop of which the service has not been told so yet.
	void tellStops();

	FrameCost frameCost() const { return *frameCost_.lock(); }

	Instance &instance;
	Input input;
	ServiceDevices serviceDevices;
	DebugLabels labels;
	Guarded<PassthroughUse> passthrough;
	/// Whether frameCost() is kept.
	std::atomic<bool> measuresFrames{false};

private:
	/// The service's answer, and how much news it had written before it was asked.
	struct Granted {
		uint64_t newsBefore;
		ipc::Answer<ipc::SessionCreated> answer;
	};
	static Granted ask(Instance &instance, const Graphics *graphics, const XrSessionCreateInfoOverlayEXTX *overlay);
	/// From here on the service has a session that the destructor destroys.
	Session(Instance &instance, std::unique_ptr<Graphics> &&graphics, Granted granted);
	void tellService(bool running);
	ipc::FrameReady askForFrame();
	/// Throws XR_ERROR_SESSION_LOST when the service does not take it.
	template <typename Message> void sendFrame(const Message &message);
	[[noreturn]] void loseFrames(const char *why);

	std::unique_ptr<Graphics> graphics_;
	const ImageSharing sharing_;
	std::atomic<uint64_t> submitted_{0};           ///< frames handed to the submitter
	std::atomic<XrTime> waitedAt_{0}, begunAt_{0}; ///< real: xrWaitFrame's return for the newest frame, and for the one begun
	mutable Guarded<FrameCost> frameCost_;
	Guarded<uint32_t> untoldStops_{0u}; ///< as ipc::Vibrate::motors
	const uint32_t id_;
	const std::shared_ptr<SessionLife> life_;
	const std::unique_ptr<ipc::Socket> frames_;
	std::unique_ptr<ClosedInChildren> framesClosedInChildren_;
	std::unique_ptr<Submitter> submitter_; ///< null for a headless session
};

template <> struct HandleOf<Session> {
	using type = XrSession;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_SESSION;
};

void createSession(Instance &instance, const XrSessionCreateInfo &info, XrSession &session);
void destroySession(EvenIfLost<Session> session);
void beginSession(Session &session, const XrSessionBeginInfo &info);
void endSession(Session &session);
void requestExitSession(Session &session);
void waitFrame(Session &session, const XrFrameWaitInfo *info, XrFrameState &state);
XrResult beginFrame(Session &session, const XrFrameBeginInfo *info);
void endFrame(Session &session, const XrFrameEndInfo &info);

} // namespace arift::openxr
