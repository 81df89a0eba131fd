// XR_EXTX_overlay: what makes a session an overlay, and what it hears of the main one.
#include "tests/openxr/headless_session.h"

namespace arift
{
namespace
{

struct Overlay : testing::Test {
	XrResult create(const Application &application, const void *next, XrSession &made) const
	{
		const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, next, 0, application.system()};
		return application.get<PFN_xrCreateSession>("xrCreateSession")(application.instance, &info, &made);
	}
	FakeService service;
	XrSession session = XR_NULL_HANDLE;
	XrSessionCreateInfoOverlayEXTX overlay{XR_TYPE_SESSION_CREATE_INFO_OVERLAY_EXTX, nullptr, 0, 42};
};

TEST_F(Overlay, IsToldToTheServiceWithItsPlacement)
{
	const Application application({"XR_MND_headless", "XR_EXTX_overlay", "XR_KHR_composition_layer_depth"});
	overlay.createFlags = 1;
	EXPECT_EQ(create(application, &overlay, session), XR_ERROR_VALIDATION_FAILURE) << "no flag is defined";
	overlay.createFlags = 0;
	ASSERT_EQ(create(application, &overlay, session), XR_SUCCESS);
	const ipc::CreateSession asked = service.record().sessions.at(0);
	EXPECT_TRUE(asked.overlay == 1 && asked.placement == 42 && asked.hasDepth == 1);
}

TEST_F(Overlay, IsAnOrdinarySessionWithoutTheExtensionOrTheStructure)
{
	{
		const Application application({"XR_MND_headless"});
		ASSERT_EQ(create(application, &overlay, session), XR_SUCCESS) << "unknown structures are skipped";
	}
	const Application application({"XR_MND_headless", "XR_EXTX_overlay"});
	ASSERT_EQ(create(application, nullptr, session), XR_SUCCESS);
	for (const ipc::CreateSession &asked : service.record().sessions)
		EXPECT_TRUE(asked.overlay == 0 && asked.placement == 0 && asked.hasDepth == 0);
}

TEST_F(Overlay, HearsWhetherTheMainSessionIsSeen)
{
	const Application application({"XR_MND_headless", "XR_EXTX_overlay"});
	ASSERT_EQ(create(application, &overlay, session), XR_SUCCESS);
	application.states();
	for (const uint32_t visible : {1u, 0u}) {
		service.send({.type = ipc::EventType::mainVisibilityChanged, .session = 1, .visible = visible, .flags = visible});
		XrEventDataBuffer buffer;
		ASSERT_EQ(application.poll(buffer), XR_SUCCESS);
		ASSERT_EQ(buffer.type, XR_TYPE_EVENT_DATA_MAIN_SESSION_VISIBILITY_CHANGED_EXTX);
		const auto &event = reinterpret_cast<const XrEventDataMainSessionVisibilityChangedEXTX &>(buffer);
		EXPECT_EQ(event.visible, visible);
		EXPECT_EQ(event.flags, visible ? XR_OVERLAY_MAIN_SESSION_ENABLED_COMPOSITION_LAYER_INFO_DEPTH_BIT_EXTX : 0);
	}
}

} // namespace
} // namespace arift
