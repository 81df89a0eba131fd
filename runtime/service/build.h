// Which build this is: shown to people when library and service do not fit together.
#pragma once

namespace arift
{

constexpr const char *version = ARIFT_VERSION;
constexpr const char *buildId = "ARift " ARIFT_VERSION;

} // namespace arift
