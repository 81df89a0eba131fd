// Which reference spaces there are, by version and extension, and where they lie.
#include "runtime/motion/spaces.h"
#include "tests/openxr/headless_session.h"
#include <algorithm>

namespace arift
{
namespace
{

std::vector<XrReferenceSpaceType> typesOf(const HeadlessApplication &app)
{
	uint32_t count = 0;
	std::vector<XrReferenceSpaceType> types(8);
	EXPECT_EQ(app.get<PFN_xrEnumerateReferenceSpaces>("xrEnumerateReferenceSpaces")(app.session, 8, &count, types.data()), XR_SUCCESS);
	types.resize(count);
	return types;
}

XrResult create(const HeadlessApplication &app, XrReferenceSpaceType type)
{
	const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, identityPose};
	XrSpace space = XR_NULL_HANDLE;
	return app.get<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(app.session, &info, &space);
}

constexpr auto view = XR_REFERENCE_SPACE_TYPE_VIEW, local = XR_REFERENCE_SPACE_TYPE_LOCAL, stage = XR_REFERENCE_SPACE_TYPE_STAGE,
			   localFloor = XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR, unbounded = XR_REFERENCE_SPACE_TYPE_UNBOUNDED_MSFT;
using Types = std::vector<XrReferenceSpaceType>;

TEST(xrEnumerateReferenceSpaces, ByVersionAndExtension)
{
	const struct {
		std::vector<const char *> extensions;
		XrVersion version;
		Types types;
	} cases[] = {{{}, XR_API_VERSION_1_0, {view, local, stage}},
				 {{}, XR_API_VERSION_1_1, {view, local, stage, localFloor}},
				 {{"XR_EXT_local_floor"}, XR_API_VERSION_1_0, {view, local, stage, localFloor}},
				 {{"XR_MSFT_unbounded_reference_space"}, XR_API_VERSION_1_0, {view, local, stage, unbounded}}};
	for (const auto &[extensions, version, types] : cases) {
		const HeadlessApplication app(extensions, version);
		EXPECT_EQ(typesOf(app), types);
		for (const auto type : {view, local, stage, localFloor, unbounded}) {
			const bool isThere = std::ranges::find(types, type) != types.end();
			EXPECT_EQ(create(app, type), isThere ? XR_SUCCESS : XR_ERROR_REFERENCE_SPACE_UNSUPPORTED) << int(type);
		}
	}
}

TEST(xrLocateSpace, UnboundedStaysWhenLocalMoves)
{
	HeadlessApplication app({"XR_MSFT_unbounded_reference_space"});
	const XrSpace far = app.application.space(app.session, unbounded), here = app.application.space(app.session, local);
	ipc::ViewTable views = *app.service.system().views.read();
	views.localInOrigin = {identityOrientation, {1, 0, 2}};
	app.service.system().views.write(views);
	XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
	ASSERT_EQ(app.get<PFN_xrLocateSpace>("xrLocateSpace")(here, far, realTime(), &location), XR_SUCCESS);
	EXPECT_EQ(location.pose.position.x, 1);
	EXPECT_EQ(location.pose.position.z, 2);
}

TEST(xrLocateSpacesKHR, IsThereWithItsExtensionAlone)
{
	const HeadlessApplication with({"XR_KHR_locate_spaces"}, XR_API_VERSION_1_0);
	const XrSpace base = with.application.space(with.session, local);
	const XrSpace spaces[] = {with.application.space(with.session, stage), base};
	XrSpaceLocationData data[2]{};
	const XrSpacesLocateInfo info{XR_TYPE_SPACES_LOCATE_INFO, nullptr, base, realTime(), 2, spaces};
	XrSpaceLocations locations{XR_TYPE_SPACE_LOCATIONS, nullptr, 2, data};
	ASSERT_EQ(with.get<PFN_xrLocateSpacesKHR>("xrLocateSpacesKHR")(with.session, &info, &locations), XR_SUCCESS);
	EXPECT_FLOAT_EQ(data[0].pose.position.y, -1.6f);
	EXPECT_EQ(data[1].pose.position.y, 0);
	EXPECT_EQ(with.get<PFN_xrLocateSpaces>("xrLocateSpaces")(with.session, &info, &locations), XR_ERROR_FUNCTION_UNSUPPORTED)
		<< "OpenXR 1.1's own";
	const Application newer({"XR_MND_headless"});
	EXPECT_EQ(newer.get<PFN_xrLocateSpacesKHR>("xrLocateSpacesKHR"), nullptr);
}

} // namespace
} // namespace arift
