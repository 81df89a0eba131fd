// The wire between an application and the service: one SOCK_SEQPACKET message each, fixed-width plain structs, no pointers.
// A connection starts with Hello / Welcome. Every request has exactly one reply of the same `sequence`.
// The frame channel (a second socket, one per session) carries WaitFrame / FrameReady and Submission.
#pragma once
#include "runtime/base/chroma_key.h"
#include "runtime/gpu/image_spec.h"
#include "runtime/ipc/pages.h"
#include <cstdint>
#include <openxr/openxr.h>

namespace arift::ipc
{

constexpr uint32_t magic = 0x54465241; // "ARFT"
constexpr uint32_t protocol = 8;       // raised with every change of this file, of pages.h or of PoseRing
/// Real time in which the service has opened its devices and answers Hello and CreateSession: a second or two, much more on a machine that
/// is busy otherwise. Clients wait a little longer than this, so that they hear its reason.
constexpr XrDuration openingLimit = 60 * second;
constexpr uint32_t maxFds = 16;               // per message
constexpr uint32_t maxImages = 8;             // per swapchain
constexpr uint32_t maxArrayLayers = 64;       // per image, faces included
constexpr uint32_t maxLayers = 64;            // per submission
constexpr uint32_t maxFormats = 16;           // of swapchains
constexpr uint32_t maxPassthroughLayers = 16; // per session

enum class MessageType : uint32_t {
	// application or monitor -> service -> back
	hello = 1,
	welcome,
	createSession,
	sessionCreated,
	destroySession,
	sessionRunning, // begin and end
	createSwapchain,
	swapchainCreated,
	destroySwapchain,
	showPassthrough,
	stylePassthrough,
	done,   // the reply without content
	failed, // the reply to a request that could not be met
	// frame channel
	waitFrame = 100,
	frameReady,
	submission,
	relinquish,
	vibrate,
	// monitors
	getStatus = 200,
	status, // status: fd of a sealed memfd with JSON text
	screenshot,
	picture,    // picture: fd of a sealed memfd with RGBA8 rows
	setSetting, // reply: done or failed
	recenter,
	shutDown,
	forcePassthrough, // reply: done or failed
};

constexpr bool isForMonitors(MessageType type) { return type >= MessageType::getStatus; }

struct Header {
	MessageType type;
	uint32_t sequence = 0;
};

enum class Role : uint32_t { application, monitor };

/// How an application's images reach the service's GPU.
enum class Sharing : uint32_t {
	memory, ///< the service's own memory, imported into the application's device
	copies  ///< memory of the CPU, into which the application's GPU and out of which the service's copies (gpu::CopyLayout)
};

/// What comes before `role`, and Failed, stay as they are in every protocol: another protocol is refused with a sentence.
struct Hello {
	static constexpr MessageType type = MessageType::hello;
	Header header{type};
	uint32_t magic = ipc::magic;
	uint32_t protocol = ipc::protocol;
	char build[48]{}; ///< of the library: shown when protocols differ
	Role role = Role::application;
	uint32_t pid = 0;
	uint64_t apiVersion = 0; ///< XrVersion the application asked for
	char applicationName[128]{};
	char engineName[128]{};
};

/// fds: SystemPage, PoseRing, ClientPage (the last for applications only).
struct Welcome {
	static constexpr MessageType type = MessageType::welcome;
	Header header{type};
	uint32_t protocol = ipc::protocol;
	uint32_t reserved = 0;
	char build[48]{};
	char systemName[128]{};
	uint32_t recommendedWidth = 0, recommendedHeight = 0; ///< pixels per view
	uint32_t maxWidth = 0, maxHeight = 0;
	uint32_t maxLayers = ipc::maxLayers;
	uint32_t blendModeCount = 0;
	std::array<int32_t, 4> blendModes{}; ///< XrEnvironmentBlendMode in the runtime's order of preference
	uint32_t orientationTracking = 1, positionTracking = 0;
	std::array<uint8_t, 16> deviceUuid{}, driverUuid{}; ///< of the service's GPU
	uint32_t deviceType = 0;                            ///< VkPhysicalDeviceType
	uint32_t steppedClock = 0;
};

/// fds of the reply: the application's end of the frame channel; the probe, where there is one.
struct CreateSession {
	static constexpr MessageType type = MessageType::createSession;
	Header header{type};
	std::array<uint8_t, 16> deviceUuid{}, driverUuid{}; ///< of the application's GPU
	uint32_t headless = 0;
	uint32_t overlay = 0;   ///< XR_EXTX_overlay: 1 for a session that lies over the main one
	uint32_t placement = 0; ///< overlay: sessionLayersPlacement, the highest in front
	uint32_t hasDepth = 0;  ///< 1: XR_KHR_composition_layer_depth is enabled
};
struct SessionCreated {
	static constexpr MessageType type = MessageType::sessionCreated;
	Header header{type};
	uint32_t session = 0;
	Sharing sharing = Sharing::memory;         ///< copies: nothing is shared; memory: the application may ask for copies yet
	std::array<int32_t, maxFormats> formats{}; ///< VkFormats of swapchains, the service's favourite first; 0 behind the last
	/// Memory of the service's device that begins with these bytes: where a device that says it is the same reads others, its images are
	/// not to be shared. Size 0: there is none.
	uint64_t probeSize = 0;
	uint32_t probeTypeIndex = 0; ///< on the service's device
	uint32_t reserved = 0;
	std::array<uint8_t, 32> probePattern{};
};
struct DestroySession {
	static constexpr MessageType type = MessageType::destroySession;
	Header header{type};
	uint32_t session = 0;
	uint32_t reserved = 0;
};
struct SessionRunning {
	static constexpr MessageType type = MessageType::sessionRunning;
	Header header{type};
	uint32_t session = 0;
	uint32_t running = 0;
};

/// fds of the reply: one per image. Opaque memory, in which every image is clear and in its boundary layout, owned by
/// VK_QUEUE_FAMILY_EXTERNAL; or, for copies, a memfd in which gpu::copyLayoutOf(spec) says where its texels are.
struct CreateSwapchain {
	static constexpr MessageType type = MessageType::createSwapchain;
	Header header{type};
	uint32_t session = 0;
	uint32_t imageCount = 3;
	Sharing sharing = Sharing::memory;
	uint32_t reserved = 0;
	gpu::ImageSpec spec;
};
struct SwapchainCreated {
	static constexpr MessageType type = MessageType::swapchainCreated;
	Header header{type};
	uint32_t swapchain = 0;
	uint32_t imageCount = 0;
	uint64_t memorySize = 0;      ///< of each image: VkMemoryRequirements::size, or gpu::CopyLayout::size
	uint32_t memoryTypeIndex = 0; ///< on the service's device; of no meaning for copies
	uint32_t reserved = 0;
};
struct DestroySwapchain {
	static constexpr MessageType type = MessageType::destroySwapchain;
	Header header{type};
	uint32_t swapchain = 0;
	uint32_t reserved = 0;
};

// ---- XR_FB_passthrough: what holds from the reply on, for submissions that came before, too

/// Instead of a layer's number: the feature, without which none is shown.
constexpr uint32_t everyPassthroughLayer = maxPassthroughLayers;
struct ShowPassthrough {
	static constexpr MessageType type = MessageType::showPassthrough;
	Header header{type};
	uint32_t session = 0;
	uint32_t layer = 0; ///< the application numbers them
	uint32_t shown = 0;
	uint32_t reserved = 0;
};
struct StylePassthrough {
	static constexpr MessageType type = MessageType::stylePassthrough;
	Header header{type};
	uint32_t session = 0;
	uint32_t layer = 0;
	float opacity = 1;
	XrColor4f edge{0, 0, 0, 0};                         ///< linear, not multiplied by its alpha, which is 0 for none
	float brightness = 0, contrast = 1, saturation = 1; ///< in CIELAB
	uint32_t mapped = 0;                                ///< 1: luma is replaced by what `map` says, RGBA with sRGB encoded colours
	uint32_t reserved = 0;
	std::array<std::array<uint8_t, 4>, XR_PASSTHROUGH_COLOR_MAP_MONO_SIZE_FB> map{};
};

struct Done {
	static constexpr MessageType type = MessageType::done;
	Header header{type};
};
struct Failed {
	static constexpr MessageType type = MessageType::failed;
	Header header{type};
	int32_t result = XR_ERROR_RUNTIME_FAILURE; ///< XrResult
	uint32_t reserved = 0;
	char text[240]{};
};

// ---- frame channel: requests by the application, FrameReady by the service

struct WaitFrame {
	static constexpr MessageType type = MessageType::waitFrame;
	Header header{type};
};
struct FrameReady {
	static constexpr MessageType type = MessageType::frameReady;
	Header header{type};
	XrTime predictedDisplayTime = 0; ///< of the panel's middle line
	XrDuration predictedDisplayPeriod = 0;
	uint32_t shouldRender = 0;
	uint32_t reserved = 0;
};

struct SubImage {
	uint32_t swapchain = 0;
	uint32_t image = 0; ///< index in the swapchain: the one released last
	uint32_t arrayIndex = 0;
	int32_t x = 0, y = 0; ///< rectangle in texels, from the first one in memory
	int32_t width = 0, height = 0;
	uint32_t release = 0; ///< how often the image had been released: its content is the same while this is; 0: who knows
};
enum class LayerType : uint32_t { projection, quad, cylinder, equirect, cube, passthrough };
enum class LayerFrame : uint32_t { origin /**< fixed in the world */, head /**< moves with the head (VIEW space) */ };
/// XR_KHR_composition_layer_depth. 1 / distance ahead of the view (metres) = inverseBias + inverseScale * value in the image.
struct ViewDepth {
	SubImage image; ///< its swapchain is 0: there is no depth
	float inverseBias = 0, inverseScale = 0;
	float testedFrom = 0,
		  testedTo = 0; ///< metres: outside, the layer's depth test lets everything through; testedTo 0: there is no such end
};
struct LayerView {
	XrPosef pose = identityPose; ///< of the view in the layer's frame
	XrFovf fov{};
	SubImage image;
	ViewDepth depth;
};
/// The inside of a cylinder about y, or of a sphere. Texture coordinates are 0..1 over the image, its first row 0; angles to the right and
/// up from -z. Cylinder: v by height in radii; equirect: v by angle.
struct CurvedSurface {
	float radius = 0; ///< metres; 0: infinitely far
	XrVector2f uvAhead{0, 0}, uvPerUnit{0, 0};
};
/// XR_FB_composition_layer_alpha_blend: XrBlendFactorFB each.
struct BlendFactors {
	uint32_t given = 0; ///< 0: the layer's flags say how it is blended
	uint32_t sourceColor = 0, destinationColor = 0, sourceAlpha = 0, destinationAlpha = 0;
};
/// XR_FB_composition_layer_depth_test, XR_VARJO_composition_layer_depth_test: against what was nearest so far.
struct DepthTest {
	uint32_t given = 0;     ///< 0: the layer is drawn over what is below
	uint32_t compareOp = 0; ///< XrCompareOpFB
	uint32_t writes = 0;    ///< 1: what passes is the nearest from then on
};
struct Layer {
	LayerType type = LayerType::projection;
	LayerFrame frame = LayerFrame::origin;
	uint32_t flags = 0;             ///< XrCompositionLayerFlags
	uint32_t eyes = 3;              ///< bit 0 left, bit 1 right
	std::array<LayerView, 2> views; ///< projection: both; else views[0].image and views[0].pose: the centre (cube: where it turns to;
									///< its image's arrayIndex counts cubes, its rectangle is a whole face)
	float width = 0, height = 0;    ///< quad: metres
	CurvedSurface curved;           ///< cylinder, equirect
	XrColor4f colorScale{1, 1, 1, 1}, colorBias{0, 0, 0, 0}; ///< of straight colour, before blending
	BlendFactors blend;
	DepthTest depthTest;
	uint32_t passthrough = 0; ///< passthrough: the layer's number, which is all that counts then
};
/// Sent when all work on the images it names is finished. Only the first `layerCount` layers are sent.
struct Submission {
	static constexpr MessageType type = MessageType::submission;
	Header header{type};
	uint64_t frame = 0; ///< counts the session's submissions from 1
	XrTime displayTime = 0;
	int32_t blendMode = 0; ///< XrEnvironmentBlendMode
	uint32_t layerCount = 0;
	uint32_t rowsGoUp = 0; ///< 1: the first row of the images in memory is the lowest one
	uint32_t reserved = 0;
	std::array<Layer, maxLayers> layers;
};
/// The application needs an image that is being shown: drop this and earlier submissions.
struct Relinquish {
	static constexpr MessageType type = MessageType::relinquish;
	Header header{type};
	uint64_t frame = 0;
};

/// What a gamepad's motors are to do from now on, for a minute at most, while the session has the focus. No reply.
struct Vibrate {
	static constexpr MessageType type = MessageType::vibrate;
	Header header{type};
	uint32_t motors = 0;      ///< bit 0 the left, strong one; bit 1 the right, weak one; others go on as they do
	float amplitude = 0;      ///< 0..1
	XrDuration duration = -1; ///< 0: stop; -1 (XR_MIN_HAPTIC_DURATION): as short as can be felt
};

// ---- monitors

struct GetStatus {
	static constexpr MessageType type = MessageType::getStatus;
	Header header{type};
	uint32_t resetFigures = 0; ///< start the record of frame figures anew after answering
	uint32_t reserved = 0;
};
struct Status {
	static constexpr MessageType type = MessageType::status;
	Header header{type};
	uint64_t size = 0; ///< bytes of JSON in the memfd
};
enum class PictureKind : uint32_t { panel, eyes /**< both views side by side before the lens correction */ };
struct Screenshot {
	static constexpr MessageType type = MessageType::screenshot;
	Header header{type};
	PictureKind kind = PictureKind::panel;
	uint32_t reserved = 0;
};
struct Picture {
	static constexpr MessageType type = MessageType::picture;
	Header header{type};
	uint32_t width = 0, height = 0; ///< RGBA8, sRGB encoded, rows without padding
	XrTime displayTime = 0;         ///< of the middle line
};
enum class Setting : uint32_t { viewOffset, passthroughDistance, rawPassthrough /**< not 0: the cameras alone, no holograms */ };
struct SetSetting {
	static constexpr MessageType type = MessageType::setSetting;
	Header header{type};
	Setting setting = Setting::viewOffset;
	float value = 0;
};
struct Recenter {
	static constexpr MessageType type = MessageType::recenter;
	Header header{type};
};
struct ShutDown {
	static constexpr MessageType type = MessageType::shutDown;
	Header header{type};
};

/// How the cameras' image is put behind an application that does not ask for it. Off: as the application wants it. Alpha: by its layers'
/// alpha, whatever it says of it. Chroma: where a layer has a colour. Underlay: where no layer is.
enum class Forced : uint32_t { off, alpha, chroma, underlay };
inline constexpr std::array forcedNames{"off", "alpha", "chroma", "underlay"}; ///< in its order
constexpr const char *nameOf(Forced mode) { return forcedNames.at(size_t(mode)); }
struct ForcePassthrough {
	static constexpr MessageType type = MessageType::forcePassthrough;
	Header header{type};
	char application[128]{}; ///< its name, whether or not it is connected
	Forced mode = Forced::off;
	float tolerance = ChromaKey().tolerance, softness = ChromaKey().softness; ///< of a chroma key, 0..1
	float opacity = 1;                                                        ///< of its layers
	std::array<float, 3> colour = ChromaKey().colour;
	uint32_t reserved = 0;
};

} // namespace arift::ipc
