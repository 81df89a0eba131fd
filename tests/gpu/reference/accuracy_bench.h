// What the comparisons of the panel with the second account of it have in common: a renderer and a reference of one lens, pictures that
// both know, and what counts as alike.
#pragma once
#include "runtime/optics/rig.h"
#include "tests/gpu/reference/coordinate_pictures.h"
#include "tests/gpu/reference/error_figures.h"
#include <cmath>
#include <gtest/gtest.h>

namespace arift::reference
{

inline constexpr double degree = M_PI / 180;
inline constexpr uint64_t firstKey = 100;

inline XrPosef toPose(const Placement &p)
{
	return {{float(p.turn.x()), float(p.turn.y()), float(p.turn.z()), float(p.turn.w())},
			{float(p.place.x()), float(p.place.y()), float(p.place.z())}};
}
inline Placement toPlacement(const XrPosef &p)
{
	return {Eigen::Quaterniond(p.orientation.w, p.orientation.x, p.orientation.y, p.orientation.z).normalized(),
			{p.position.x, p.position.y, p.position.z}};
}
inline XrFovf toFov(const Window &w)
{
	return {float(std::atan(w.left)), float(std::atan(w.right)), float(std::atan(w.up)), float(std::atan(w.down))};
}
inline Placement placed(const Eigen::Vector3d &axis, double angle, const Eigen::Vector3d &place)
{
	return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())), place};
}

struct LensChoice {
	const char *name;
	bool spline;
};
inline void PrintTo(const LensChoice &lens, std::ostream *to) { *to << lens.name; }

/// Renderer and reference of one lens: built once for all its cases.
class Bench
{
public:
	explicit Bench(bool spline)
		: rig_(makeRig(spline)),
		  numbers_(readRigNumbers(rigFile())),
		  reference_(spline ? Lens::spline(numbers_.eyeRelief) : Lens::polynomial(), numbers_.cameras),
		  renderer_(device_, rig_, VK_FORMAT_R16G16B16A16_UNORM)
	{
		for (int eye = 0; eye < 2; ++eye) windows_[size_t(eye)] = fieldOfView(eye, numbers_.eyeRelief);
		const FrameAllocator allocate = makeHostFrameBuffer;
		for (size_t eye = 0; eye < 2; ++eye)
			for (const Content content : contents)
				frames_[eye][size_t(content)] =
					coordinateFrame(allocate, content, uint32_t(numbers_.cameras[eye].width), uint32_t(numbers_.cameras[eye].height));
	}

	const PanelReference &reference() const { return reference_; }
	const RigNumbers &numbers() const { return numbers_; }
	const Window &window(int eye) const { return windows_[size_t(eye)]; }
	PanelRenderer &renderer() { return renderer_; }
	gpu::Device &device() { return device_; }

