// Whether a DK1's tracker is plugged in, as the kernel lists it: nothing is opened.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace arift::dk1
{

/// facts of the device: vendor Oculus VR, product "Tracker DK".
constexpr unsigned usbVendor = 0x2833, usbProduct = 0x0001;

struct UsbTracker {
	std::string port; ///< bus and port as the kernel names them: "1-2.3"
	bool operator==(const UsbTracker &) const = default;
};

/// The first by port of those below `sysfs` (the kernel's: /sys); nothing where there is none, or no USB at all.
std::optional<UsbTracker> findTracker(const std::filesystem::path &sysfs);

} // namespace arift::dk1
