// A message of a client. Input: one byte that says which channel, then the message.
#include "runtime/base/pose.h"
#include "runtime/service/decode.h"
#include "tests/fuzz/input.h"
#include <cmath>
#include <cstring>

using namespace arift;

namespace
{

using Kind = gpu::ImageKind;

std::optional<SwapchainShape> find(uint32_t swapchain)
{
	switch (swapchain) {
	case 1: return SwapchainShape{640, 480, 2, 3};
	case 2: return SwapchainShape{64, 64, 2, 3, Kind::cube};
	case 3: return SwapchainShape{320, 240, 1, 3, Kind::depth};
	default: return std::nullopt;
	}
}

void checkImage(const ipc::SubImage &image, Kind kind)
{
	const auto shape = find(image.swapchain);
	fuzz::require(shape && shape->kind == kind, "the swapchain is the session's, and of that kind");
	fuzz::require(image.image < shape->imageCount && image.arrayIndex < shape->arraySize, "image and array layer exist");
	fuzz::require(image.x >= 0 && image.y >= 0 && image.width > 0 && image.height > 0, "the rectangle begins inside");
	fuzz::require(int64_t(image.x) + image.width <= shape->width && int64_t(image.y) + image.height <= shape->height,
				  "the rectangle ends inside");
}

void checkFinite(std::initializer_list<float> numbers)
{
	for (const float number : numbers) fuzz::require(std::isfinite(number), "numbers are finite");
}

void checkLayer(const ipc::Layer &layer)
{
	using Type = ipc::LayerType;
	fuzz::require(layer.frame <= ipc::LayerFrame::head && layer.eyes <= 3, "enums are in range");
	const size_t views = layer.type == Type::projection ? 2 : layer.type <= Type::cube ? 1 : 0;
	for (size_t i = 0; i < views; ++i) {
		const ipc::LayerView &view = layer.views[i];
		checkImage(view.image, layer.type == Type::cube ? Kind::cube : Kind::flat);
		fuzz::require(isValidPose(view.pose), "poses are valid");
		if (layer.type != Type::projection || view.depth.image.swapchain == 0) continue;
		checkImage(view.depth.image, Kind::depth);
		checkFinite({view.depth.inverseBias, view.depth.inverseScale, view.depth.testedFrom, view.depth.testedTo});
	}
	if (layer.type == Type::quad) checkFinite({layer.width, layer.height});
	if (layer.type == Type::cylinder || layer.type == Type::equirect)
		checkFinite({layer.curved.radius, layer.curved.uvAhead.x, layer.curved.uvPerUnit.y});
	if (views == 0) return;
	checkFinite({layer.colorScale.r, layer.colorBias.a});
	fuzz::require(layer.blend.sourceColor <= 5 && layer.blend.destinationAlpha <= 5 && layer.depthTest.compareOp <= 7,
				  "enums are in range");
}

void checkFrameRequest(const ipc::Received &received)
{
	const FrameRequest request = decodeFrameRequest(received, find);
	const auto *submission = std::get_if<ipc::Submission>(&request);
	if (!submission) return;
	fuzz::require(submission->layerCount <= ipc::maxLayers, "the number of layers is in range");
	for (uint32_t i = 0; i < submission->layerCount; ++i) checkLayer(submission->layers[i]);
}

void checkRequest(const ipc::Received &received)
{
	const Request request = decodeRequest(received);
	if (const auto *swapchain = std::get_if<ipc::CreateSwapchain>(&request)) {
		fuzz::require(swapchain->imageCount >= 1 && swapchain->imageCount <= ipc::maxImages, "the number of images is in range");
		fuzz::require(swapchain->spec.width <= Quota::extent && swapchain->spec.height <= Quota::extent, "the extent is within the quota");
	}
	if (const auto *setting = std::get_if<ipc::SetSetting>(&request)) fuzz::require(std::isfinite(setting->value), "settings are finite");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	if (size == 0 || size - 1 > ipc::maxMessageSize) return 0;
	ipc::Received received;
	received.size = size - 1;
	if (received.size > 0) std::memcpy(received.bytes.data(), data + 1, received.size);
	try {
		data[0] & 1 ? checkFrameRequest(received) : checkRequest(received);
	} catch (const Malformed &) { // what the service answers by disconnecting
	}
	return 0;
}
