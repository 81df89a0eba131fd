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
	std::string recording;       ///< a file whose motion, translation too, the head follows instead; empty: none
	double delayMs = 40;         ///< from the end of a camera's exposure until the host has its image
	/// The tracker's noise, quantisation and bias, the cameras' noise, and 1 ms (standard deviation) of error in their time stamps.
	bool sensorErrors = false;
	double restSeconds = 0.3;   ///< before the head moves
	double neckErrorMetres = 0; ///< what the runtime believes the neck to be longer than it is
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
	/// How far holograms stray from the things that they are pinned to: the change of the registration error, in panel pixels, from the
	/// last half second before the head moves to every moment of the `seconds` of simulated time that follow. Throws as measure() does.
	Figures measureChange(const Setting &setting, double seconds);
	/// Keeps the last picture looked at as a PPM file.
	void keepPicture(const std::filesystem::path &file) const;

private:
	void apply(const Setting &setting);
	/// The next picture that differs from the last and is not shown before `from`.
	PanelPicture nextPicture(XrTime from, std::chrono::steady_clock::time_point deadline);
	bool showsHolograms(const PanelPicture &picture) const;
	void look(const PanelPicture &picture, const Setting &setting, std::vector<Pair> &pairs, size_t &lonely) const;

	Scenario scenario_;
	reference::Lens lens_;
	PrivateService service_;
	ChildProcess application_;
	XrTime started_ = 0, newest_ = 0; ///< of the first and the last picture taken
	PanelPicture last_;               ///< the last one looked at
};

} // namespace arift::e2e
