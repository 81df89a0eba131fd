// One xrEndFrame, validated: the message for the compositor, the images it names and the work that must be finished first.
#pragma once
#include "runtime/openxr/space.h"

namespace arift::openxr
{

class Swapchain;

class FrameSubmission
{
public:
	/// Checks the whole request and changes nothing. Throws what xrEndFrame returns. OpenXR 1.1, "Frame Submission" and "Composition
	/// Layers".
	FrameSubmission(Session &session, const XrFrameEndInfo &info);
	/// Tells the swapchains in which submission their images are shown: submission.frame is set by now.
	void noteUse() const;

	ipc::Submission submission;
	std::vector<std::shared_ptr<Completion>> work;

private:
	struct Use {
		Swapchain *swapchain;
		uint32_t image;
	};
	/// What layers that stand somewhere have in common.
	struct Place {
		const char *what; ///< for messages
		XrCompositionLayerFlags flags;
		XrEyeVisibility eyes;
		XrSpace space;
		XrPosef pose;
		XrSwapchainSubImage image;
		gpu::ImageKind kind = gpu::ImageKind::flat;
	};
	void addLayer(const XrCompositionLayerBaseHeader *header);
	/// What extensions say of layers of every kind.
	ipc::Layer layerWith(const void *next) const;
	void addProjection(const XrCompositionLayerProjection &projection);
	void addQuad(const XrCompositionLayerQuad &quad);
	void addPassthrough(const XrCompositionLayerPassthroughFB &passthrough);
	void addCube(const XrCompositionLayerCubeKHR &cube);
	template <typename Layer> void addCurved(const Layer &curved, ipc::LayerType type, const char *what);
	/// `layer`: its place is missing yet. One that has no place now or no extent is checked and left out.
	void addPlaced(ipc::Layer layer, const Place &place, bool hasExtent);
	void addDepth(ipc::LayerView &view, const void *next);
	/// Frame and pose of a layer in the message; nothing when its space has no place now and the layer is not shown.
	std::optional<XrPosef> place(ipc::Layer &layer, XrSpace space, const XrPosef &pose, const char *what);
	/// What a layer shows: an image of that kind.
	ipc::SubImage subImage(const XrSwapchainSubImage &image, gpu::ImageKind kind);

	Session &session_;
	Locator locator_;
	std::vector<Use> uses_;
};

} // namespace arift::openxr
