// The library as the loader opens it, against a service that speaks the wire's protocol: instance, system, entry points, loss.
#include "runtime/ipc/request.h"
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"
#include <link.h>
#include <sys/wait.h>

namespace arift
{
namespace
{

TEST(Instance, VersionsAndWhatTheServiceHears)
{
	FakeService service;
	{
		Application application({"XR_MND_headless"}, XR_MAKE_VERSION(1, 0, 20));
		ASSERT_EQ(application.created, XR_SUCCESS);
		EXPECT_EQ(XR_VERSION_MINOR(application.library.version), 1);
		const ipc::Hello hello = service.record().hellos.at(0);
		EXPECT_EQ(ipc::textOf(hello.applicationName), "test application");
		EXPECT_EQ(ipc::textOf(hello.engineName), "test engine");
		EXPECT_EQ(hello.pid, uint32_t(::getpid()));
		EXPECT_EQ(hello.role, ipc::Role::application);
	}
	EXPECT_EQ(Application({}, XR_MAKE_VERSION(1, 1, 61)).created, XR_SUCCESS);
	EXPECT_EQ(Application({}, XR_MAKE_VERSION(1, 2, 0)).created, XR_ERROR_API_VERSION_UNSUPPORTED);
	EXPECT_EQ(Application({}, XR_MAKE_VERSION(2, 0, 0)).created, XR_ERROR_API_VERSION_UNSUPPORTED);
	EXPECT_EQ(Application({}, 0).created, XR_ERROR_API_VERSION_UNSUPPORTED);
	EXPECT_EQ(Application({"XR_EXT_nonsense"}).created, XR_ERROR_EXTENSION_NOT_PRESENT);
}

TEST(Instance, FunctionsByVersionAndExtension)
{
	FakeService service;
	const Application old({"XR_KHR_vulkan_enable2"}, XR_MAKE_VERSION(1, 0, 0)), current;
	EXPECT_TRUE(old.get<PFN_xrVoidFunction>("xrEndFrame"));
	EXPECT_TRUE(old.get<PFN_xrVoidFunction>("xrCreateVulkanInstanceKHR"));
	EXPECT_FALSE(old.get<PFN_xrVoidFunction>("xrGetVulkanGraphicsDeviceKHR"));
	EXPECT_FALSE(current.get<PFN_xrVoidFunction>("xrCreateVulkanInstanceKHR"));
	EXPECT_FALSE(current.get<PFN_xrVoidFunction>("xrConvertTimespecTimeToTimeKHR"));
	PFN_xrVoidFunction function = nullptr;
	const auto find = current.library.getInstanceProcAddr;
	EXPECT_EQ(find(current.instance, "xrNonsense", &function), XR_ERROR_FUNCTION_UNSUPPORTED);
	EXPECT_EQ(find(XR_NULL_HANDLE, "xrCreateInstance", &function), XR_SUCCESS);
	EXPECT_EQ(find(XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties", &function), XR_SUCCESS);
	EXPECT_EQ(find(XR_NULL_HANDLE, "xrEndFrame", &function), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(find(reinterpret_cast<XrInstance>(uint64_t(77)), "xrEndFrame", &function), XR_ERROR_HANDLE_INVALID);
}

TEST(Instance, SystemAsTheServiceDescribesIt)
{
	FakeService service;
	const Application application;
	const XrSystemId system = application.system();
	XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
	ASSERT_EQ(application.get<PFN_xrGetSystemProperties>("xrGetSystemProperties")(application.instance, system, &properties), XR_SUCCESS);
	EXPECT_STREQ(properties.systemName, "Fake headset");
	EXPECT_EQ(properties.graphicsProperties.maxLayerCount, ipc::maxLayers);
	EXPECT_TRUE(properties.trackingProperties.orientationTracking);
	EXPECT_EQ(application.get<PFN_xrGetSystemProperties>("xrGetSystemProperties")(application.instance, system + 1, &properties),
			  XR_ERROR_SYSTEM_INVALID);
	const XrSystemGetInfo handheld{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HANDHELD_DISPLAY};
	XrSystemId other = 0;
	EXPECT_EQ(application.get<PFN_xrGetSystem>("xrGetSystem")(application.instance, &handheld, &other), XR_ERROR_FORM_FACTOR_UNSUPPORTED);
	std::vector<XrViewConfigurationView> views(2, {XR_TYPE_VIEW_CONFIGURATION_VIEW});
	uint32_t count = 0;
	ASSERT_EQ(application.get<PFN_xrEnumerateViewConfigurationViews>("xrEnumerateViewConfigurationViews")(
				  application.instance, system, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 2, &count, views.data()),
			  XR_SUCCESS);
	EXPECT_EQ(views[1].recommendedImageRectHeight, 1000u);
	std::vector<XrEnvironmentBlendMode> modes(4);
	ASSERT_EQ(application.get<PFN_xrEnumerateEnvironmentBlendModes>("xrEnumerateEnvironmentBlendModes")(
				  application.instance, system, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 4, &count, modes.data()),
			  XR_SUCCESS);
	EXPECT_EQ(count, 2u);
	EXPECT_EQ(modes[1], XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
	char text[XR_MAX_RESULT_STRING_SIZE];
	const auto resultToString = application.get<PFN_xrResultToString>("xrResultToString");
	ASSERT_EQ(resultToString(application.instance, XR_ERROR_PATH_INVALID, text), XR_SUCCESS);
	EXPECT_STREQ(text, "XR_ERROR_PATH_INVALID");
	ASSERT_EQ(resultToString(application.instance, XrResult(-123456), text), XR_SUCCESS);
	EXPECT_STREQ(text, "XR_UNKNOWN_FAILURE_-123456");
	ASSERT_EQ(application.get<PFN_xrStructureTypeToString>("xrStructureTypeToString")(application.instance, XR_TYPE_SPACE_LOCATIONS, text),
			  XR_SUCCESS);
	EXPECT_STREQ(text, "XR_TYPE_SPACE_LOCATIONS");
}

TEST(Instance, WithoutAServiceTheReasonIsTold)
{
	{
		FakeService service; // its folder is gone when it is
	}
	EXPECT_EQ(Application().created, XR_ERROR_RUNTIME_UNAVAILABLE);
}

/// A dying service takes connections until the kernel has closed its sockets.
TEST(Instance, WhoFindsADyingServiceFindsItsSuccessor)
{
	FakeService service;
	service.hangUpOnHello(2);
	EXPECT_EQ(Application().created, XR_SUCCESS);
}

/// The service's own word for it is not among xrCreateSession's results.
TEST(Instance, AHeadsetThatCannotBeOpenedMakesNoSession)
{
	FakeService service;
	const Application application({"XR_MND_headless"});
	service.refuseSessions(XR_ERROR_RUNTIME_UNAVAILABLE);
	const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, application.system()};
	XrSession session = XR_NULL_HANDLE;
	const auto create = application.get<PFN_xrCreateSession>("xrCreateSession");
	EXPECT_EQ(create(application.instance, &info, &session), XR_ERROR_INITIALIZATION_FAILED);
	service.refuseSessions(XR_ERROR_GRAPHICS_DEVICE_INVALID);
	EXPECT_EQ(create(application.instance, &info, &session), XR_ERROR_GRAPHICS_DEVICE_INVALID);
	service.refuseSessions(XR_SUCCESS);
	EXPECT_EQ(create(application.instance, &info, &session), XR_SUCCESS);
}

TEST(Instance, ASilentServiceIsLost)
{
	FakeService service;
	const Application application({"XR_MND_headless"});
	const XrSession session = application.session();
	application.states();
	service.stopHeart();
	service.system().heartbeat = realTime() - 3 * second;
	XrEventDataBuffer event;
	const XrTime noticed = realTime();
	XrResult result = XR_EVENT_UNAVAILABLE;
	while ((result = application.poll(event)) == XR_EVENT_UNAVAILABLE) ASSERT_LT(realTime() - noticed, 10 * second);
	ASSERT_EQ(result, XR_SUCCESS);
	EXPECT_GE(realTime() - noticed, 250 * millisecond) << "it is given the time to beat once more";
	EXPECT_EQ(event.type, XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED);
	EXPECT_EQ(reinterpret_cast<XrEventDataSessionStateChanged &>(event).state, XR_SESSION_STATE_LOSS_PENDING);
	ASSERT_EQ(application.poll(event), XR_SUCCESS);
	EXPECT_EQ(event.type, XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING);
	EXPECT_EQ(application.poll(event), XR_ERROR_INSTANCE_LOST);
	EXPECT_EQ(application.begin(session), XR_ERROR_INSTANCE_LOST);
	EXPECT_EQ(application.get<PFN_xrDestroySession>("xrDestroySession")(session), XR_SUCCESS);
}

TEST(Instance, AfterTheWholeMachineStoodStillNothingIsLost)
{
	FakeService service;
	const Application application({"XR_MND_headless"});
	application.session();
	application.states();
	service.stopHeart();
	service.system().heartbeat = realTime() - 3 * second; // as the first to wake finds it
	XrEventDataBuffer event;
	EXPECT_EQ(application.poll(event), XR_EVENT_UNAVAILABLE);
	service.system().heartbeat = realTime(); // the service has woken as well
	EXPECT_EQ(application.poll(event), XR_EVENT_UNAVAILABLE);
	std::this_thread::sleep_for(std::chrono::milliseconds(350)); // longer than the second look is away
	EXPECT_EQ(application.poll(event), XR_EVENT_UNAVAILABLE);
	service.system().heartbeat = realTime() - 3 * second; // another time is another first look
	EXPECT_EQ(application.poll(event), XR_EVENT_UNAVAILABLE);
}

TEST(Instance, AServiceThatDiesEndsAWaitAtOnce)
{
	FakeService service;
	const Application application({"XR_MND_headless"});
	const XrSession session = application.session();
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	service.hangUp();
	XrFrameState state;
	const XrTime before = realTime();
	EXPECT_EQ(application.wait(session, state), XR_ERROR_INSTANCE_LOST);
	EXPECT_LT(realTime() - before, second);
	EXPECT_EQ(application.wait(session, state), XR_ERROR_INSTANCE_LOST);
}

TEST(Instance, AForkedChildIsNotItsParent)
{
	FakeService service;
	const Application application({"XR_MND_headless"});
	const XrSession session = application.session();
	const pid_t child = ::fork();
	if (child == 0) {
		const bool lost = application.begin(session) == XR_ERROR_INSTANCE_LOST;
		const bool destroyed = application.get<PFN_xrDestroyInstance>("xrDestroyInstance")(application.instance) == XR_SUCCESS;
		::_exit(lost && destroyed ? 0 : 1);
	}
	int status = -1;
	ASSERT_EQ(::waitpid(child, &status, 0), child);
	EXPECT_EQ(status, 0);
	EXPECT_EQ(application.begin(session), XR_SUCCESS) << "the parent's connection is untouched";
}

/// Shared objects of this process whose path contains `part`.
int loadedObjects(const char *part)
{
	struct Search {
		const char *part;
		int found = 0;
	} search{part};
	::dl_iterate_phdr(
		[](dl_phdr_info *info, size_t, void *data) {
			auto &wanted = *static_cast<Search *>(data);
			wanted.found += std::string_view(info->dlpi_name).find(wanted.part) != std::string_view::npos;
			return 0;
		},
		&search);
	return search.found;
}

TEST(Instance, TwoHundredTimesAndUnloaded)
{
	FakeService service;
	for (int i = 0; i < 200; ++i) {
		const Application application({"XR_MND_headless"});
		ASSERT_EQ(application.created, XR_SUCCESS) << i;
		application.session();
	}
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
	EXPECT_EQ(loadedObjects("openxr_arift"), 0) << "something keeps the library in the process";
#endif
	EXPECT_EQ(service.waitFor([](const auto &record) { return record.sessionsDestroyed == 200; }).sessionsCreated, 200u);
}

} // namespace
} // namespace arift
