// The compositor's inside: what its thread owns, and what others hand to it under a lock.
#pragma once
#include "runtime/compositor/camera_fade.h"
#include "runtime/compositor/compositor.h"
#include <future>
#include <map>

namespace arift
{

class Compositor::Loop
{
public:
	Loop(const Surroundings &surroundings, const Pacer &pacer, std::unique_ptr<Panel> panel);

	struct ImageChange {
		uint64_t key = 0;
		VkImage image = VK_NULL_HANDLE; ///< null: remove
		gpu::ImageSpec spec;
		std::shared_ptr<const void> owner;
	};
	struct Wanted {
		ipc::PictureKind kind;
		std::promise<Picture> promise;
	};
	/// What other threads hand over.
	struct Inbox {
		std::vector<ImageChange> imageChanges;
		std::vector<std::shared_ptr<FrameSource>> sources;
		std::vector<Wanted> wanted;
		double passthroughDistance = 2;
	};
	struct Report {
		FrameRecord record;
		double cpuAtReset = 0;
		std::optional<End> end;
	};
	Guarded<Inbox> inbox{};
	Guarded<Report> report{};

	void run(std::stop_token stop);

private:
	using Sources = std::vector<std::shared_ptr<FrameSource>>;
	using Contents = std::vector<std::shared_ptr<const FrameContent>>;

	void changeImages(std::vector<ImageChange> changes);
	Latched latch(const Sources &sources, Contents &contents);
	void publishTiming(const Pacer::Refresh &refresh);
	/// The refresh to compose for once the work for `refresh` is done.
	Pacer::Refresh after(const Pacer::Refresh &refresh) const;
	void wake(const Sources &sources, const Pacer::Refresh &refresh);
	void record(const PanelInputs &inputs, const MotionSample &newest, XrTime display, XrDuration cost);
	void hand(std::vector<Wanted> wanted, const PanelInputs &inputs, XrTime display);
	bool frame(const Pacer::Refresh &refresh);

	const Surroundings surroundings_;
	Pacer pacer_;
	std::unique_ptr<Panel> panel_;
	std::map<uint64_t, std::shared_ptr<const void>> images_;
	ipc::ViewTable views_{};
	CameraFade fade_;
	XrTime lastDisplay_ = 0;
	bool stepped_;
};

/// CPU time of the whole process, seconds.
double processSeconds();

} // namespace arift
