// The compositor's inside: what its thread owns, and what others hand to it under a lock.
#pragma once
#include "runtime/base/frame_memory.h"
#include "runtime/base/trace.h"
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
		gpu::ImageRows rows;
		std::shared_ptr<const void> owner;
	};
	struct Wanted {
		ipc::PictureKind kind;
		std::promise<Picture> promise;
	};
	struct Settings {
		double passthroughDistance = 2; ///< metres
		bool rawPassthrough = false;    ///< the cameras alone: no application's layers
	};
	/// What other threads hand over.
	struct Inbox {
		std::vector<ImageChange> imageChanges;
		std::vector<std::shared_ptr<FrameSource>> sources;
		std::vector<Wanted> wanted;
		Settings settings;
	};
	struct Report {
		FrameRecord record;
		double cpuAtReset = 0;
		std::optional<End> end;
	};
	Guarded<Inbox> inbox{};
	Guarded<Report> report{};

	void run(const std::stop_token &stop);

private:
	using Sources = FrameVector<std::shared_ptr<FrameSource>>;
	using Contents = FrameVector<std::shared_ptr<const FrameContent>>;
	/// What becomes of one refresh, on its way from the inbox to the panel.
	struct Frame {
		Sources sources;
		Contents contents;
		std::vector<Wanted> wanted;
		Settings settings;
		PanelInputs inputs;
		MotionSample newest;
		StageTimes stages{};
		XrDuration cost = 0; ///< real
		uint32_t leftOut = 0;
		Target::Result result;
	};

	void changeImages(std::vector<ImageChange> changes);
	/// Takes over what others have handed in; says what images came and went.
	std::vector<ImageChange> take(Frame &frame);
	void latchLayers(Frame &frame, const XrPosef &head, Latched &latched) const;
	void publishTiming(const Pacer::Refresh &refresh);
	void wake(const Sources &sources, const Pacer::Refresh &refresh);
	void choose(const Pacer::Refresh &refresh, Frame &frame);
	void show(const Pacer::Refresh &refresh, Frame &frame);
	void record(const Frame &frame);
	void trace(const Frame &frame, XrTime realBegan);
	void hand(Frame &frame);
	XrDuration lateness(XrTime planned, XrTime now) const;
	bool frame(const Pacer::Refresh &refresh, XrTime planned);

	const Surroundings surroundings_;
	FrameMemory memory_{512 << 10};
	std::vector<PanelLayer> layers_; ///< between frames: empty, its memory is used again
	Pacer pacer_;
	std::unique_ptr<Panel> panel_;
	std::map<uint64_t, std::shared_ptr<const void>> images_;
	ipc::ViewTable views_{};
	CameraFade fade_;
	XrTime lastDisplay_ = 0;
	uint64_t frameNumber_ = 0;
	const double rate_; ///< of the clock; 0: stepped
};

/// CPU time of the whole process, seconds.
double processSeconds();

} // namespace arift
