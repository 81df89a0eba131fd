// Where the real recordings and calibrations lie, on machines that have them. Tests that want them skip with a line where they are not.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace arift::test
{

/// `part` of the folder data in $ARIFT_SHARED, else of the one in `shared` beside the checkout; nothing where it is not there.
std::optional<std::filesystem::path> sharedData(const std::string &part);

/// What a test says when it skips for want of them.
constexpr const char *noSharedData = "no real data: neither $ARIFT_SHARED nor ../shared beside the checkout has it";

} // namespace arift::test
