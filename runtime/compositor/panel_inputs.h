// Everything one panel image is made of, decided before any drawing begins. Plain values: the renderer asks nobody else.
#pragma once
#include "runtime/base/chroma_key.h"
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

/// How far away what a view shows is: 1 / distance ahead of it (metres) = inverseBias + inverseScale * value in the image.
struct ViewDepth {
	LayerTexture texture; ///< over its rectangle as the colours over theirs
	float inverseBias = 0, inverseScale = 0;
	/// Metres: outside, the layer's depth test lets everything through; testedTo 0: there is no such end.
	float testedFrom = 0, testedTo = 0;
};
/// One layer as one eye sees it.
struct ProjectionView {
	XrPosef viewInFrame; ///< the pose it was drawn for
	XrFovf fov;
	LayerTexture texture;
	std::optional<ViewDepth> depth = std::nullopt;
};
struct QuadView {
	XrPosef quadInFrame; ///< centre; x right, y up, faces +z
	XrExtent2Df size;    ///< metres
	LayerTexture texture;
};
/// What a layer's image lies on. Flat: a plane, that of a projection view or a quad. Deep: where a projection view's depth says.
enum class Surface : uint32_t { none, flat, cylinder, sphere, cube, deep };
/// Seen from inside. Angles are those to the right and up from -z; of a cylinder, whose axis is y, heights in radii stand for angles up.
struct CurvedView {
	Surface surface = Surface::cylinder;
	XrPosef centreInFrame;
	float radius = 0;                  ///< metres; 0: infinitely far away
	XrVector2f uvAhead{}, uvPerUnit{}; ///< texture coordinates, 0..1 over the rectangle, straight ahead, and per radian or radius
	LayerTexture texture;
};
/// Infinitely far away. A direction is looked up as graphics APIs look up cube maps, x to its right and y up.
struct CubeView {
	XrQuaternionf orientationInFrame;
	LayerTexture texture; ///< arrayIndex counts cubes
};
/// XR_FB_composition_layer_alpha_blend: what a layer's colour and alpha, and those of what is below it, are multiplied by.
struct BlendFactors {
	XrBlendFactorFB sourceColor, keptColor, sourceAlpha, keptAlpha;
};
/// XR_FB_composition_layer_depth_test, XR_VARJO_composition_layer_depth_test: a layer is seen or not by how far away it is there, and how
/// far away what was drawn with such a test is: infinitely at first. A projection view without depth is not tested.
struct DepthTest {
	VkCompareOp compare = VK_COMPARE_OP_ALWAYS; ///< the layer's distance, and the one that is there
	bool writes = false;                        ///< where it is seen, its distance is there from then on
};
struct KeyedOut {
	ChromaKey key;
	float opacity = 1; ///< of what stays
};
/// How a passthrough layer shows the cameras' image. XR_FB_passthrough: XrPassthroughStyleFB and what may be chained to it.
struct PassthroughStyle {
	float opacity = 1;
	XrColor4f edge{0, 0, 0, 0};                         ///< linear, not multiplied by its alpha
	float brightness = 0, contrast = 1, saturation = 1; ///< in CIELAB
	std::optional<LayerTexture> map;                    ///< one row: sRGB encoded RGBA by luma

	bool isChanged() const { return brightness != 0 || contrast != 1 || saturation != 1 || edge.a > 0 || map; }
};
struct PanelLayer {
	bool headLocked = false; ///< its frame is the head at the line's time, else the origin
	XrCompositionLayerFlags flags = 0;
	XrColor4f colorScale{1, 1, 1, 1}, colorBias{0, 0, 0, 0}; ///< of straight colour, before blending
	std::optional<BlendFactors> factors;                     ///< instead of those that the flags stand for
	std::optional<DepthTest> depthTest;
	/// Per eye: one of these, or nothing.
	std::array<std::optional<ProjectionView>, 2> projection;
	std::array<std::optional<QuadView>, 2> quad;
	std::array<std::optional<CurvedView>, 2> curved;
	std::array<std::optional<CubeView>, 2> cube;
	std::optional<KeyedOut> key;
	/// Instead of all that: the cameras' image over what is below.
	std::optional<PassthroughStyle> passthrough;

	/// Whether its image's alpha counts.
	bool hasAlpha() const { return factors || (flags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT); }
	/// Whether its image's colours are not yet multiplied by that.
	bool isStraight() const { return hasAlpha() && (flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT); }
	/// Whether it hides what is below it wherever it is.
	bool isOpaque() const { return !hasAlpha() && !key; }
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
