#include "runtime/motion/spaces.h"

namespace arift
{

ipc::ViewTable recentred(const ipc::ViewTable &views, const HeadMotion &head)
{
	ipc::ViewTable table = views;
	table.localInOrigin = NeckModel{views.pivotInHead}.head(headingOf(head.at.headInOrigin));
	table.floorBelowLocal += table.localInOrigin.position.y - views.localInOrigin.position.y;
	++table.recenterCount;
	return table;
}

} // namespace arift
