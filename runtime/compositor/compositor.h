// The thread that makes one panel image per refresh: latches the newest of everything, wakes applications for the refresh after, draws,
// presents, keeps the record.
#pragma once
#include "runtime/compositor/assemble.h"
#include "runtime/compositor/camera_feed.h"
#include "runtime/compositor/frame_record.h"
#include "runtime/compositor/frame_source.h"
#include "runtime/compositor/panel.h"
#include "runtime/ipc/messages.h"
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace arift
{

class Trace;

/// Everything the compositor works with; all of it must outlive it.
struct Surroundings {
	Clock &clock;
	const Rig &rig;
	PoseHistory poses;
	ipc::SystemPage &page; ///< reads views; writes timing, and the clock where it is stepped
	std::array<CameraFeed *, 2> cameras{};
	Trace *trace = nullptr;             ///< null: none is wanted
	std::function<void()> threadBegins; ///< called first by the compositor's thread
	bool nearerOver = true;             ///< applications' layers by distance, else those of who began later over the others'
};

struct Picture {
	ReadbackImage image;
	XrTime displayTime = 0;
};

/// Every member is thread-safe. The thread starts with the object and ends with it, or by itself: see ended().
class Compositor
{
public:
	Compositor(const Surroundings &surroundings, const Pacer &pacer, std::unique_ptr<Panel> panel);
	~Compositor();
	Compositor(const Compositor &) = delete;

	/// An application's image. `owner` keeps it alive until the compositor has let go of it after removeImage().
	void addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec, std::shared_ptr<const void> owner,
				  const gpu::ImageRows &rows = {});
	/// Layers that show the image are left out from the next panel image on.
	void removeImage(uint64_t key);
	/// Sources are shown in the order in which they were added, the first at the bottom; adding one again moves it to the top.
	void addSource(std::shared_ptr<FrameSource> source);
	void removeSource(const FrameSource &source);

	void setPassthroughDistance(double metres);
	/// The cameras alone, whatever applications want shown.
	void setRawPassthrough(bool raw);
	bool rawPassthrough();
	/// The next panel image or both eyes of it. Nothing when it is not there within `limit` of real time.
	std::optional<Picture> picture(ipc::PictureKind kind, XrDuration limit);
	/// Since the last reset.
	FrameFigures figures(bool reset);
	/// How the thread ended, where it ended by itself: the target was closed, or the GPU was lost (with the reason).
	struct End {
		bool closed = false;
		std::string problem;
	};
	std::optional<End> ended();

private:
	class Loop;
	std::unique_ptr<Loop> loop_;
	std::jthread thread_;
};

} // namespace arift
