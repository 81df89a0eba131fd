// Projection layers with depth, shown for a head that has moved since they were drawn, against the second account of them.
#include "tests/gpu/reference/accuracy_bench.h"

using namespace arift;
using namespace arift::reference;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr int width = 1122, height = 1553;
constexpr uint64_t depthKey = firstKey + 10;
constexpr double endless = std::numeric_limits<double>::infinity();
/// Depth 0 is this far away, metres, depth 1 infinitely far; reversed: the other way round.
constexpr double nearZ = 0.1;

class PanelDepthAccuracy : public PanelAccuracy
{
protected:
	/// What both eyes' pictures show, drawn `late` seconds before they are seen and from a place further `off`, in the head's axes.
	struct Drawn {
		std::vector<Facet> facets; ///< fixed in the world
		std::array<ProjectionPicture, 2> pictures;
		std::vector<std::unique_ptr<DepthTexture>> depths;
		bool reversed = false;
		int depthWidth = 0, depthHeight = 0;
	};
	static Drawn draw(const Situation &now, std::vector<Facet> facets, double late, const Vector3d &off, bool reversed, int divisor)
	{
		Drawn drawn{std::move(facets), {}, {}, reversed, width / divisor, height / divisor};
		for (int eye = 0; eye < 2; ++eye) {
			Placement view = now.view(eye, -late);
			view.place += view.turn * off;
			const ProjectionPicture &picture = drawn.pictures[size_t(eye)] = {view, bench().window(eye), width, height};
			const auto value = [&](double column, double row) {
				const double inverse = inverseDistance(picture, drawn.facets, column * divisor, row * divisor);
				return reversed ? nearZ * inverse : 1 - nearZ * inverse;
			};
			const auto &depth = drawn.depths.emplace_back(
				std::make_unique<DepthTexture>(bench().device(), uint32_t(drawn.depthWidth), uint32_t(drawn.depthHeight), value));
			bench().renderer().removeImage(depthKey + uint64_t(eye));
			bench().renderer().addImage(depthKey + uint64_t(eye), depth->shared().image(), depth->shared().spec());
		}
		return drawn;
	}
	static PanelReadings render(const Situation &now, const Textures &textures, const Drawn &drawn, bool withDepth = true)
	{
		return bench().render(width, height, [&](Content content) {
			PanelInputs all = bench().inputs(now);
			PanelLayer &layer = all.layers.emplace_back();
			for (size_t eye = 0; eye < 2; ++eye) {
				layer.projection[eye] = {toPose(drawn.pictures[eye].viewInFrame), toFov(drawn.pictures[eye].window),
										 textures.texture(content)};
				const float bias = drawn.reversed ? 0 : float(1 / nearZ), scale = float(drawn.reversed ? 1 / nearZ : -1 / nearZ);
				if (withDepth)
					layer.projection[eye]->depth =
						ViewDepth{{depthKey + eye, 0, {{0, 0}, {drawn.depthWidth, drawn.depthHeight}}}, bias, scale};
			}
			return all;
		});
	}
	static std::optional<SceneTexel> seen(const Situation &now, const Drawn &drawn, int eye, int channel, const Vector2d &pixel)
	{
		return bench().reference().sceneTexel(now, drawn.pictures[size_t(eye)], drawn.facets, false, eye, channel, pixel);
	}
	static Mapping mappingOf(const Situation &now, const Drawn &drawn)
	{
		return [&](int eye, int channel, const Vector2d &pixel) -> std::optional<Vector2d> {
			const auto place = seen(now, drawn, eye, channel, pixel);
			return place ? std::optional(place->texel) : std::nullopt;
		};
	}
	~PanelDepthAccuracy() override
	{
		for (uint64_t eye = 0; eye < 2; ++eye) bench().renderer().removeImage(depthKey + eye);
	}
};

/// A wall before the head, its normal turned from straight towards it.
Facet wall(const Situation &now, double distance, double yaw, double pitch)
{
	const Placement turned{Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitY()) * Eigen::AngleAxisd(pitch, Vector3d::UnitX())),
						   {0, 0, -distance}};
	return {now.motion.head(0).holding(turned), endless, endless};
}

