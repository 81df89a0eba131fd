// xrGetSystemProperties with the structures that extensions add.
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"
#include <cstring>

namespace arift
{
namespace
{

/// All structures in one chain, each with a value that no runtime gives.
struct Properties {
	XrSystemHeadsetIdPropertiesMETA headsetId{XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META, nullptr, {}};
	XrSystemColorSpacePropertiesFB colorSpace{XR_TYPE_SYSTEM_COLOR_SPACE_PROPERTIES_FB, &headsetId, XR_COLOR_SPACE_MAX_ENUM_FB};
	XrSystemUserPresencePropertiesEXT presence{XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT, &colorSpace, 7};
	XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT, &presence, 7};
	XrBaseOutStructure unknown{XrStructureType(1999999999), reinterpret_cast<XrBaseOutStructure *>(&hands)};
	XrSystemProperties system{XR_TYPE_SYSTEM_PROPERTIES, &unknown};

	explicit Properties(const Application &application)
	{
		EXPECT_EQ(application.get<PFN_xrGetSystemProperties>("xrGetSystemProperties")(application.instance, application.system(), &system),
				  XR_SUCCESS);
	}
	bool hasHeadsetId() const
	{
		const XrUuid none{};
		return std::memcmp(&headsetId.id, &none, sizeof(none)) != 0;
	}
};

TEST(xrGetSystemProperties, FillsWhatEnabledExtensionsAdd)
{
	const FakeService service;
	const Application application({"XR_META_headset_id", "XR_FB_color_space", "XR_EXT_user_presence", "XR_EXT_hand_tracking"});
	const Properties properties(application);
	EXPECT_EQ(properties.hands.supportsHandTracking, XrBool32(XR_FALSE));
	EXPECT_EQ(properties.presence.supportsUserPresence, XrBool32(XR_FALSE));
	EXPECT_EQ(properties.colorSpace.colorSpace, XR_COLOR_SPACE_REC709_FB);
	ASSERT_TRUE(properties.hasHeadsetId());
	const Properties again(application);
	EXPECT_EQ(std::memcmp(&properties.headsetId.id, &again.headsetId.id, sizeof(XrUuid)), 0);
}

TEST(xrGetSystemProperties, LeavesWhatIsNotEnabled)
{
	const FakeService service;
	const Application application;
	const Properties properties(application);
	EXPECT_EQ(properties.hands.supportsHandTracking, 7u);
	EXPECT_EQ(properties.presence.supportsUserPresence, 7u);
	EXPECT_EQ(properties.colorSpace.colorSpace, XR_COLOR_SPACE_MAX_ENUM_FB);
	EXPECT_FALSE(properties.hasHeadsetId());
}

} // namespace
} // namespace arift
