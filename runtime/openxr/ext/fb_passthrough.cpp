#include "runtime/openxr/ext/fb_passthrough.h"
#include <cmath>

namespace arift::openxr
{
namespace
{

/// Layers and features show nothing from then on. Where the service is gone they do so anyway.
void hide(const Session &session, uint32_t layer)
{
	try {
		session.instance.service.ask<ipc::Done>(ipc::ShowPassthrough{.session = session.id(), .layer = layer});
	} catch (const std::exception &problem) {
		log::debug("passthrough: {}", problem.what());
	}
}

bool requireFlags(XrPassthroughFlagsFB flags)
{
	if (flags & ~(XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB | XR_PASSTHROUGH_LAYER_DEPTH_BIT_FB))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "the passthrough flags {:#x} have unknown bits", flags);
	if (flags & XR_PASSTHROUGH_LAYER_DEPTH_BIT_FB)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "passthrough has no depth, as XrSystemPassthroughProperties2FB::capabilities says");
	return flags & XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB;
}

/// Throws unless it is from 0 to `most`.
float required(const char *what, float value, float most)
{
	if (!(value >= 0 && value <= most)) throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is {}, not from 0 to {}", what, value, most);
	return value;
}

/// IEC 61966-2-1, as a byte.
uint8_t encoded(float linear)
{
	const double v = double(linear);
	return uint8_t(std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

XrColor4f required(const char *what, const XrColor4f &colour)
{
	return {required(what, colour.r, 1), required(what, colour.g, 1), required(what, colour.b, 1), required(what, colour.a, 1)};
}

void take(ipc::StylePassthrough &message, const XrPassthroughColorMapMonoToRgbaFB &map)
{
	message.mapped = 1;
	for (size_t i = 0; i < message.map.size(); ++i) {
		const XrColor4f colour = required("a colour in textureColorMap", map.textureColorMap[i]);
		message.map[i] = {encoded(colour.r), encoded(colour.g), encoded(colour.b), uint8_t(std::lround(colour.a * 255))};
	}
}

void take(ipc::StylePassthrough &message, const XrPassthroughColorMapMonoToMonoFB &map)
{
	message.mapped = 1;
	for (size_t i = 0; i < message.map.size(); ++i) {
		const uint8_t grey = map.textureColorMap[i];
		message.map[i] = {grey, grey, grey, 255};
	}
}

void take(ipc::StylePassthrough &message, const XrPassthroughBrightnessContrastSaturationFB &adjustment)
{
	if (!(std::abs(adjustment.brightness) <= 100))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "brightness is {}, not from -100 to 100", adjustment.brightness);
	message.brightness = adjustment.brightness;
	// There is no upper end but that of numbers.
	constexpr float most = 1e6f;
	message.contrast = std::min(required("contrast", adjustment.contrast, INFINITY), most);
	message.saturation = std::min(required("saturation", adjustment.saturation, INFINITY), most);
}

ipc::StylePassthrough styleOf(const XrPassthroughStyleFB &style)
{
	ipc::StylePassthrough message;
	message.opacity = required("textureOpacityFactor", style.textureOpacityFactor, 1);
	message.edge = required("edgeColor", style.edgeColor);
	int changes = 0;
	const auto takeIfThere = [&](const auto *change) {
		if (!change) return;
		take(message, *change);
		++changes;
	};
	takeIfThere(findInChain<XrPassthroughColorMapMonoToRgbaFB>(style.next));
	takeIfThere(findInChain<XrPassthroughColorMapMonoToMonoFB>(style.next));
	takeIfThere(findInChain<XrPassthroughBrightnessContrastSaturationFB>(style.next));
	if (changes > 1)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a style has {} colour maps and adjustments, at most one is allowed", changes);
	return message;
}

uint32_t takePlace(Session &session)
{
	std::optional<uint32_t> place;
	session.passthrough.update([&](PassthroughUse &use) { place = use.take(); });
	if (!place)
		throw Error(XR_ERROR_INSUFFICIENT_RESOURCES_PASSTHROUGH_FB, "the session has {} passthrough layers already",
					ipc::maxPassthroughLayers);
	return *place;
}

} // namespace

Passthrough::Passthrough(Session &owner, bool running) : session(owner)
{
	bool isFirst = false;
	session.passthrough.update([&](PassthroughUse &use) { isFirst = !std::exchange(use.hasFeature, true); });
	if (!isFirst) throw Error(XR_ERROR_FEATURE_ALREADY_CREATED_PASSTHROUGH_FB, "the session has its XrPassthroughFB already");
	try {
		run(running);
	} catch (...) {
		session.passthrough.lock()->hasFeature = false;
		throw;
	}
}

