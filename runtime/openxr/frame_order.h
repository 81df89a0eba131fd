// The order of xrWaitFrame, xrBeginFrame and xrEndFrame as arithmetic. OpenXR 1.1, "Frame Synchronization". No clock, no lock.
#pragma once
#include "runtime/openxr/error.h"

namespace arift::openxr
{

class FrameOrder
{
public:
	/// A further xrWaitFrame must block until the frame before has been begun.
	bool mayWait() const { return !waiting_ && !waited_; }
	void startWait() { waiting_ = true; }
	/// `ready`: the wait ended with a frame, not with a failure.
	void finishWait(bool ready)
	{
		waiting_ = false;
		waited_ = ready;
	}
	/// Says whether a begun frame was discarded by beginning the next one.
	bool begin()
	{
		if (!waited_) throw Error(XR_ERROR_CALL_ORDER_INVALID, "xrBeginFrame without a frame that xrWaitFrame returned");
		waited_ = false;
		const bool discarded = begun_;
		begun_ = true;
		return discarded;
	}
	void requireBegun() const
	{
		if (!begun_) throw Error(XR_ERROR_CALL_ORDER_INVALID, "xrEndFrame without a frame that was begun");
	}
	void end() { begun_ = false; }

private:
	bool waiting_ = false;
	bool waited_ = false;
	bool begun_ = false;
};

} // namespace arift::openxr