TEST_P(PanelDepthAccuracy, AWallIsSeenWhereItIs)
{
	struct Case {
		const char *what;
		double distance, yaw;
		Vector3d off;
		double rate;
		bool reversed;
		int divisor;
	};
	const Case cases[] = {{"0.3 m, 30 mm to the left", 0.3, 0, {-0.03, 0, 0}, 0, false, 1},
						  {"0.6 m, askew, 30 mm to the right, 20 up", 0.6, 40 * degree, {0.03, 0.02, 0}, 0, true, 1},
						  {"1 m, askew, 40 mm behind", 1, -30 * degree, {0, 0, 0.04}, 0, true, 2},
						  {"1 m, askew, 40 mm ahead", 1, -30 * degree, {0, 0, -0.04}, 0, false, 1},
						  {"0.7 m, askew, 50 ms late", 0.7, 30 * degree, {0, 0, 0}, 200, false, 2},
						  {"6 m, 60 mm to the left", 6, 0, {-0.06, 0, 0}, 0, true, 1}};
	Textures textures(bench(), width, height);
	for (const Case &one : cases) {
		const Situation now = bench().situation(one.rate, 0, 2);
		const Drawn drawn = draw(now, {wall(now, one.distance, one.yaw, 0.2)}, 0.05, one.off, one.reversed, one.divisor);
		const Mapping mapping = mappingOf(now, drawn);
		const PanelReadings readings = render(now, textures, drawn);
		judge(std::string("with depth: wall at ") + one.what, bench().compare(readings, mapping, width, height, 24), 0.05);
		const ErrorFigures flat = bench().compare(render(now, textures, drawn, false), mapping, width, height, 24);
		EXPECT_GT(flat.quantile(0.5), 1) << one.what << ": without its depth it is elsewhere";
	}
}

/// A card before a wall: both are where they are, but for what the card hid when they were drawn. There the wall beside it is seen.
TEST_P(PanelDepthAccuracy, ACardHidesAWallWhereItIsAndNotWhereItWas)
{
	const Situation now = bench().situation(0, 0, 2);
	Facet card = wall(now, 0.6, 0, 0);
	card.halfWide = 0.12, card.halfHigh = 0.1;
	Textures textures(bench(), width, height);
	const Drawn drawn = draw(now, {wall(now, 2.5, 0.3, 0), card}, 0, {-0.04, 0.015, 0}, true, 1);
	const PanelReadings readings = render(now, textures, drawn);
	// Away from edges by more than what lies between the colours: they are all as far away as green.
	constexpr double margin = 12;
	const auto kindOf = [&](int eye, const Vector2d &pixel) -> std::optional<SceneTexel> {
		const auto here = seen(now, drawn, eye, 1, pixel);
		for (const Vector2d &off : {Vector2d(margin, 0), Vector2d(-margin, 0), Vector2d(0, margin), Vector2d(0, -margin)}) {
			const auto there = seen(now, drawn, eye, 1, pixel + off);
			if (!here || !there || there->facet != here->facet || there->drawn != here->drawn) return std::nullopt;
		}
		return here;
	};
	for (const size_t facet : {0, 1}) {
		const Mapping mapping = [&](int eye, int channel, const Vector2d &pixel) -> std::optional<Vector2d> {
			const auto kind = kindOf(eye, pixel);
			if (!kind || kind->facet != facet || !kind->drawn) return std::nullopt;
			const auto place = seen(now, drawn, eye, channel, pixel);
			return place ? std::optional(place->texel) : std::nullopt;
		};
		judge(facet == 1 ? "with depth: card at 0.6 m" : "with depth: wall behind it",
			  bench().compare(readings, mapping, width, height, 24), 0.05);
	}
	// Where the picture has nothing.
	int holes = 0, cards = 0;
	for (uint32_t y = 1; y < 800; y += 2)
		for (uint32_t x = 1; x < 1280; x += 2) {
			const Vector2d pixel(x + 0.5, y + 0.5);
			const int eye = x < 640 ? 0 : 1;
			const auto place = seen(now, drawn, eye, 1, pixel);
			if (!place || place->drawn) continue;
			++holes;
			const PanelReadings::Reading shown = readings.at(x, y, 1);
			cards += inverseDistance(drawn.pictures[size_t(eye)], drawn.facets, shown.column + 0.5, shown.row + 0.5) > 1;
		}
	std::printf("[ FIGURE   ] %-10s of %d places that the view did not see, %d show the card instead of the wall\n", GetParam().name, holes,
				cards);
	EXPECT_GT(holes, 500);
	EXPECT_LT(cards, holes / 10) << "half a texel at the edge";
}

INSTANTIATE_TEST_SUITE_P(Lenses, PanelDepthAccuracy, testing::Values(LensChoice{"spline", true}),
						 [](const auto &choice) { return std::string(choice.param.name); });

} // namespace
