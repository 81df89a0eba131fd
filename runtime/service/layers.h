// A decoded Submission -> what the compositor draws. Pure.
#pragma once
#include "runtime/service/presentation.h"

namespace arift
{

/// Null where nothing is to be shown: for a submission without layers, or with nothing but passthrough that is not shown.
std::shared_ptr<const FrameContent> contentOf(const ipc::Submission &submission, XrTime received, const Presentation &presentation = {});

} // namespace arift
