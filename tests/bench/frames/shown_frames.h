// What a frame that is really shown costs, of service and application together.
#pragma once

namespace arift::bench
{

/// Prints figures for cameras from a ring and live ones, for an application that clears, and for layers more. Throws std::runtime_error
/// where frames are not shown or pictures of the panel contradict the service's count.
void shownFrames();

} // namespace arift::bench
