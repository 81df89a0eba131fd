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
	ImageSharing sharing{sharingFor(graphics, granted, probe), {}};
	for (const int32_t format : granted.formats)
		if (format != 0 && std::ranges::find(graphics.formats(), int64_t(format)) != graphics.formats().end())
			sharing.formats.push_back(format);
	return sharing;
}

} // namespace arift::openxr
