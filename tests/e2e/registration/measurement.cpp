#include "tests/e2e/registration/measurement.h"
#include "tests/gpu/reference/reference_camera.h"
#include "tests/gpu/reference/reference_motion.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace arift::e2e
{
namespace
{

constexpr double degree = M_PI / 180;
constexpr double angularRadius = 0.021; // of the red disc, tangent: eight panel pixels
constexpr double speedsUp = 0.4;        // seconds that the head needs to reach its rate
constexpr int limitSeconds = 240;       // real time, for one figure
constexpr int changeLimitSeconds = 1200;

/// In every direction all around, some above and below the horizon; each faced by a head that turns about the neck at its distance.
std::vector<Eigen::Vector3d> markerPlaces(double distance)
{
	std::vector<Eigen::Vector3d> places;
	for (int i = 0; i < 15; ++i) {
		constexpr std::array<double, 3> heights{0, 0.12, -0.12};
		reference::ConstantTurn turn;
		turn.rate = {0, 24 * i * degree, 0};
		places.push_back(turn.head(1).out(Eigen::Vector3d(0, heights[size_t(i % 3)], -1) * distance));
	}
	return places;
}

std::string configuration(const Scenario &scenario)
{
	std::ostringstream text;
	text << "[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"stepped\"\n[compositor]\ntarget = \"offscreen\"\n[synthetic]\n";
	if (!scenario.recording.empty())
		text << "motion = \"file\"\nmotion_file = '" << scenario.recording << "'\n";
	else if (scenario.degreesPerSecond == 0)
		text << "motion = \"rest\"\n";
	else
		text << "motion = \"constant\"\nrate = [0.0, " << scenario.degreesPerSecond << ", 0.0]\n";
	if (scenario.sensorErrors)
		text << "camera_jitter_ms = 1.0\n";
	else
		text << "tracker_noise = false\ntracker_quantisation = false\ngyro_bias = [0.0, 0.0, 0.0]\ncamera_noise = false\n";
	const Eigen::Vector3d neck = reference::ConstantTurn{}.pivotInHead - Eigen::Vector3d(0, 0, scenario.neckErrorMetres);
	text << "motion_delay = " << scenario.restSeconds << "\ntransfer_delay_ms = " << scenario.delayMs << "\nneck = [" << neck.x() << ", "
		 << neck.y() << ", " << neck.z() << "]\n";
	for (const Eigen::Vector3d &place : markerPlaces(scenario.distance))
		text << "[[synthetic.markers]]\nposition = [" << place.x() << ", " << place.y() << ", " << place.z()
			 << "]\nradius = " << scenario.distance * angularRadius << "\n";
	return text.str();
}

// The head rests at the world's origin when LOCAL space is made there: world and LOCAL are one.
std::vector<std::string> applicationArguments(const Scenario &scenario)
{
	std::vector<std::string> arguments{"--radius", std::to_string(scenario.distance * angularRadius)};
	for (const Eigen::Vector3d &place : markerPlaces(scenario.distance)) {
		arguments.push_back("--position");
		for (int axis = 0; axis < 3; ++axis) arguments.push_back(std::to_string(place[axis]));
	}
	return arguments;
}

reference::Lens rigLens()
{
	const reference::RigNumbers rig = reference::readRigNumbers(ARIFT_SOURCE_DIR "/calib/rigs/arift.toml");
	return rig.spline ? reference::Lens::spline(rig.eyeRelief) : reference::Lens::polynomial();
}

double quantile(std::vector<double> &values, double q)
{
	const auto at = values.begin() + std::ptrdiff_t(q * double(values.size() - 1) + 0.5);
	std::nth_element(values.begin(), at, values.end());
	return *at;
}

/// `figures` with those of the errors' distances from `origin`.
Figures figuresOf(const std::vector<Pair> &pairs, Figures figures, const Eigen::Vector2d &origin = Eigen::Vector2d::Zero())
{
	std::vector<double> errors;
	for (const Pair &pair : pairs) {
		errors.push_back((pair.error - origin).norm());
		figures.mean += pair.error - origin;
	}
	figures.samples = errors.size();
	if (errors.empty()) return figures;
	figures.mean /= double(errors.size());
	figures.median = quantile(errors, 0.5);
	figures.p99 = quantile(errors, 0.99);
	figures.largest = quantile(errors, 1);
	return figures;
}

/// A marker that the camera's fading border dims would be found beside its place: only those as bright as the brightest count.
void dropFaded(std::vector<Pair> &pairs)
{
	double brightest = 0;
	for (const Pair &pair : pairs) brightest = std::max(brightest, pair.real.peak);
	std::erase_if(pairs, [&](const Pair &pair) { return pair.real.peak < 0.97 * brightest; });
}

} // namespace

Measurement::Measurement(const Scenario &scenario)
	: scenario_(scenario),
	  lens_(rigLens()),
	  service_(configuration(scenario)),
	  application_(service_.start("pinned_marker", applicationArguments(scenario)))
{
}

void Measurement::apply(const Setting &setting)
{
	service_.set(ipc::Setting::viewOffset, float(setting.viewOffset));
	service_.set(ipc::Setting::passthroughDistance, float(setting.passthroughDistance));
}

PanelPicture Measurement::nextPicture(XrTime from, std::chrono::steady_clock::time_point deadline)
{
	for (;;) {
		if (!application_.running()) throw std::runtime_error("pinned_marker ended: " + application_.output());
		if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("too few pictures with holograms in the time given");
		PanelPicture picture = service_.screenshot();
		if (picture.displayTime == newest_) continue;
		newest_ = picture.displayTime;
		if (started_ == 0) started_ = newest_;
		if (newest_ >= from) return picture;
	}
}

bool Measurement::showsHolograms(const PanelPicture &picture) const
{
	return !findSpots(picture, lens_, 0, 2).empty() || !findSpots(picture, lens_, 1, 2).empty();
}

Figures Measurement::measure(const Setting &setting, size_t pictures)
{
	apply(setting);
	const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(limitSeconds);
	// Until holograms are there, and a few frames after settings have changed, nothing counts; nor while the head speeds up.
	XrTime from = last_.rgba.empty() ? 0 : newest_ + fromSeconds(0.1);
	while (from == 0)
		if (showsHolograms(nextPicture(0, deadline))) from = newest_ + fromSeconds(scenario_.restSeconds + speedsUp);
	std::vector<Pair> pairs;
	Figures figures;
	for (; figures.pictures < pictures; ++figures.pictures) {
		last_ = nextPicture(from, deadline);
		look(last_, setting, pairs, figures.lonely);
	}
	dropFaded(pairs);
	return figuresOf(pairs, figures);
}

Figures Measurement::measureChange(const Setting &setting, double seconds)
{
	apply(setting);
	const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(changeLimitSeconds);
	nextPicture(0, deadline);
	const XrTime moves = started_ + fromSeconds(scenario_.restSeconds);
	std::vector<Pair> before, after;
	Figures figures;
	last_ = nextPicture(moves - fromSeconds(0.5), deadline);
	for (; newest_ < moves; last_ = nextPicture(0, deadline)) look(last_, setting, before, figures.lonely);
	dropFaded(before);
	if (before.empty()) throw std::runtime_error("no hologram was seen before the head moved");
	for (; newest_ < moves + fromSeconds(seconds); last_ = nextPicture(0, deadline), ++figures.pictures)
		look(last_, setting, after, figures.lonely);
	dropFaded(after);
	return figuresOf(after, figures, figuresOf(before, {}).mean);
}

void Measurement::look(const PanelPicture &picture, const Setting &setting, std::vector<Pair> &pairs, size_t &lonely) const
{
	for (int eye = 0; eye < 2; ++eye) {
		const std::vector<Spot> holograms = findSpots(picture, lens_, eye, 2);
		std::vector<Spot> real = findSpots(picture, lens_, eye, 0);
		if (setting.withinTangent) std::erase_if(real, [&](const Spot &spot) { return spot.tangents.norm() > *setting.withinTangent; });
		for (Pair &pair : pairSpots(lens_, eye, real, holograms, 0.2, lonely)) pairs.push_back(pair);
	}
}

void Measurement::keepPicture(const std::filesystem::path &file) const
{
	std::ofstream out(file, std::ios::binary);
	out << "P6\n" << last_.width << " " << last_.height << "\n255\n";
	for (size_t i = 0; i < last_.rgba.size(); i += 4) out.write(reinterpret_cast<const char *>(&last_.rgba[i]), 3);
}

} // namespace arift::e2e
