#include "runtime/service/places.h"
#include <cstdlib>

namespace arift
{
namespace
{

std::filesystem::path placeIn(const char *variable, const char *usual)
{
	const char *named = std::getenv(variable);
	return named && *named ? named : usual;
}

} // namespace

std::filesystem::path sysfs() { return placeIn("ARIFT_SYSFS", "/sys"); }

InputPlaces inputPlaces() { return {placeIn("ARIFT_DEV", "/dev") / "input", sysfs()}; }

} // namespace arift
