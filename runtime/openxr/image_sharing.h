// What a session and the service have agreed on: how its images come to the service, and which formats they may have.
#pragma once
#include "runtime/openxr/graphics.h"

namespace arift::openxr
{

struct ImageSharing {
	ipc::Sharing how = ipc::Sharing::memory;
	std::vector<int64_t> formats; ///< as the application's API numbers them, the runtime's favourite first
};

/// `probe`: the descriptor that came with the answer, or none.
ImageSharing agree(const Graphics &graphics, const ipc::SessionCreated &granted, UniqueFd &probe);

} // namespace arift::openxr