	Situation situation(double degreesPerSecond, double viewOffset, double distance) const
	{
		Situation now;
		now.motion.start =
			Eigen::AngleAxisd(20 * degree, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(-8 * degree, Eigen::Vector3d::UnitX());
		now.motion.rate = Eigen::Vector3d(0.25, 1, 0.1).normalized() * (degreesPerSecond * degree);
		now.motion.pivotInHead = Eigen::Vector3d(rig_.pivotInHead.x, rig_.pivotInHead.y, rig_.pivotInHead.z);
		for (size_t eye = 0; eye < 2; ++eye) {
			now.eyeInHead[eye] = toPlacement(rig_.eyeInHead[eye]);
			now.cameraInHead[eye] = toPlacement(rig_.cameras.at(eye).cameraInHead);
		}
		now.exposure = {-0.040, -0.043};
		now.viewOffset = viewOffset;
		now.passthroughDistance = distance;
		return now;
	}

	/// Poses of the first and the last line; no picture yet.
	PanelInputs inputs(const Situation &now) const
	{
		PanelInputs inputs;
		inputs.displayTime = second;
		inputs.passthroughDistance = now.passthroughDistance;
		for (int eye = 0; eye < 2; ++eye)
			for (const double y : {0.5, 799.5}) {
				const double time = Situation::timeAt(y);
				(y < 400 ? inputs.top : inputs.bottom)[size_t(eye)] = {toPose(now.view(eye, time)), toPose(now.motion.head(time))};
			}
		return inputs;
	}

	PanelReadings renderCameras(const Situation &now)
	{
		return render(uint32_t(numbers_.cameras[0].width), uint32_t(numbers_.cameras[0].height), [&](Content content) {
			PanelInputs all = inputs(now);
			for (size_t eye = 0; eye < 2; ++eye) {
				CameraFrame frame = frames_[eye][size_t(content)];
				frame.midExposure = all.displayTime + fromSeconds(now.exposure[eye]);
				all.cameras[eye] = {.frame = frame, .cameraInOrigin = toPose(now.camera(int(eye))), .lens = uint32_t(eye)};
			}
			return all;
		});
	}
	template <typename MakeInputs> PanelReadings render(uint32_t width, uint32_t height, MakeInputs make)
	{
		std::array<ReadbackImage, 3> images;
		for (const Content content : contents) {
			renderer_.render(make(content));
			images[size_t(content)] = renderer_.readPanel();
		}
		return {std::move(images), width, height};
	}

	/// Compares on a grid; `margin` in texels keeps away from the picture's borders, where it fades.
	ErrorFigures compare(const PanelReadings &readings, const Mapping &mapping, int width, int height, double margin) const
	{
		ErrorFigures figures;
		for (uint32_t y = 1; y < 800; y += 5)
			for (uint32_t x = 1; x < 1280; x += 5)
				for (int channel = 0; channel < 3; ++channel) {
					const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
					const int eye = x < 640 ? 0 : 1;
					if (!window(eye).holds(reference_.lens().tangents(eye, channel, pixel))) continue;
					const auto wanted = mapping(eye, channel, pixel);
					if (!wanted || wanted->x() < margin || wanted->y() < margin || wanted->x() > width - 1 - margin ||
						wanted->y() > height - 1 - margin)
						continue;
					const PanelReadings::Reading shown = readings.at(x, y, channel);
					++figures.expected;
					if (shown.weight < 0.9995) {
						++figures.faded;
						continue;
					}
					if (const auto error = panelError(mapping, eye, channel, pixel, *wanted, {shown.column, shown.row}))
						figures.errors.push_back(*error);
				}
		return figures;
	}

private:
	static std::string rigFile() { return ARIFT_SOURCE_DIR "/calib/rigs/arift.toml"; }
	static Rig makeRig(bool spline)
	{
		Rig rig = readRig(rigFile());
		if (!spline) rig.lens = LensModel(PolynomialLens{});
		return rig;
	}

	Rig rig_;
	RigNumbers numbers_;
	PanelReference reference_;
	std::array<Window, 2> windows_{};
	gpu::Device device_;
	PanelRenderer renderer_;
	std::array<std::array<CameraFrame, 3>, 2> frames_;
};

/// The same picture for both eyes in all three contents, known to the renderer as long as this lives.
class Textures
{
public:
	Textures(Bench &bench, uint32_t width, uint32_t height, bool cube = false) : bench_(bench)
	{
		for (const Content content : contents) {
			textures_[size_t(content)] = std::make_unique<CoordinateTexture>(bench.device(), content, width, height, cube);
			const gpu::SharedImage &shared = textures_[size_t(content)]->shared();
			bench.renderer().addImage(firstKey + uint64_t(content), shared.image(), shared.spec());
		}
		rectangle_ = {{0, 0}, {int32_t(width), int32_t(height)}};
	}
	~Textures()
	{
		for (const Content content : contents) bench_.renderer().removeImage(firstKey + uint64_t(content));
	}
	LayerTexture texture(Content content) const { return {firstKey + uint64_t(content), 0, rectangle_}; }

private:
	Bench &bench_;
	std::array<std::unique_ptr<CoordinateTexture>, 3> textures_;
	XrRect2Di rectangle_;
};

class PanelAccuracy : public testing::TestWithParam<LensChoice>
{
protected:
	static Bench &bench()
	{
		static std::array<std::unique_ptr<Bench>, 2> benches;
		auto &one = benches[GetParam().spline];
		if (!one) one = std::make_unique<Bench>(GetParam().spline);
		return *one;
	}
	static void judge(const std::string &what, const ErrorFigures &figures, double mostFaded)
	{
		std::printf("[ FIGURE   ] %-10s %-52s %s\n", GetParam().name, what.c_str(), figures.text().c_str());
		ASSERT_GT(figures.errors.size(), 2000u) << what;
		EXPECT_GE(figures.share(0.25), 0.995) << what;
		EXPECT_LE(figures.largest(), 0.5) << what;
		EXPECT_LE(double(figures.faded), mostFaded * double(figures.expected)) << what;
	}
};

inline std::string describe(const char *what, double rate, double offset, double distance)
{
	char text[100];
	std::snprintf(text, sizeof text, "%s, %3.0f deg/s, offset %.1f, distance %.1f m", what, rate, offset, distance);
	return text;
}

} // namespace arift::reference
