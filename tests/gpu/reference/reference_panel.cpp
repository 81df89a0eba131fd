#include "tests/gpu/reference/reference_panel.h"
#include <algorithm>
#include <cmath>

namespace arift::reference
{

Window fieldOfView(int eye, double eyeRelief)
{
	// LibOVR 0.4: the lens' rim (radius 17.5 mm) seen by the pupil, looking ahead and turned by 30 degrees (eyeball radius 13.5 mm).
	const double relief = std::max(eyeRelief, 0.006), decentred = -(0.064 - 0.0635) / 2;
	const double forward = relief + 0.0135 * (1 - std::cos(M_PI / 6)), sideways = 0.0135 * std::sin(M_PI / 6) + 0.001;
	const auto rim = [&](double radius) { return std::max(radius / relief, (radius + sideways) / forward); };
	const double outer = rim(0.0175 + decentred), inner = rim(0.0175 - decentred), vertical = rim(0.0175);
	// What the panel's half can show at all.
	const Lens lens = Lens::spline(eyeRelief);
	const double innerEdge = lens.tangents(0, 1, {640, 400}).x(), outerEdge = -lens.tangents(0, 1, {0, 400}).x();
	const double top = lens.tangents(0, 1, {Lens::axis(0).x(), 0}).y();
	const double out = std::min(outer, outerEdge), in = std::min(inner, innerEdge), high = std::min(vertical, top);
	return eye == 0 ? Window{-out, in, high, -high} : Window{-in, out, high, -high};
}

namespace
{

/// Where a point in a picture's frame lies in it.
std::optional<Eigen::Vector2d> projected(const ProjectionPicture &picture, const Eigen::Vector3d &point)
{
	const Eigen::Vector3d q = picture.viewInFrame.in(point);
	if (q.z() >= 0) return std::nullopt;
	const Eigen::Vector2d t(q.x() / -q.z(), q.y() / -q.z());
	if (!picture.window.holds(t)) return std::nullopt;
	const Window &w = picture.window;
	return Eigen::Vector2d((t.x() - w.left) / (w.right - w.left) * picture.width - 0.5,
						   (w.up - t.y()) / (w.up - w.down) * picture.height - 0.5);
}

} // namespace

std::optional<Met> firstMet(std::span<const Facet> facets, const Eigen::Vector3d &from, const Eigen::Vector3d &direction)
{
	std::optional<Met> first;
	for (size_t i = 0; i < facets.size(); ++i) {
		const Eigen::Vector3d start = facets[i].inFrame.in(from), ray = facets[i].inFrame.turn.conjugate() * direction;
		const double along = -start.z() / ray.z();
		if (!(along > 0) || (first && first->along <= along)) continue;
		const Eigen::Vector3d hit = start + along * ray;
		if (std::abs(hit.x()) <= facets[i].halfWide && std::abs(hit.y()) <= facets[i].halfHigh) first = Met{i, along};
	}
	return first;
}

double inverseDistance(const ProjectionPicture &picture, std::span<const Facet> facets, double column, double row)
{
	const Window &w = picture.window;
	const Eigen::Vector3d ray(w.left + column / picture.width * (w.right - w.left), w.up - row / picture.height * (w.up - w.down), -1);
	const auto met = firstMet(facets, picture.viewInFrame.place, picture.viewInFrame.turn * ray);
	return met ? 1 / met->along : 0;
}

Placement Situation::view(int eye, double time) const
{
	const Placement atEye = motion.head(time).holding(eyeInHead[size_t(eye)]);
	return {atEye.turn, atEye.place + (camera(eye).place - atEye.place) * viewOffset};
}

std::optional<Eigen::Vector3d> Situation::passthroughPoint(int eye, double time, const Eigen::Vector2d &tangents) const
{
	const Placement seen = view(eye, time), other = view(1 - eye, time);
	const Eigen::Vector3d middle = (seen.place + other.place) / 2;
	const Eigen::Vector3d ahead = motion.head(time).turn * -Eigen::Vector3d::UnitZ();
	const Eigen::Vector3d ray = seen.turn * Eigen::Vector3d(tangents.x(), tangents.y(), -1);
	const double along = (passthroughDistance - (seen.place - middle).dot(ahead)) / ray.dot(ahead);
	if (!(along > 0)) return std::nullopt;
	return Eigen::Vector3d(seen.place + ray * along);
}

std::optional<Eigen::Vector2d> PanelReference::cameraTexel(const Situation &now, int eye, int channel, const Eigen::Vector2d &pixel) const
{
	const auto point = now.passthroughPoint(eye, Situation::timeAt(pixel.y()), lens_.tangents(eye, channel, pixel));
	if (!point) return std::nullopt;
	return cameras_[size_t(eye)].see(now.camera(eye).in(*point));
}

std::optional<Eigen::Vector2d> PanelReference::projectionTexel(const Situation &now, const ProjectionPicture &picture, bool headLocked,
															   int eye, int channel, const Eigen::Vector2d &pixel) const
{
	const double time = Situation::timeAt(pixel.y());
	const auto point = now.passthroughPoint(eye, time, lens_.tangents(eye, channel, pixel));
	if (!point) return std::nullopt;
	return projected(picture, headLocked ? now.motion.head(time).in(*point) : *point);
}

std::optional<SceneTexel> PanelReference::sceneTexel(const Situation &now, const ProjectionPicture &picture, std::span<const Facet> facets,
													 bool headLocked, int eye, int channel, const Eigen::Vector2d &pixel) const
{
	const Ray ray = rayOf(now, headLocked, eye, channel, pixel);
	const auto met = firstMet(facets, ray.from, ray.direction);
	if (!met) return std::nullopt;
	const Eigen::Vector3d point = ray.from + met->along * ray.direction;
	const auto texel = projected(picture, point);
	if (!texel) return std::nullopt;
	const auto drawn = firstMet(facets, picture.viewInFrame.place, point - picture.viewInFrame.place);
	return SceneTexel{met->facet, *texel, drawn && drawn->facet == met->facet};
}

std::optional<Eigen::Vector2d> PanelReference::quadTexel(const Situation &now, const QuadPicture &picture, bool headLocked, int eye,
														 int channel, const Eigen::Vector2d &pixel) const
{
	const double time = Situation::timeAt(pixel.y());
	const Placement view = now.view(eye, time);
	const Eigen::Vector2d t = lens_.tangents(eye, channel, pixel);
	Eigen::Vector3d from = view.place, to = view.out(Eigen::Vector3d(t.x(), t.y(), -1));
	if (headLocked) {
		from = now.motion.head(time).in(from);
		to = now.motion.head(time).in(to);
	}
	from = picture.quadInFrame.in(from);
	to = picture.quadInFrame.in(to);
	if (from.z() <= 0 || to.z() >= from.z()) return std::nullopt; // behind it, or looking away
	const Eigen::Vector3d hit = from + (to - from) * (from.z() / (from.z() - to.z()));
	const double u = hit.x() / picture.metresWide + 0.5, v = 0.5 - hit.y() / picture.metresHigh;
	if (u < 0 || u > 1 || v < 0 || v > 1) return std::nullopt;
	return Eigen::Vector2d(u * picture.width - 0.5, v * picture.height - 0.5);
}

PanelReference::Ray PanelReference::rayOf(const Situation &now, bool headLocked, int eye, int channel, const Eigen::Vector2d &pixel) const
{
	const double time = Situation::timeAt(pixel.y());
	const Placement view = now.view(eye, time), head = headLocked ? now.motion.head(time) : Placement{};
	const Eigen::Vector2d t = lens_.tangents(eye, channel, pixel);
	return {head.in(view.place), head.turn.conjugate() * (view.turn * Eigen::Vector3d(t.x(), t.y(), -1).normalized())};
}

std::optional<Eigen::Vector2d> PanelReference::curvedTexel(const Situation &now, const CurvedPicture &picture, bool headLocked, int eye,
														   int channel, const Eigen::Vector2d &pixel) const
{
	const Ray ray = rayOf(now, headLocked, eye, channel, pixel);
	const bool sphere = picture.aspect == 0, endless = picture.radius == 0;
	const double radius = endless ? 1 : picture.radius;
	const Eigen::Vector3d from = endless ? Eigen::Vector3d(0, 0, 0) : picture.centreInFrame.in(ray.from);
	const Eigen::Vector3d direction = picture.centreInFrame.turn.conjugate() * ray.direction;
	// Along the part of the ray across a cylinder's axis: from the place nearest to it, half a chord further.
	Eigen::Vector3d across = direction, start = from;
	if (!sphere) across.y() = start.y() = 0;
	const double speed = across.norm(), nearest = -start.dot(across) / (speed * speed);
	const double offAxis = (start + nearest * across).norm();
	if (offAxis > radius) return std::nullopt;
	const double along = nearest + std::sqrt(radius * radius - offAxis * offAxis) / speed;
	if (along <= 0) return std::nullopt;
	const Eigen::Vector3d hit = from + along * direction;
	const double u = 0.5 + std::atan2(hit.x(), -hit.z()) / picture.across;
	const double v = sphere ? (picture.upper - std::asin(hit.y() / radius)) / (picture.upper - picture.lower)
							: 0.5 - hit.y() / (radius * picture.across / picture.aspect);
	if (u < 0 || u > 1 || v < 0 || v > 1) return std::nullopt;
	return Eigen::Vector2d(u * picture.width - 0.5, v * picture.height - 0.5);
}

CubeTexel PanelReference::cubeTexel(const Situation &now, const CubePicture &picture, bool headLocked, int eye, int channel,
									const Eigen::Vector2d &pixel) const
{
	const Eigen::Vector3d r = picture.turnInFrame.conjugate() * rayOf(now, headLocked, eye, channel, pixel).direction;
	int axis = 0;
	r.cwiseAbs().maxCoeff(&axis);
	const bool positive = r[axis] > 0;
	double s = 0, t = -r.y();
	if (axis == 0) s = positive ? -r.z() : r.z();
	if (axis == 1) s = r.x(), t = positive ? r.z() : -r.z();
	if (axis == 2) s = positive ? r.x() : -r.x();
	const double most = std::abs(r[axis]);
	return {2 * axis + (positive ? 0 : 1),
			Eigen::Vector2d((s / most + 1) / 2 * picture.size - 0.5, (t / most + 1) / 2 * picture.size - 0.5)};
}

} // namespace arift::reference
