// A message of a client. Input: one byte that says which channel, then the message.
#include "runtime/base/pose.h"
#include "runtime/service/decode.h"
#include "tests/fuzz/input.h"
#include <cmath>
#include <cstring>

using namespace arift;

namespace
{

constexpr SwapchainShape shape{640, 480, 2, 3};

void checkImage(const ipc::SubImage &image)
{
	fuzz::require(image.swapchain == 1, "the swapchain is the session's");
	fuzz::require(image.image < shape.imageCount && image.arrayIndex < shape.arrayLayers, "image and array layer exist");
	fuzz::require(image.x >= 0 && image.y >= 0 && image.width > 0 && image.height > 0, "the rectangle begins inside");
	fuzz::require(int64_t(image.x) + image.width <= shape.width && int64_t(image.y) + image.height <= shape.height,
				  "the rectangle ends inside");
}

void checkLayer(const ipc::Layer &layer)
{
	fuzz::require(layer.type <= ipc::LayerType::quad && layer.frame <= ipc::LayerFrame::head && layer.eyes <= 3, "enums are in range");
	const size_t views = layer.type == ipc::LayerType::projection ? 2 : 1;
	for (size_t i = 0; i < views; ++i) {
		checkImage(layer.views[i].image);
		fuzz::require(isValidPose(layer.views[i].pose), "poses are valid");
	}
	if (layer.type == ipc::LayerType::quad) fuzz::require(std::isfinite(layer.width) && std::isfinite(layer.height), "extents are finite");
}

void checkFrameRequest(const ipc::Received &received)
{
	const auto find = [](uint32_t swapchain) { return swapchain == 1 ? std::optional(shape) : std::nullopt; };
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
