#include "runtime/openxr/image_sharing.h"
#include "runtime/base/log.h"
#include <algorithm>

namespace arift::openxr
{
namespace
{

ipc::Sharing sharingFor(const Graphics &graphics, const ipc::SessionCreated &granted, UniqueFd &probe)
{
	if (granted.sharing == ipc::Sharing::copies) {
		log::warning("images are copied through the CPU's memory: they cannot be shared with arift-service, whose log says why");
		return ipc::Sharing::copies;
	}
	if (granted.probeSize == 0) return ipc::Sharing::memory;
	if (probe && graphics.sees({probe, granted.probeSize, granted.probeTypeIndex, granted.probePattern})) return ipc::Sharing::memory;
	log::warning("images are copied through the CPU's memory: this process' driver does not see what arift-service's wrote, though both "
				 "have the same UUID");
	return ipc::Sharing::copies;
}

} // namespace

ImageSharing agree(const Graphics &graphics, const ipc::SessionCreated &granted, UniqueFd &probe)
{
	const auto behindLast = std::ranges::find(granted.formats, 0);
	return {sharingFor(graphics, granted, probe), graphics.formatsOf({granted.formats.begin(), behindLast})};
}

} // namespace arift::openxr
