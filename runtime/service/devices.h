// Which headset is used, and its devices as long as it is: what the configuration names, or what is plugged in.
#pragma once
#include "drivers/registry.h"
#include "runtime/base/guarded.h"
#include "runtime/service/headset.h"

namespace arift
{

class Devices
{
public:
	/// All of it must outlive it.
	struct Context {
		const Config &config;
		const Rig &rig;
		Clock &clock;
		PoseRing &poses;
		std::array<CameraFeed *, 2> feeds;
		std::function<void()> trackerBegins; ///< called first by the tracker's thread
		std::filesystem::path sysfs;         ///< where the kernel lists what is plugged in
	};
	/// Chooses the headset and opens nothing yet. Throws InputError.
	explicit Devices(Context context);
	~Devices();

	/// Opens what was chosen. Throws InputError.
	void open();

	/// For people: "synthetic headset".
	std::string name();
	/// Empty, or why there is no headset, in a sentence that says what to do.
	std::string problem();
	/// Looks what is plugged in; true when another headset, or none, has taken the place of the one that was.
	bool follow();
	/// "headset", "cameras" and "tracker" into `status`.
	void describe(nlohmann::json &status);

private:
	struct Open {
		std::string problem;
		std::unique_ptr<Driver> driver;   ///< null: there is a problem
		std::unique_ptr<Headset> headset; ///< null before it is opened
	};
	Open choose() const;
	void open(Open &chosen) const;

	const Context context_;
	std::optional<PluggedHeadset> plugged_;
	Guarded<Open> open_;
};

} // namespace arift
