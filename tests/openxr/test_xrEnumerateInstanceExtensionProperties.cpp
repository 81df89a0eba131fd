// The extensions offered: each can be enabled, and brings its functions with it alone.
#include "tests/openxr/headless_session.h"
#include <set>

namespace arift
{
namespace
{

std::vector<XrExtensionProperties> offered()
{
	const Library library;
	PFN_xrVoidFunction function = nullptr;
	EXPECT_EQ(library.getInstanceProcAddr(XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties", &function), XR_SUCCESS);
	const auto enumerate = reinterpret_cast<PFN_xrEnumerateInstanceExtensionProperties>(function);
	uint32_t count = 0;
	EXPECT_EQ(enumerate(nullptr, 0, &count, nullptr), XR_SUCCESS);
	std::vector<XrExtensionProperties> properties(count, {XR_TYPE_EXTENSION_PROPERTIES});
	EXPECT_EQ(enumerate(nullptr, count, &count, properties.data()), XR_SUCCESS);
	return properties;
}

TEST(xrEnumerateInstanceExtensionProperties, WhatIsOfferedCanBeEnabledByEveryVersion)
{
	const FakeService service;
	std::set<std::string> names;
	std::vector<const char *> all;
	const std::vector<XrExtensionProperties> properties = offered();
	for (const XrExtensionProperties &extension : properties) {
		EXPECT_TRUE(names.insert(extension.extensionName).second) << extension.extensionName << " is offered twice";
		EXPECT_GT(extension.extensionVersion, 0u);
		all.push_back(extension.extensionName);
	}
	for (const XrVersion version : {XrVersion(XR_API_VERSION_1_0), XrVersion(XR_API_VERSION_1_1)})
		EXPECT_EQ(Application(all, version).created, XR_SUCCESS);
	for (const char *name :
		 {"XR_KHR_maintenance1", "XR_EXT_uuid", "XR_EXT_palm_pose", "XR_EXT_hand_interaction", "XR_BD_controller_interaction"})
		EXPECT_TRUE(names.contains(name)) << name;
}

TEST(xrGetInstanceProcAddr, AnExtensionsFunctionsComeWithItAlone)
{
	const FakeService service;
	const std::pair<const char *, const char *> functions[] = {
		{"XR_KHR_visibility_mask", "xrGetVisibilityMaskKHR"},
		{"XR_KHR_extended_struct_name_lengths", "xrStructureTypeToString2KHR"},
		{"XR_EXT_hand_tracking", "xrCreateHandTrackerEXT"},
		{"XR_EXT_performance_settings", "xrPerfSettingsSetPerformanceLevelEXT"},
		{"XR_EXT_conformance_automation", "xrSetInputDeviceActiveEXT"},
		{"XR_FB_color_space", "xrSetColorSpaceFB"},
		{"XR_FB_display_refresh_rate", "xrGetDisplayRefreshRateFB"},
		{"XR_META_performance_metrics", "xrQueryPerformanceMetricsCounterMETA"},
		{"XR_MSFT_controller_model", "xrGetControllerModelKeyMSFT"},
	};
	const Application without;
	for (const auto &[extension, function] : functions) {
		const Application with({extension});
		EXPECT_TRUE(with.get<PFN_xrVoidFunction>(function)) << function;
		EXPECT_FALSE(without.get<PFN_xrVoidFunction>(function)) << function;
	}
}

TEST(xrStructureTypeToString2KHR, NamesWhatTheInstalledHeadersLack)
{
	const FakeService service;
	const Application application({"XR_KHR_extended_struct_name_lengths"});
	char name[XR_MAX_STRUCTURE_NAME_SIZE_EXTENDED_KHR];
	const auto toString = application.get<PFN_xrStructureTypeToString2KHR>("xrStructureTypeToString2KHR");
	ASSERT_EQ(toString(application.instance, XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META, name), XR_SUCCESS);
	EXPECT_STREQ(name, "XR_TYPE_SYSTEM_HEADSET_ID_PROPERTIES_META");
	ASSERT_EQ(toString(application.instance, XrStructureType(77), name), XR_SUCCESS);
	EXPECT_STREQ(name, "XR_UNKNOWN_STRUCTURE_TYPE_77");
}

} // namespace
} // namespace arift
