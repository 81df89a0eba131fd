// A simulated world in which a picture tells whether it shows what the cameras see, on a clock that the machine can keep up with.
#pragma once
#include "tests/e2e/common/private_service.h"

namespace arift::e2e
{

constexpr double refreshPeriod = 1000 / 59.91; // ms of the system's clock

/// Configuration with the head at rest and two red discs, one before each camera, on a clock of that rate.
std::string markedWorld(double rate);
/// Red pixels in the left and in the right half of a panel picture: hundreds in each where both cameras are shown.
std::array<int, 2> redIn(const PanelPicture &picture);
void expectTheWorld(PrivateService &service, const std::string &when);

/// The rate at which composing takes `share` of a refresh while the applications that `start` starts run. Prints it.
double affordableRate(double share, const std::function<std::vector<ChildProcess>(PrivateService &)> &start);

/// Submissions of all applications that are there.
uint64_t submittedIn(const nlohmann::json &status);

} // namespace arift::e2e