Passthrough::~Passthrough()
{
	hide(session, ipc::everyPassthroughLayer);
	PassthroughUse use;
	session.passthrough.update([&](PassthroughUse &now) {
		use = now;
		now.hasFeature = false;
	});
	for (uint32_t i = 0; i < use.layers.size(); ++i)
		if (use.layers.test(i)) hide(session, i);
}

void Passthrough::run(bool running) const
{
	session.instance.service.ask<ipc::Done>(
		ipc::ShowPassthrough{.session = session.id(), .layer = ipc::everyPassthroughLayer, .shown = running});
}

PassthroughLayer::PassthroughLayer(Passthrough &feature, bool running)
	: session(feature.session), feature_(handleOf(feature)), number_(takePlace(session))
{
	try {
		style({}); // who was here before may have had another
		run(running);
	} catch (...) {
		session.passthrough.lock()->layers.reset(number_);
		throw;
	}
}

PassthroughLayer::~PassthroughLayer()
{
	hide(session, number_);
	session.passthrough.lock()->layers.reset(number_);
}

void PassthroughLayer::run(bool running) const
{
	if (running && !handles.find(reinterpret_cast<uint64_t>(feature_), XR_OBJECT_TYPE_PASSTHROUGH_FB))
		throw Error(XR_ERROR_UNEXPECTED_STATE_PASSTHROUGH_FB, "the XrPassthroughFB that the layer belongs to was destroyed");
	session.instance.service.ask<ipc::Done>(ipc::ShowPassthrough{.session = session.id(), .layer = number_, .shown = running});
}

void PassthroughLayer::style(ipc::StylePassthrough message) const
{
	message.session = session.id();
	message.layer = number_;
	session.instance.service.ask<ipc::Done>(message);
}

void describePassthrough(XrSystemPassthroughPropertiesFB &properties) { properties.supportsPassthrough = XR_TRUE; }

void describePassthrough2(XrSystemPassthroughProperties2FB &properties)
{
	properties.capabilities = XR_PASSTHROUGH_CAPABILITY_BIT_FB | XR_PASSTHROUGH_CAPABILITY_COLOR_BIT_FB;
}

void createPassthrough(Session &session, const XrPassthroughCreateInfoFB &info, XrPassthroughFB &passthrough)
{
	const bool running = requireFlags(info.flags);
	passthrough = handles.insert(std::make_unique<Passthrough>(session, running), &session);
}

void destroyPassthrough(EvenIfLost<Passthrough> passthrough) { handles.destroy(*passthrough); }
void startPassthrough(Passthrough &passthrough) { passthrough.run(true); }
void pausePassthrough(Passthrough &passthrough) { passthrough.run(false); }

void createPassthroughLayer(Session &session, const XrPassthroughLayerCreateInfoFB &info, XrPassthroughLayerFB &layer)
{
	Passthrough &feature = handles.at<Passthrough>(info.passthrough);
	if (&feature.session != &session) throw Error(XR_ERROR_VALIDATION_FAILURE, "the XrPassthroughFB belongs to another session");
	const bool running = requireFlags(info.flags);
	if (info.purpose == XR_PASSTHROUGH_LAYER_PURPOSE_PROJECTED_FB)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "passthrough layers of purpose PROJECTED are not supported, those of RECONSTRUCTION are");
	if (info.purpose != XR_PASSTHROUGH_LAYER_PURPOSE_RECONSTRUCTION_FB)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrPassthroughLayerPurposeFB", int(info.purpose));
	layer = handles.insert(std::make_unique<PassthroughLayer>(feature, running), &session);
}

void destroyPassthroughLayer(EvenIfLost<PassthroughLayer> layer) { handles.destroy(*layer); }
void pausePassthroughLayer(PassthroughLayer &layer) { layer.run(false); }
void resumePassthroughLayer(PassthroughLayer &layer) { layer.run(true); }
void setPassthroughLayerStyle(PassthroughLayer &layer, const XrPassthroughStyleFB &style) { layer.style(styleOf(style)); }

void createGeometryInstance(Session &session, const XrGeometryInstanceCreateInfoFB &info, XrGeometryInstanceFB &)
{
	const PassthroughLayer &layer = handles.at<PassthroughLayer>(info.layer);
	if (&layer.session != &session) throw Error(XR_ERROR_VALIDATION_FAILURE, "the XrPassthroughLayerFB belongs to another session");
	handles.at<Space>(info.baseSpace);
	requirePose(info.pose, "a geometry instance");
	throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "the layer's purpose is RECONSTRUCTION: it shows no meshes");
}

void destroyGeometryInstance(EvenIfLost<GeometryInstance> instance) { handles.destroy(*instance); }

void setGeometryInstanceTransform(GeometryInstance &, const XrGeometryInstanceTransformFB &transform)
{
	requireTime(transform.time);
	requirePose(transform.pose, "a geometry instance");
}

} // namespace arift::openxr
