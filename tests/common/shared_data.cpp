#include "tests/common/shared_data.h"
#include <cstdlib>

namespace arift::test
{

std::optional<std::filesystem::path> sharedData(const std::string &part)
{
	const char *named = std::getenv("ARIFT_SHARED");
	const std::filesystem::path root = named ? std::filesystem::path(named) : std::filesystem::path(ARIFT_SOURCE_DIR) / ".." / "shared";
	const std::filesystem::path data = root / "data" / part;
	return std::filesystem::exists(data) ? std::optional(std::filesystem::weakly_canonical(data)) : std::nullopt;
}

} // namespace arift::test
