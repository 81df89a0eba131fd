// One registration measurement: a service on the synthetic headset, an application with holograms pinned to real markers, panel pictures.
#pragma once
#include "tests/e2e/registration/blob_fit.h"
#include <optional>

namespace arift::e2e
{

/// What the simulated world is like while it is measured.
struct Scenario {
	double distance = 2;         ///< metres from the head to a marker that it faces
	double degreesPerSecond = 0; ///< the head turns to the left about the neck
	std::string motion;          ///< another [synthetic] motion than "rest" and "constant"; empty: one of these
	double delayMs = 40;         ///< from the end of a camera's exposure until the host has its image
};

/// What can be changed while it runs.
struct Setting {
	double viewOffset = 1;
	double passthroughDistance = 2;
	/// Count markers within this tangent of the eye's axis only: elsewhere a marker is not at its nominal depth.
	std::optional<double> withinTangent;
};

struct Figures {
	double median = 0, p99 = 0, largest = 0;        ///< panel pixels
	Eigen::Vector2d mean = Eigen::Vector2d::Zero(); ///< panel pixels, right and down
	size_t samples = 0, pictures = 0;
	size_t lonely = 0; ///< markers without a hologram near them
};

/// A running service and application for one scenario.
class Measurement
{
public:
	explicit Measurement(const Scenario &scenario);
	/// Takes pictures until `pictures` different ones have been looked at. Throws std::runtime_error where they do not come.
	Figures measure(const Setting &setting, size_t pictures);
	/// Keeps the last picture looked at as a PPM file.
	void keepPicture(const std::filesystem::path &file) const;

private:
	void look(const PanelPicture &picture, const Setting &setting, std::vector<Pair> &pairs, size_t &lonely) const;

	Scenario scenario_;
	reference::Lens lens_;
	PrivateService service_;
	ChildProcess application_;
	PanelPicture last_;
};

} // namespace arift::e2e
