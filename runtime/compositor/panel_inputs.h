// Everything one panel image is made of, decided before any drawing begins. Plain values: the renderer asks nobody else.
#pragma once
#include "runtime/base/pose.h"
#include "runtime/device/camera.h"
#include <array>
#include <optional>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace arift
{

/// An eye's newest camera image and where its camera was when it was exposed.
struct CameraView {
	CameraFrame frame;
	XrPosef cameraInOrigin; ///< at mid-exposure
	uint32_t lens = 0;      ///< index into Rig::cameras: 0 left, 1 right (the other eye's when one camera is lost)
	float weight = 1;       ///< 0..1: fades a replacement in
	// As in the camera's CameraInfo.
	double blackLevel = 0; ///< raw value of darkness, 0..1 of full scale
	std::array<float, 3> whiteBalance{1, 1, 1};
	bool linear = true; ///< else sRGB encoded
};

/// Where an eye's view stands when a panel line is seen.
struct ViewAtLine {
	XrPosef viewInOrigin;
	XrPosef headInOrigin;
};

struct LayerTexture {
	uint64_t image = 0; ///< key of an image the renderer has been told of (PanelRenderer::addImage)
	uint32_t arrayIndex = 0;
	XrRect2Di rect{};     ///< texels
	uint64_t content = 0; ///< another number when the image may have been drawn anew; 0: it may have been, every time
};

/// One layer as one eye sees it.
struct ProjectionView {
	XrPosef viewInFrame; ///< the pose it was drawn for
	XrFovf fov;
	LayerTexture texture;
};
struct QuadView {
	XrPosef quadInFrame; ///< centre; x right, y up, faces +z
	XrExtent2Df size;    ///< metres
	LayerTexture texture;
};
struct PanelLayer {
	bool headLocked = false; ///< its frame is the head at the line's time, else the origin
	XrCompositionLayerFlags flags = 0;
	/// Per eye: a projection view, a quad, or nothing.
	std::array<std::optional<ProjectionView>, 2> projection;
	std::array<std::optional<QuadView>, 2> quad;
};

struct PanelInputs {
	XrTime displayTime = 0; ///< of the middle line
	XrEnvironmentBlendMode blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	std::array<ViewAtLine, 2> top, bottom; ///< first and last line, per eye; lines between are interpolated
	std::array<std::optional<CameraView>, 2> cameras;
	double passthroughDistance = 2; ///< metres from the midpoint of both views, a plane perpendicular to the view
	std::vector<PanelLayer> layers; ///< bottom first
};

} // namespace arift
