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
	bool passthroughRuns = false; ///< else no place is shown
	std::array<PassthroughPlace, ipc::maxPassthroughLayers> passthrough;
};

/// The session's passthrough layer of that number above all layers of `content`. One that hides whatever is below is no layer but makes the
/// content one that is blended over the world.
void addPassthrough(FrameContent &content, const Presentation &presentation, uint32_t number);
/// Last, when all layers are there.
void force(FrameContent &content, const ForcedPassthrough &forced);

/// What a message says of a style, without its map.
PassthroughStyle styleOf(const ipc::StylePassthrough &message);

} // namespace arift
