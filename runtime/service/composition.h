// What is lost with a GPU and made anew as a whole: the device, what draws on it, and the compositor's thread.
#pragma once
#include "runtime/compositor/compositor.h"
#include "runtime/service/world.h"

namespace arift
{

/// Shared: a client keeps the one that its images lie in until it has let go of them, a camera the one whose memory it fills, long after
/// another has taken its place.
class Composition
{
public:
	/// What a composition draws for; all of it must outlive it.
	struct Purpose {
		const Config &config;
		const Rig &rig;
		bool window = false; ///< asked for, by the configuration or by a display that is there
		bool again = false;  ///< another one was lost: a window that cannot be had any more is no reason to show nothing
	};
	/// Opens the device. Throws std::runtime_error with a sentence, as every call here does.
	explicit Composition(const Purpose &purpose);
	~Composition();
	Composition(const Composition &) = delete;

	/// Makes the pipelines: a second on a software renderer.
	void makeRenderer();
	/// Opens the target and starts the thread. After makeRenderer().
	void start(const Surroundings &surroundings);
	/// Ends the thread; from here on what was given to start() may go.
	void stop() { compositor_.reset(); }

	gpu::Device &device() { return device_; }
	/// Null before start().
	Compositor *compositor() { return compositor_.get(); }

private:
	std::unique_ptr<Target> makeTarget(Clock &clock);

	const Purpose purpose_;
	gpu::Device device_;
	std::unique_ptr<PanelRenderer> renderer_;
	std::unique_ptr<Compositor> compositor_;
};

/// Whether a window is wanted: by configuration, or because there is a display.
bool wantsWindow(const Config &config);

} // namespace arift
