// XrSession: its life cycle, its frames and what it shares with the service. OpenXR 1.1, chapters "Session" and "Rendering".
#pragma once
#include "runtime/openxr/frame_order.h"
#include "runtime/openxr/graphics.h"
#include "runtime/openxr/instance.h"
#include "runtime/openxr/session_state.h"
#include "runtime/openxr/submitter.h"

namespace arift::openxr
{

class Swapchain;

class Session : public Object
{
public:
	/// `graphics` is null for a headless session.
	Session(Instance &instance, std::unique_ptr<Graphics> graphics);
	~Session() override;
	void requireAlive() const override
	{
		instance.requireAlive();
		if (lost_.load(std::memory_order_relaxed)) throw Error(XR_ERROR_SESSION_LOST, "the session is lost");
	}

	uint32_t id() const { return id_; }
	/// Null for a headless session.
	Graphics *graphics() const { return graphics_.get(); }
	/// Posts the first states: only when the session has its handle.
	void announce();

	// ---- life cycle; news from the service may come at any time
	void begin(XrViewConfigurationType type);
	void end();
	/// By the application: throws XR_ERROR_SESSION_NOT_RUNNING.
	void requestExitByApplication();
	void requestExit();
	void setVisibility(bool visible, bool focused);
	void tellRecentered(XrTime time, const XrPosef &poseInPrevious);
	void lose();
	XrSessionState state() const { return state_.load(std::memory_order_relaxed); }
	bool isFocused() const { return state() == XR_SESSION_STATE_FOCUSED; }

	// ---- frames
	XrFrameState waitFrame();
	bool beginFrame();
	void endFrame(const XrFrameEndInfo &info);

	/// Asks the compositor to give up submissions up to `frame`.
	void relinquish(uint64_t frame);
	/// Nothing that names this session's images is left unsent.
	void drainSubmissions();

	Instance &instance;
	ActionState actions;

private:
	struct Life {
		XrSessionState state = XR_SESSION_STATE_UNKNOWN;
		SessionFacts facts;
		FrameOrder order;
	};

	/// Changes the facts and posts the states that follow from them.
	template <typename Change> void change(Change change);
	void settleLocked(Life &life);
	void tellService(bool running);
	void requireRunning(const Life &life) const;
	ipc::FrameReady askForFrame();

	std::unique_ptr<Graphics> graphics_;
	std::atomic<uint64_t> submitted_{0}; ///< frames handed to the submitter
	Guarded<Life> life_;
	std::atomic<XrSessionState> state_{XR_SESSION_STATE_UNKNOWN};
	std::atomic<bool> lost_{false};
	uint32_t id_ = 0;
	std::unique_ptr<ipc::Socket> frames_;
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
