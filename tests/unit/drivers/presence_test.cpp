// Which devices the kernel lists count as a DK1.
#include "drivers/dk1/presence.h"
#include "tests/common/temporary_folder.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

struct Presence : testing::Test {
	test::TemporaryFolder sysfs;
	void plugIn(const std::string &port, const std::string &vendor, const std::string &product)
	{
		const std::string folder = "bus/usb/devices/" + port;
		std::filesystem::create_directories(sysfs.path() / folder);
		sysfs.write(folder + "/idVendor", vendor + "\n");
		sysfs.write(folder + "/idProduct", product + "\n");
	}
};

TEST_F(Presence, ATrackerIsFoundByVendorAndProduct)
{
	EXPECT_FALSE(dk1::findTracker(sysfs.path())) << "no USB at all";
	plugIn("usb1", "1d6b", "0002");
	plugIn("1-1", "2833", "0021");                                                 // a DK2
	std::filesystem::create_directories(sysfs.path() / "bus/usb/devices/1-1:1.0"); // an interface: it has no such files
	EXPECT_FALSE(dk1::findTracker(sysfs.path()));
	plugIn("2-1.4", "2833", "0001");
	EXPECT_EQ(dk1::findTracker(sysfs.path()), (dk1::UsbTracker{"2-1.4"}));
	plugIn("1-2", "2833", "0001");
	EXPECT_EQ(dk1::findTracker(sysfs.path()), (dk1::UsbTracker{"1-2"})) << "of two always the same one";
	std::filesystem::remove_all(sysfs.path() / "bus/usb/devices/1-2");
	std::filesystem::remove_all(sysfs.path() / "bus/usb/devices/2-1.4");
	EXPECT_FALSE(dk1::findTracker(sysfs.path()));
}

} // namespace
} // namespace arift
