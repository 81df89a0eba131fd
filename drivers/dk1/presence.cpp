#include "drivers/dk1/presence.h"
#include <fstream>

namespace arift::dk1
{

namespace fs = std::filesystem;

namespace
{

/// A file's number in hexadecimal; nothing where there is no such file, for the device may go while it is looked at.
std::optional<unsigned> hexadecimalIn(const fs::path &file)
{
	unsigned number = 0;
	if (std::ifstream(file) >> std::hex >> number) return number;
	return std::nullopt;
}

} // namespace

std::optional<UsbTracker> findTracker(const fs::path &sysfs)
{
	std::optional<UsbTracker> found;
	std::error_code gone;
	for (fs::directory_iterator device(sysfs / "bus/usb/devices", gone), end; !gone && device != end; device.increment(gone)) {
		const fs::path &folder = device->path();
		if (hexadecimalIn(folder / "idVendor") != usbVendor || hexadecimalIn(folder / "idProduct") != usbProduct) continue;
		const std::string port = folder.filename();
		if (!found || port < found->port) found = UsbTracker{port};
	}
	return found;
}

} // namespace arift::dk1
