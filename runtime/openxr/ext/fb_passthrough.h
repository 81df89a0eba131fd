// XR_FB_passthrough: the cameras' image as a layer among others. What is shown of it, and how, is kept by the service and holds at once.
// Geometry instances have nothing to hang on: layers onto meshes (purpose PROJECTED) are not supported.
#pragma once
#include "runtime/openxr/session.h"
#include "runtime/openxr/space.h"

namespace arift::openxr
{

/// XrPassthroughFB. A session has one at a time; without it running no layer is shown.
class Passthrough : public Object
{
public:
	/// Throws XR_ERROR_FEATURE_ALREADY_CREATED_PASSTHROUGH_FB.
	Passthrough(Session &owner, bool running);
	/// Its layers stay, and are never shown again.
	~Passthrough() override;
	void requireAlive() const override { session.requireAlive(); }
	void run(bool running) const;

	Session &session;
};

/// XrPassthroughLayerFB.
class PassthroughLayer : public Object
{
public:
	/// Throws XR_ERROR_INSUFFICIENT_RESOURCES_PASSTHROUGH_FB where the session has as many as the service keeps.
	PassthroughLayer(Passthrough &feature, bool running);
	~PassthroughLayer() override;
	void requireAlive() const override { session.requireAlive(); }
	/// Throws XR_ERROR_UNEXPECTED_STATE_PASSTHROUGH_FB where the feature that it belongs to was destroyed.
	void run(bool running) const;
	void style(ipc::StylePassthrough message) const;
	/// Its place in the service.
	uint32_t number() const { return number_; }

	Session &session;

private:
	const XrPassthroughFB feature_;
	const uint32_t number_;
};

/// There is none.
class GeometryInstance : public Object
{
};

template <> struct HandleOf<Passthrough> {
	using type = XrPassthroughFB;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_PASSTHROUGH_FB;
};
template <> struct HandleOf<PassthroughLayer> {
	using type = XrPassthroughLayerFB;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_PASSTHROUGH_LAYER_FB;
};
template <> struct HandleOf<GeometryInstance> {
	using type = XrGeometryInstanceFB;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_GEOMETRY_INSTANCE_FB;
};

void describePassthrough(XrSystemPassthroughPropertiesFB &properties);
void describePassthrough2(XrSystemPassthroughProperties2FB &properties);
void createPassthrough(Session &session, const XrPassthroughCreateInfoFB &info, XrPassthroughFB &passthrough);
void destroyPassthrough(EvenIfLost<Passthrough> passthrough);
/// Starting what runs and pausing what is paused change nothing.
void startPassthrough(Passthrough &passthrough);
void pausePassthrough(Passthrough &passthrough);
/// Throws XR_ERROR_FEATURE_UNSUPPORTED for the purpose PROJECTED.
void createPassthroughLayer(Session &session, const XrPassthroughLayerCreateInfoFB &info, XrPassthroughLayerFB &layer);
void destroyPassthroughLayer(EvenIfLost<PassthroughLayer> layer);
void pausePassthroughLayer(PassthroughLayer &layer);
void resumePassthroughLayer(PassthroughLayer &layer);
void setPassthroughLayerStyle(PassthroughLayer &layer, const XrPassthroughStyleFB &style);
/// Throws XR_ERROR_FEATURE_UNSUPPORTED: no layer shows meshes.
void createGeometryInstance(Session &session, const XrGeometryInstanceCreateInfoFB &info, XrGeometryInstanceFB &instance);
void destroyGeometryInstance(EvenIfLost<GeometryInstance> instance);
void setGeometryInstanceTransform(GeometryInstance &instance, const XrGeometryInstanceTransformFB &transform);

} // namespace arift::openxr
