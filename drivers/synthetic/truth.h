// Writes where the simulated head really is. For tests and measurements only: nothing at run time reads it.
#pragma once
#include "drivers/synthetic/motion.h"
#include "drivers/synthetic/scene.h"
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace arift::synthetic
{

/// CSV: first a line "# marker i x y z radius" for each marker, a header line, then time_ns,px,py,pz,qw,qx,qy,qz (head in world) for every
/// tick of the tracker. Only whole lines are ever in the file.
class TruthFile
{
public:
	TruthFile(const std::filesystem::path &file, std::span<const Marker> markers);
	~TruthFile();
	TruthFile(const TruthFile &) = delete;

	void write(XrTime time, const HeadState &head);

private:
	void flush();

	std::ofstream file_;
	std::string waiting_;
	uint32_t lines_ = 0;
};

} // namespace arift::synthetic
