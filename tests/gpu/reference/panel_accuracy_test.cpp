// The panel image against the second account of it, in panel pixels: camera images, projection layers and quads.
#include "tests/gpu/reference/accuracy_bench.h"

using namespace arift;
using namespace arift::reference;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

TEST_P(PanelAccuracy, CameraImage)
{
	const int width = bench().numbers().cameras[0].width, height = bench().numbers().cameras[0].height;
	for (const double rate : {0.0, 200.0})
		for (const double offset : {0.0, 0.5, 1.0})
			for (const double distance : {0.4, 2.0, 5.0}) {
				if (distance != 2.0 && (offset != 0 || rate == 0 || !GetParam().spline)) continue;
				const Situation now = bench().situation(rate, offset, distance);
				const PanelReadings readings = bench().renderCameras(now);
				const Mapping mapping = [&](int eye, int channel, const Vector2d &pixel) {
					return bench().reference().cameraTexel(now, eye, channel, pixel);
				};
				judge(describe("camera", rate, offset, distance), bench().compare(readings, mapping, width, height, 48), 0.05);
			}
}

/// Least-squares slope of camera angle over display angle within five degrees of the eye's axis.
double angularGain(const Bench &bench, const PanelReadings &readings, const Situation &now, int eye, int axis)
{
	double xx = 0, xy = 0, x = 0, y = 0, n = 0;
	for (uint32_t row = 0; row < 800; ++row)
		for (uint32_t column = uint32_t(eye) * 640; column < 640 + uint32_t(eye) * 640; ++column) {
			const Vector2d t = bench.reference().lens().tangents(eye, 1, {column + 0.5, row + 0.5});
			if (t.norm() > std::tan(5 * degree)) continue;
			const PanelReadings::Reading shown = readings.at(column, row, 1);
			const Vector3d direction =
				now.cameraInHead[size_t(eye)].turn * bench.numbers().cameras[size_t(eye)].look({shown.column, shown.row});
			const double display = std::atan(t[axis]), camera = std::atan2(direction[axis], -direction.z());
			xx += display * display, xy += display * camera, x += display, y += camera, n += 1;
		}
	return (xy - x * y / n) / (xx - x * x / n);
}

TEST_P(PanelAccuracy, AngularGainIsOne)
{
	const Situation now = bench().situation(0, 1, 2);
	const PanelReadings readings = bench().renderCameras(now);
	for (int eye = 0; eye < 2; ++eye) {
		const double horizontal = angularGain(bench(), readings, now, eye, 0), vertical = angularGain(bench(), readings, now, eye, 1);
		std::printf("[ FIGURE   ] %-10s angular gain of the camera image, %s eye: horizontal %.5f, vertical %.5f\n", GetParam().name,
					eye == 0 ? "left" : "right", horizontal, vertical);
		EXPECT_NEAR(horizontal, 1, 0.005);
		EXPECT_NEAR(vertical, 1, 0.005);
	}
}

TEST_P(PanelAccuracy, ProjectionLayer)
{
	constexpr int width = 1122, height = 1553;
	Textures textures(bench(), width, height);
	for (const bool headLocked : {false, true})
		for (const double rate : {0.0, 200.0})
			for (const double offset : {0.0, 1.0}) {
				const Situation now = bench().situation(rate, offset, 2);
				// In the world: drawn for a display time one refresh too early, as by an application that has missed one.
				std::array<ProjectionPicture, 2> pictures;
				for (int eye = 0; eye < 2; ++eye)
					pictures[size_t(eye)] = {headLocked ? now.eyeInHead[size_t(eye)] : now.view(eye, -0.0167), bench().window(eye), width,
											 height};
				const PanelReadings readings = bench().render(width, height, [&](Content content) {
					PanelInputs all = bench().inputs(now);
					PanelLayer &layer = all.layers.emplace_back();
					layer.headLocked = headLocked;
					for (size_t eye = 0; eye < 2; ++eye)
						layer.projection[eye] = {toPose(pictures[eye].viewInFrame), toFov(pictures[eye].window), textures.texture(content)};
					return all;
				});
				const Mapping mapping = [&](int eye, int channel, const Vector2d &pixel) {
					return bench().reference().projectionTexel(now, pictures[size_t(eye)], headLocked, eye, channel, pixel);
				};
				judge(describe(headLocked ? "projection, head" : "projection, world", rate, offset, 2),
					  bench().compare(readings, mapping, width, height, 2), 0.05);
			}
}

