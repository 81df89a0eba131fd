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
	void addLayer(const XrCompositionLayerBaseHeader *header);
	void addProjection(const XrCompositionLayerProjection &projection);
	void addQuad(const XrCompositionLayerQuad &quad);
	/// Frame and pose of a layer in the message; nothing when its space has no place now and the layer is not shown.
	std::optional<XrPosef> place(ipc::Layer &layer, XrSpace space, const XrPosef &pose, const char *what);
	ipc::SubImage subImage(const XrSwapchainSubImage &image);

	Session &session_;
	Locator locator_;
	std::vector<Use> uses_;
};

} // namespace arift::openxr
