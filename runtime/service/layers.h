// A decoded Submission -> what the compositor draws. Pure.
#pragma once
#include "runtime/compositor/frame_source.h"
#include "runtime/ipc/messages.h"

namespace arift
{

/// Null for a submission without layers: nothing is to be shown.
std::shared_ptr<const FrameContent> contentOf(const ipc::Submission &submission, XrTime received);

} // namespace arift