TEST_P(PanelAccuracy, ObliqueQuad)
{
	constexpr int width = 640, height = 512;
	Textures textures(bench(), width, height);
	for (const bool headLocked : {false, true})
		for (const double rate : {0.0, 200.0})
			for (const double offset : {0.0, 1.0}) {
				const Situation now = bench().situation(rate, offset, 2);
				const Placement ahead = placed({0.2, 1, 0.3}, 50 * degree, {0.1, -0.05, -1.2});
				const QuadPicture quad{headLocked ? ahead : now.motion.head(0).holding(ahead), 1.5, 1.2, width, height};
				const PanelReadings readings = bench().render(width, height, [&](Content content) {
					PanelInputs all = bench().inputs(now);
					PanelLayer &layer = all.layers.emplace_back();
					layer.headLocked = headLocked;
					for (size_t eye = 0; eye < 2; ++eye)
						layer.quad[eye] = {
							toPose(quad.quadInFrame), {float(quad.metresWide), float(quad.metresHigh)}, textures.texture(content)};
					return all;
				});
				const Mapping mapping = [&](int eye, int channel, const Vector2d &pixel) {
					return bench().reference().quadTexel(now, quad, headLocked, eye, channel, pixel);
				};
				judge(describe(headLocked ? "quad, head" : "quad, world", rate, offset, 2),
					  bench().compare(readings, mapping, width, height, 2), 0.05);
			}
}

struct CurvedCase {
	const char *what;
	double radius;
	Placement fromHead; ///< its centre, of the head at the middle line
	double across, aspect, upper, lower;
};

CurvedView curvedView(const CurvedCase &one, const Placement &centre, const LayerTexture &texture)
{
	CurvedView view{.surface = one.aspect > 0 ? Surface::cylinder : Surface::sphere,
					.centreInFrame = toPose(centre),
					.radius = float(one.radius),
					.texture = texture};
	const double high = one.upper - one.lower;
	view.uvAhead = {0.5f, one.aspect > 0 ? 0.5f : float(one.upper / high)};
	view.uvPerUnit = {float(1 / one.across), float(one.aspect > 0 ? -one.aspect / one.across : -1 / high)};
	return view;
}

TEST_P(PanelAccuracy, CurvedLayers)
{
	constexpr int width = 800, height = 500;
	Textures textures(bench(), width, height);
	const Placement off = placed({0.3, 1, 0.2}, 15 * degree, {0.1, 0.05, 0.2});
	const CurvedCase cases[] = {
		{"cylinder", 1.1, off, 100 * degree, 1.4, 0, 0},
		{"endless cylinder", 0, off, 100 * degree, 1.2, 0, 0},
		{"cylinder from outside", 0.4, placed({0, 1, 0}, 0, {0, 0, -1.2}), 150 * degree, 1.3, 0, 0},
		{"sphere", 1.4, off, 110 * degree, 0, 40 * degree, -50 * degree},
		{"endless sphere, whole", 0, placed({1, 0.2, 0}, 30 * degree, {0, 0, 0}), 360 * degree, 0, 90 * degree, -90 * degree},
	};
	for (const CurvedCase &one : cases)
		for (const bool headLocked : {false, true}) {
			const Situation now = bench().situation(200, 1, 2);
			const Placement centre = headLocked ? one.fromHead : now.motion.head(0).holding(one.fromHead);
			const CurvedPicture picture{centre, one.radius, one.across, one.aspect, one.upper, one.lower, width, height};
			const PanelReadings readings = bench().render(width, height, [&](Content content) {
				PanelInputs all = bench().inputs(now);
				PanelLayer &layer = all.layers.emplace_back();
				layer.headLocked = headLocked;
				for (auto &view : layer.curved) view = curvedView(one, centre, textures.texture(content));
				return all;
			});
			const Mapping mapping = [&](int eye, int channel, const Vector2d &pixel) {
				return bench().reference().curvedTexel(now, picture, headLocked, eye, channel, pixel);
			};
			judge(describe((one.what + std::string(headLocked ? ", head" : ", world")).c_str(), 200, 1, 2),
				  bench().compare(readings, mapping, width, height, 4), 0.05);
		}
}

TEST_P(PanelAccuracy, CubeLayer)
{
	constexpr int size = 512;
	Textures textures(bench(), size, size, true);
	for (const double yaw : {0.0, 100.0, 200.0, 290.0}) {
		const Situation now = bench().situation(200, 1, 2);
		const CubePicture cube{Eigen::Quaterniond(Eigen::AngleAxisd(yaw * degree, Vector3d(0.5, 1, 0.3).normalized())), size};
		const PanelReadings readings = bench().render(size, size, [&](Content content) {
			PanelInputs all = bench().inputs(now);
			for (auto &view : all.layers.emplace_back().cube)
				view = CubeView{toPose({cube.turnInFrame, {0, 0, 0}}).orientation, textures.texture(content)};
			return all;
		});
		const Mapping mapping = [&](int eye, int channel, const Vector2d &pixel) -> std::optional<Vector2d> {
			return bench().reference().cubeTexel(now, cube, false, eye, channel, pixel).texel;
		};
		// The lens' rim fades 5 % of a view that is filled; without the places near a cube's edges it is a larger share.
		judge(describe(("cube turned by " + std::to_string(int(yaw))).c_str(), 200, 1, 2),
			  bench().compare(readings, mapping, size, size, 24), 0.06);
	}
}

INSTANTIATE_TEST_SUITE_P(Lenses, PanelAccuracy, testing::Values(LensChoice{"spline", true}, LensChoice{"polynomial", false}),
						 [](const auto &choice) { return std::string(choice.param.name); });

} // namespace
