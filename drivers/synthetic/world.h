// What the simulated devices have in common: when the world began and how the head moves in it.
#pragma once
#include "drivers/synthetic/motion.h"

namespace arift::synthetic
{

struct World {
	XrTime start = 0; ///< motion's time zero
	std::shared_ptr<const HeadMotion> motion;

	HeadState head(XrTime time) const { return motion->at(inSeconds(time - start)); }
};

} // namespace arift::synthetic
