// An application as the compositor sees it: somebody to wake, and the newest finished thing it wants shown.
#pragma once
#include "runtime/compositor/panel_inputs.h"
#include <cstdint>
#include <memory>

namespace arift
{

/// What an application wants shown, from one submission: immutable.
struct FrameContent {
	uint64_t frame = 0;  ///< the submission's number
	XrTime received = 0; ///< when the finished submission came
	XrEnvironmentBlendMode blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	std::vector<PanelLayer> layers; ///< bottom first
	/// The world lies below its layers, an overlay's in front of whatever others show below: XR_FB_passthrough's layers are the cameras'
	/// image.
	bool hidesOthers = false;
};

/// Called by the compositor thread alone, while it holds the clock. No call may block.
class FrameSource
{
public:
	virtual ~FrameSource() = default;
	/// Of the session, for people.
	virtual uint32_t number() const { return 0; }
	/// The lowest is drawn first; those with the same by distance (Surroundings::nearerOver), or in the order in which they were added.
	/// More than 0: an overlay, which leaves the world as it is unless it hides others.
	virtual uint64_t order() const { return 0; }
	/// A refresh an application can still draw for, when it is woken now.
	struct Opportunity {
		XrTime displayTime = 0; ///< of the middle line
		XrDuration period = 0;
		XrTime latch = 0; ///< what has not arrived by then is shown a refresh later
	};
	virtual void wake(const Opportunity &opportunity) = 0;
	/// The newest finished content; null: nothing is to be shown.
	virtual std::shared_ptr<const FrameContent> content() = 0;
	/// The panel image with this content is finished: nothing older is read any more. Null as in content().
	virtual void shown(const std::shared_ptr<const FrameContent> &content) = 0;
	/// The panel image with this content is seen at `display`, as well as the target knows.
	virtual void displayed(const FrameContent &, XrTime /*display*/) {}
};

} // namespace arift
