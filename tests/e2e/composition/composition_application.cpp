// An OpenXR application that shows one of the compositions (compositions.h), named by its number, until it is told to end.
#include "tests/e2e/composition/painted_images.h" // first: with OpenXR's functions

#include <cmath>
#include <csignal>
#include <deque>

namespace
{

using namespace arift::e2e;

volatile std::sig_atomic_t leave = 0;

XrPosef toXr(const Pose &pose)
{
	const auto &[x, y, z] = pose.axis;
	const double length = std::sqrt(x * x + y * y + z * z), s = std::sin(pose.angle / 2) / length;
	return {{float(x * s), float(y * s), float(z * s), float(std::cos(pose.angle / 2))},
			{float(pose.position[0]), float(pose.position[1]), float(pose.position[2])}};
}

XrEyeVisibility visibilityOf(const Layer &layer)
{
	if (layer.eyes[0] && layer.eyes[1]) return XR_EYE_VISIBILITY_BOTH;
	return layer.eyes[0] ? XR_EYE_VISIBILITY_LEFT : XR_EYE_VISIBILITY_RIGHT;
}

XrCompositionLayerFlags flagsOf(const Layer &layer)
{
	XrCompositionLayerFlags flags = 0;
	if (layer.hasAlpha) flags |= XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
	if (!layer.isMultiplied) flags |= XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
	return flags;
}

XrFovf fovOf(const XrFovf &seen, const Layer &layer)
{
	const auto s = float(layer.angleScale);
	XrFovf fov{seen.angleLeft * s, seen.angleRight * s, seen.angleUp * s, seen.angleDown * s};
	if (layer.isUpsideDown) std::swap(fov.angleUp, fov.angleDown);
	if (layer.isMirrored) std::swap(fov.angleLeft, fov.angleRight);
	return fov;
}

XrColor4f toXr(const std::array<double, 4> &c) { return {float(c[0]), float(c[1]), float(c[2]), float(c[3])}; }

class CompositionApplication final : public DrawingApplication
{
public:
	explicit CompositionApplication(const Composition &composition)
		: DrawingApplication("composition_application", {"XR_KHR_composition_layer_cylinder", "XR_KHR_composition_layer_equirect2",
														 "XR_KHR_composition_layer_cube", "XR_KHR_composition_layer_color_scale_bias"}),
		  composition_(composition),
		  head_(viewSpace({}))
	{
		for (const Image &image : composition.images) images_.emplace_back(vulkan_, queue_, session_, image);
		for (const Layer &layer : composition.layers) spaces_.push_back(viewSpace(layer.spaceInView));
	}

private:
	/// Whatever a layer can be.
	struct Submitted {
		XrCompositionLayerColorScaleBiasKHR scaleBias;
		std::array<XrCompositionLayerProjectionView, 2> views;
		union {
			XrCompositionLayerProjection projection;
			XrCompositionLayerQuad quad;
			XrCompositionLayerCylinderKHR cylinder;
			XrCompositionLayerEquirect2KHR equirect;
			XrCompositionLayerCubeKHR cube;
		};
	};

	Space viewSpace(const Pose &pose) const
	{
		const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_VIEW, toXr(pose)};
		Space space;
		check(xrCreateReferenceSpace(session_, &info, &space.value), "xrCreateReferenceSpace");
		return space;
	}

	void frame() override
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		std::array<XrView, 2> seen;
		locate(state.predictedDisplayTime, head_, seen);
		std::vector<Submitted> all(composition_.layers.size());
		std::vector<const XrCompositionLayerBaseHeader *> headers;
		for (size_t i = 0; i < all.size(); ++i) {
			describe(all[i], i, seen);
			headers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader *>(&all[i].projection));
		}
		endFrame(state.predictedDisplayTime, headers, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
	}

	void describe(Submitted &to, size_t index, const std::array<XrView, 2> &seen) const
	{
		const Layer &layer = composition_.layers[index];
		const PaintedImages &images = images_[layer.part.image];
		const XrPosef pose = toXr(layer.poseInSpace);
		const auto radius = float(layer.radius);
		to.scaleBias = {XR_TYPE_COMPOSITION_LAYER_COLOR_SCALE_BIAS_KHR, nullptr, toXr(layer.scale), toXr(layer.bias)};
		const XrCompositionLayerFlags flags = flagsOf(layer);
		const XrEyeVisibility eyes = visibilityOf(layer);
		const XrSpace space = spaces_[index];
		switch (layer.shape) {
		case Shape::projection:
			for (size_t eye = 0; eye < 2; ++eye) {
				const Part &part = eye == 0 ? layer.part : layer.rightPart;
				to.views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, nullptr, seen[eye].pose, fovOf(seen[eye].fov, layer),
								 images_[part.image].subImage(part)};
			}
			to.projection = {XR_TYPE_COMPOSITION_LAYER_PROJECTION, &to.scaleBias, flags, head_, 2, to.views.data()};
			return;
		case Shape::quad:
			to.quad = {XR_TYPE_COMPOSITION_LAYER_QUAD,           &to.scaleBias, flags, space, eyes, images.subImage(layer.part), pose,
					   {float(layer.width), float(layer.height)}};
			return;
		case Shape::cylinder:
			to.cylinder = {XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR,
						   &to.scaleBias,
						   flags,
						   space,
						   eyes,
						   images.subImage(layer.part),
						   pose,
						   radius,
						   float(layer.across),
						   float(layer.aspect)};
			return;
		case Shape::equirect:
			to.equirect = {XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR,
						   &to.scaleBias,
						   flags,
						   space,
						   eyes,
						   images.subImage(layer.part),
						   pose,
						   radius,
						   float(layer.across),
						   float(layer.upper),
						   float(layer.lower)};
			return;
		case Shape::cube:
			to.cube = {XR_TYPE_COMPOSITION_LAYER_CUBE_KHR, &to.scaleBias, flags, space, eyes, images.handle(), 0, pose.orientation};
			return;
		}
	}

	const Composition &composition_;
	const Space head_;
	std::deque<PaintedImages> images_;
	std::vector<Space> spaces_;
};

} // namespace

int main(int count, char **arguments)
{
	std::signal(SIGTERM, [](int) { leave = 1; });
	return runApplication("composition_application", [&] {
		if (count != 2) throw std::runtime_error("expected the number of a composition");
		CompositionApplication(compositions().at(std::stoul(arguments[1]))).run(leave);
	});
}
