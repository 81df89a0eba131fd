#include "drivers/synthetic/truth.h"
#include "runtime/base/error.h"
#include <iterator>

namespace arift::synthetic
{

namespace
{

constexpr uint32_t linesPerWrite = 32;

} // namespace

TruthFile::TruthFile(const std::filesystem::path &file, std::span<const Marker> markers) : file_(file, std::ios::trunc)
{
	if (!file_) throw InputError("{}: cannot be written, named by synthetic.truth", file.string());
	for (size_t i = 0; i < markers.size(); i++) {
		const glm::dvec3 &p = markers[i].position;
		fmt::format_to(std::back_inserter(waiting_), "# marker {} {} {} {} {}\n", i, p.x, p.y, p.z, markers[i].radius);
	}
	waiting_ += "time_ns,px,py,pz,qw,qx,qy,qz\n";
	flush();
}

TruthFile::~TruthFile() { flush(); }

void TruthFile::write(XrTime time, const HeadState &head)
{
	const glm::dvec3 &p = head.position;
	const glm::dquat &q = head.orientation;
	fmt::format_to(std::back_inserter(waiting_), "{},{:.7f},{:.7f},{:.7f},{:.9f},{:.9f},{:.9f},{:.9f}\n", time, p.x, p.y, p.z, q.w, q.x,
				   q.y, q.z);
	if (++lines_ % linesPerWrite == 0) flush();
}

void TruthFile::flush()
{
	file_ << waiting_ << std::flush;
	waiting_.clear();
}

} // namespace arift::synthetic
