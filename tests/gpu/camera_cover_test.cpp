// Where a camera is asked for its image: against a dense look at the shipped Rig's cameras.
#include "runtime/compositor/blocks.h"
#include "runtime/compositor/camera_cover.h"
#include <cmath>
#include <gtest/gtest.h>

namespace arift
{
namespace
{

constexpr double degree = M_PI / 180;

struct Scene {
	explicit Scene(double turned) : rig(readRig(ARIFT_RIG)), optics(rig)
	{
		for (size_t eye = 0; eye < 2; ++eye) {
			inputs.top[eye] = {rig.eyeInHead[eye], identityPose};
			inputs.bottom[eye] = inputs.top[eye];
			inputs.bottom[eye].viewInOrigin.orientation = rotationAbout({0, 1, 0}, turned);
		}
	}
	MatrixByBand matrices(const TileGrid &grid, size_t eye) const
	{
		const auto eyes = eyesByBand(inputs, grid, panelGeometry(optics).height);
		MatrixByBand m;
		for (size_t band = 0; band < m.size(); ++band) m[band] = cameraMatrix(eyes[band][eye], rig.cameras[eye].cameraInHead);
		return m;
	}
	Rig rig;
	PanelOptics optics;
	PanelInputs inputs;
};

/// Whether any pixel of a tile lies in the camera's image, in any colour, by ray and without matrices by line.
bool isSeen(const Scene &scene, const MatrixByBand &m, size_t eye, const PixelRect &tile)
{
	const PanelCamera &camera = scene.optics.cameras[eye];
	const ViewGeometry geometry = panelGeometry(scene.optics);
	const ViewGeometry::Eye &view = geometry.eyes[eye];
	for (int y = tile.y0; y < tile.y1; y += 2)
		for (int x = tile.x0; x < tile.x1; ++x) {
			const glm::dvec2 vector = (glm::dvec2(x + 0.5, y + 0.5) - view.axis) * view.perPixel;
			const double r2 = std::min(glm::dot(vector, vector), scene.optics.lens.maxR2());
			const double s = double(y) / double(geometry.height);
			const glm::dmat3 here = s < 0.5 ? m[0] * (1 - 2 * s) + m[1] * (2 * s) : m[1] * (2 - 2 * s) + m[2] * (2 * s - 1);
			for (const Channel channel : {Channel::red, Channel::green, Channel::blue}) {
				const auto chromatic = scene.optics.lens.chromatic(channel);
				const glm::dvec2 tangents = vector * scene.optics.lens.scale(r2) * (chromatic[0] + chromatic[1] * r2);
				const auto texel = texelOf(camera, here * glm::dvec3(tangents, 1));
				if (texel && texel->x > -0.5 && texel->y > -0.5 && texel->x < camera.width - 0.5 && texel->y < camera.height - 0.5)
					return true;
			}
		}
	return false;
}

TEST(CameraCover, isWithoutHolesAndLeavesTheRestAlone)
{
	for (const double turned : {0.0, 8 * degree, -8 * degree}) {
		const Scene scene(turned);
		for (size_t eye = 0; eye < 2; ++eye) {
			const TileGrid grid = makeGrid(scene.optics, panelGeometry(scene.optics), eye);
			const MatrixByBand m = scene.matrices(grid, eye);
			const FrameVector<bool> seen = seenTiles(grid, m, scene.optics.cameras[eye]);
			size_t asked = 0, needed = 0, all = 0;
			for (int row = 0; row < grid.rows(); ++row)
				for (int column = 0; column < grid.columns(); ++column) {
					const PixelRect tile = grid.tile(column, row);
					if (tile.x0 >= tile.x1) continue;
					const bool here = seen[size_t(row * grid.columns() + column)], must = isSeen(scene, m, eye, tile);
					EXPECT_TRUE(here || !must) << "eye " << eye << ", tile " << column << ", " << row;
					++all;
					asked += here;
					needed += must;
				}
			RecordProperty("tiles", int(all));
			EXPECT_LT(asked, needed * 1.15) << needed << " of " << all << " tiles show something";
			EXPECT_LT(asked, all * 0.75);
		}
	}
}

} // namespace
} // namespace arift
