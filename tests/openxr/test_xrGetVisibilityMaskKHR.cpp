// XR_KHR_visibility_mask.
#include "tests/openxr/headless_session.h"
#include <cmath>
#include <numbers>

namespace arift
{
namespace
{

struct Mask {
	std::vector<XrVector2f> vertices;
	std::vector<uint32_t> indices;
};

/// The field of view is a square of 1 to each side, the lens a circle with 60 points and one towards each corner.
struct VisibilityMask : testing::Test, HeadlessApplication {
	VisibilityMask() : HeadlessApplication({"XR_KHR_visibility_mask"})
	{
		const float quarter = std::numbers::pi_v<float> / 4;
		const auto views = service.system().views.read();
		ipc::ViewTable table = *views;
		table.fov = {XrFovf{-quarter, quarter, quarter, -quarter}, XrFovf{-quarter, quarter, quarter, -quarter}};
		service.system().views.write(table);
	}
	void setRadius(float radius)
	{
		ipc::LensOutlines outlines{};
		for (ipc::LensOutline &outline : outlines) {
			outline.count = 64;
			for (uint32_t i = 0; i < 64; ++i) {
				const float angle = 2 * std::numbers::pi_v<float> * float(i) / 64;
				const float limit = 1 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
				const float r = std::min(radius, limit);
				outline.points[i] = {r * std::cos(angle), r * std::sin(angle)};
			}
		}
		service.system().lensOutlines.write(outlines);
	}
	XrResult call(XrVisibilityMaskTypeKHR type, XrVisibilityMaskKHR &mask, uint32_t view = 0,
				  XrViewConfigurationType configuration = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) const
	{
		return get<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR")(session, configuration, view, type, &mask);
	}
	Mask read(XrVisibilityMaskTypeKHR type) const
	{
		XrVisibilityMaskKHR mask{XR_TYPE_VISIBILITY_MASK_KHR};
		EXPECT_EQ(call(type, mask), XR_SUCCESS);
		Mask found{std::vector<XrVector2f>(mask.vertexCountOutput), std::vector<uint32_t>(mask.indexCountOutput)};
		mask.vertexCapacityInput = mask.vertexCountOutput;
		mask.indexCapacityInput = mask.indexCountOutput;
		mask.vertices = found.vertices.data();
		mask.indices = found.indices.data();
		EXPECT_EQ(call(type, mask), XR_SUCCESS);
		return found;
	}
};

/// Of all triangles; each must be counter-clockwise.
double areaOf(const Mask &mask)
{
	double area = 0;
	for (size_t i = 0; i + 2 < mask.indices.size(); i += 3) {
		const XrVector2f a = mask.vertices[mask.indices[i]], b = mask.vertices[mask.indices[i + 1]], c = mask.vertices[mask.indices[i + 2]];
		const double twice = double((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
		EXPECT_GT(twice, 0);
		area += twice / 2;
	}
	return area;
}

TEST_F(VisibilityMask, VisibleAndHiddenAreTogetherTheFieldOfView)
{
	setRadius(1.2f);
	const double visible = areaOf(read(XR_VISIBILITY_MASK_TYPE_VISIBLE_TRIANGLE_MESH_KHR));
	const double hidden = areaOf(read(XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR));
	EXPECT_NEAR(visible + hidden, 4, 1e-4);
	EXPECT_GT(hidden, 0.1);
	const Mask loop = read(XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR);
	EXPECT_EQ(loop.indices.size(), 64u);
	EXPECT_EQ(loop.vertices.size(), 64u);
}

TEST_F(VisibilityMask, IsEmptyWhereTheLensShowsAll)
{
	setRadius(2);
	for (const auto type : {XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, XR_VISIBILITY_MASK_TYPE_VISIBLE_TRIANGLE_MESH_KHR,
							XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR})
		EXPECT_TRUE(read(type).vertices.empty() && read(type).indices.empty());
}

TEST_F(VisibilityMask, ChecksWhatItIsAskedFor)
{
	setRadius(1.2f);
	constexpr auto loop = XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR;
	XrVisibilityMaskKHR mask{XR_TYPE_VISIBILITY_MASK_KHR};
	EXPECT_EQ(call(loop, mask, 2), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(call(XrVisibilityMaskTypeKHR(9), mask), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(call(loop, mask, 0, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
	XrVector2f vertices[64];
	mask.vertexCapacityInput = 64;
	mask.vertices = vertices;
	EXPECT_EQ(call(loop, mask), XR_SUCCESS) << "one capacity of 0 is as good as two";
	mask.indexCapacityInput = 63;
	EXPECT_EQ(call(loop, mask), XR_ERROR_SIZE_INSUFFICIENT);
	EXPECT_EQ(mask.indexCountOutput, 64u);
}

} // namespace
} // namespace arift
