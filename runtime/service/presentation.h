// What becomes of an application's submissions on their way to the compositor: passthrough layers get the style they have now, and the
// user's will is done. Pure.
#pragma once
#include "runtime/compositor/frame_source.h"
#include "runtime/service/application_settings.h"

namespace arift
{

/// A passthrough layer as its application has it.
struct PassthroughPlace {
	bool shown = false;
	PassthroughStyle style;
};

/// Of one session.
struct Presentation {
	ForcedPassthrough forced;
	bool overlay = false;         ///< others' layers are below its own
	bool passthroughRuns = false; ///< else no place is shown
	std::array<PassthroughPlace, ipc::maxPassthroughLayers> passthrough;
};

/// The session's passthrough layer of that number above all layers of `content`. One that hides whatever is below takes it away, other
/// applications' layers with it; with nothing to be changed about the world it is no layer itself. The specification lets one layer be
/// submitted as often as there is room, and each is drawn over the whole panel: those that follow each other become one where that looks
/// the same, and more than a session can have of them are not drawn in one submission.
void addPassthrough(FrameContent &content, const Presentation &presentation, uint32_t number);
/// Last, when all layers are there.
void force(FrameContent &content, const Presentation &presentation);

/// What a message says of a style, without its map.
PassthroughStyle styleOf(const ipc::StylePassthrough &message);

} // namespace arift
