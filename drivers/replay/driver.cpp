#include "drivers/replay/driver.h"
#include "drivers/played_camera.h"
#include "drivers/replay/brd_file.h"
#include "drivers/replay/played_tracker.h"
#include "drivers/synthetic/images.h"
#include "runtime/base/toml_document.h"

namespace arift::replay
{

namespace
{

struct Settings {
	std::filesystem::path recording;
	bool loop = true;
};

Settings readSettings(TomlTable &table)
{
	Settings settings;
	if (table.has("recording")) settings.recording = table.path("recording");
	settings.loop = table.boolean("loop", settings.loop);
	table.finish();
	return settings;
}

/// The layout does not say when an image arrived, nor how long it was exposed: readout and transfer of a camera of this kind.
constexpr XrDuration transferDelay = 15 * millisecond;

class RecordedImages final : public ImageSource
{
public:
	RecordedImages(XrTime start, RecordedCamera camera, XrDuration length, bool loop, uint32_t eye)
		: start_(start), camera_(std::move(camera)), length_(length), loop_(loop), eye_(eye)
	{
	}

	CameraInfo info() const override
	{
		return {.name = eye_ == 0 ? "Recorded left camera" : "Recorded right camera",
				.width = camera_.width,
				.height = camera_.height,
				.format = PixelFormat::grey8,
				.frameRate = camera_.frameRate,
				.linear = false};
	}

	std::optional<Timing> timing(uint64_t sequence) const override
	{
		const size_t count = camera_.images.size();
		if (!loop_ && sequence >= count) return std::nullopt;
		const XrTime time = start_ + XrDuration(sequence / count) * length_ + camera_.images[sequence % count].time;
		return Timing{.midExposure = time, .exposure = 0, .arrival = time + transferDelay};
	}

	bool make(uint64_t sequence, std::span<std::byte> pixels) override
	{
		const auto &file = camera_.images[sequence % camera_.images.size()].file;
		const bool isWhole = decodeImage(file, camera_.width, camera_.height, pixels);
		if (!isWhole) log::warning("{}: damaged image, dropped", file.string());
		return isWhole;
	}

private:
	const XrTime start_;
	const RecordedCamera camera_;
	const XrDuration length_;
	const bool loop_;
	const uint32_t eye_;
};

class EurocDriver final : public Driver
{
public:
	EurocDriver(const DriverContext &context, const Settings &settings)
		: clock_(context.clock), settings_(settings), recording_(readEuroc(settings.recording)), start_(context.clock.now())
	{
	}

	std::string name() const override { return fmt::format("recording {}", recording_.name); }

	std::unique_ptr<ImuTracker> openTracker() override
	{
		if (hasEnded(recording_.imu.back().time)) return nullptr;
		return std::make_unique<PlayedTracker>(clock_, start_,
											   ImuPlayback{.name = "Recorded IMU",
														   .samples = recording_.imu,
														   .length = recording_.length,
														   .rate = recording_.imuRate,
														   .loop = settings_.loop});
	}

	std::unique_ptr<Camera> openCamera(uint32_t eye, FrameAllocator allocate) override
	{
		if (eye >= recording_.cameras.size() || recording_.cameras[eye].images.empty()) return nullptr;
		if (hasEnded(recording_.cameras[eye].images.back().time + transferDelay)) return nullptr;
		auto images = std::make_unique<RecordedImages>(start_, recording_.cameras[eye], recording_.length, settings_.loop, eye);
		return std::make_unique<PlayedCamera>(clock_, std::move(images), allocate);
	}

private:
	/// What is played once is not there any more after the last that it gave.
	bool hasEnded(XrDuration last) const { return !settings_.loop && clock_.now() >= start_ + last; }

	Clock &clock_;
	const Settings settings_;
	const EurocRecording recording_;
	const XrTime start_;
};

/// The recorded pose at a time since the start; the derivatives stay zero, for the IMU is recorded too.
class ReferenceMotion final : public synthetic::HeadMotion
{
public:
	ReferenceMotion(Trajectory trajectory, double length, bool loop) : trajectory_(std::move(trajectory)), length_(length), loop_(loop) {}

	synthetic::HeadState at(double seconds) const override
	{
		const double time = loop_ && seconds > 0 ? std::fmod(seconds, length_) : seconds;
		const TimedPose pose = interpolate(trajectory_, time);
		return {pose.orientation, pose.position, {}, {}, {}};
	}

private:
	const Trajectory trajectory_;
	const double length_;
	const bool loop_;
};

class BrdDriver final : public Driver
{
public:
	BrdDriver(const DriverContext &context, const Settings &settings)
		: context_(context),
		  settings_(settings),
		  cameras_(synthetic::readSettings(context.configuration)),
		  recording_(readBrd(settings.recording)),
		  imuInHead_(imuInHead(recording_)),
		  length_(fromSeconds(recording_.records.back().seconds + 1 / recording_.rate))
	{
		auto world = std::make_shared<synthetic::World>();
		world->start = context.clock.now();
		world->motion = std::make_shared<ReferenceMotion>(headTrajectory(recording_, imuInHead_), inSeconds(length_), settings.loop);
		world_ = std::move(world);
	}

	std::string name() const override { return fmt::format("recording {}", recording_.name); }

	/// Samples are turned into the axes of the tracker that the Rig describes.
	std::unique_ptr<ImuTracker> openTracker() override
	{
		if (!settings_.loop && context_.clock.now() >= world_->start + fromSeconds(recording_.records.back().seconds)) return nullptr;
		const glm::dquat turn = glm::conjugate(toGlm(context_.imuInHead.orientation)) * imuInHead_;
		ImuPlayback playback{.name = fmt::format("Recorded IMU of {}", recording_.name),
							 .samples = {},
							 .length = length_,
							 .rate = recording_.rate,
							 .loop = settings_.loop};
		for (const BrdRecord &record : recording_.records)
			playback.samples.push_back({fromSeconds(record.seconds), turn * record.angularVelocity, turn * record.acceleration});
		return std::make_unique<PlayedTracker>(context_.clock, world_->start, std::move(playback));
	}

	std::unique_ptr<Camera> openCamera(uint32_t eye, FrameAllocator allocate) override
	{
		if (eye >= context_.geometry.size() || context_.geometry[eye].rays.empty()) return nullptr;
		if (!scene_) scene_ = std::make_shared<const synthetic::Scene>(synthetic::makeRoom());
		auto images = std::make_unique<synthetic::SyntheticImages>(world_, scene_, cameras_, context_.geometry[eye], eye);
		return std::make_unique<PlayedCamera>(context_.clock, std::move(images), allocate);
	}

private:
	const DriverContext context_;
	const Settings settings_;
	const synthetic::Settings cameras_;
	const BrdRecording recording_;
	const glm::dquat imuInHead_;
	const XrDuration length_;
	std::shared_ptr<const synthetic::World> world_;
	std::shared_ptr<const synthetic::Scene> scene_;
};

} // namespace

void checkSettings(const std::shared_ptr<const TomlDocument> &configuration)
{
	TomlTable table = rootOf(configuration).table("replay");
	readSettings(table);
}

std::unique_ptr<Driver> makeDriver(const DriverContext &context)
{
	TomlTable table = rootOf(context.configuration).table("replay");
	const Settings settings = readSettings(table);
	if (!std::filesystem::exists(settings.recording)) table.complain("recording", "an existing folder in the EuRoC layout, or a .brd file");
	if (std::filesystem::is_directory(settings.recording)) return std::make_unique<EurocDriver>(context, settings);
	return std::make_unique<BrdDriver>(context, settings);
}

} // namespace arift::replay
