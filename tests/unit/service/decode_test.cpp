#include "runtime/base/pose.h"
#include "runtime/service/decode.h"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace arift;

namespace
{

using Kind = gpu::ImageKind;
/// 1: of two array layers; 2: of two cubes; 3: of depth.
const FindSwapchain find = [](uint32_t swapchain) -> std::optional<SwapchainShape> {
	switch (swapchain) {
	case 1: return SwapchainShape{640, 480, 2, 3};
	case 2: return SwapchainShape{64, 64, 2, 3, Kind::cube};
	case 3: return SwapchainShape{320, 240, 1, 3, Kind::depth};
	default: return std::nullopt;
	}
};

template <typename M> ipc::Received bytesOf(const M &message)
{
	ipc::Received received;
	received.size = ipc::wireSize(message);
	std::memcpy(received.bytes.data(), &message, received.size);
	return received;
}

ipc::LayerView wholeView()
{
	ipc::LayerView view;
	view.fov = {-0.7f, 0.7f, 0.7f, -0.7f};
	view.image.swapchain = 1;
	view.image.width = 640;
	view.image.height = 480;
	return view;
}

ipc::Submission good()
{
	ipc::Submission submission;
	submission.frame = 1;
	submission.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	submission.layerCount = 5;
	submission.layers[0].views = {wholeView(), wholeView()};
	for (ipc::LayerView &view : submission.layers[0].views)
		view.depth = {{.swapchain = 3, .width = 320, .height = 240}, 10, -9.9f, 0.5f, 3};
	submission.layers[0].depthTest = {.given = 1, .compareOp = 7, .writes = 1};
	submission.layers[1].type = ipc::LayerType::quad;
	submission.layers[1].views[0] = wholeView();
	submission.layers[1].width = 1;
	submission.layers[1].height = 0.5f;
	submission.layers[1].blend = {1, 5, 5, 5, 5};
	for (const uint32_t i : {2u, 3u}) {
		submission.layers[i].type = i == 2 ? ipc::LayerType::cylinder : ipc::LayerType::equirect;
		submission.layers[i].views[0] = wholeView();
		submission.layers[i].curved = {2, {0.5f, 0.5f}, {1, -0.5f}};
	}
	submission.layers[4].type = ipc::LayerType::cube;
	submission.layers[4].views[0].image = {.swapchain = 2, .arrayIndex = 1, .width = 64, .height = 64};
	return submission;
}

bool accepted(const ipc::Submission &submission)
{
	try {
		decodeFrameRequest(bytesOf(submission), find);
		return true;
	} catch (const Malformed &) {
		return false;
	}
}

template <typename M> bool acceptedRequest(const M &message)
{
	try {
		decodeRequest(bytesOf(message));
		return true;
	} catch (const Malformed &) {
		return false;
	}
}

} // namespace

TEST(DecodeSubmission, WhatIsWellFormedPasses)
{
	const FrameRequest request = decodeFrameRequest(bytesOf(good()), find);
	const auto &submission = std::get<ipc::Submission>(request);
	EXPECT_EQ(submission.layerCount, 5u);
	EXPECT_EQ(submission.layers[1].height, 0.5f);
	ipc::Submission empty;
	empty.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	EXPECT_TRUE(accepted(empty));
}

TEST(DecodeSubmission, EveryHostileFieldIsRefused)
{
	const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
	using Change = void (*)(ipc::Submission &, float, float);
	const struct {
		const char *name;
		Change change;
	} cases[] = {
		{"unknown swapchain", [](auto &s, float, float) { s.layers[0].views[0].image.swapchain = 9; }},
		{"unknown swapchain of the right eye", [](auto &s, float, float) { s.layers[0].views[1].image.swapchain = 0; }},
		{"image index", [](auto &s, float, float) { s.layers[0].views[1].image.image = 3; }},
		{"array index", [](auto &s, float, float) { s.layers[0].views[0].image.arrayIndex = 2; }},
		{"negative origin", [](auto &s, float, float) { s.layers[0].views[0].image.x = -1; }},
		{"too wide", [](auto &s, float, float) { s.layers[0].views[0].image.width = 641; }},
		{"beyond the edge", [](auto &s, float, float) { s.layers[0].views[0].image.y = 1; }},
		{"sum that wraps", [](auto &s, float, float) { s.layers[0].views[0].image.x = s.layers[0].views[0].image.width = 0x7fffffff; }},
		{"empty rectangle", [](auto &s, float, float) { s.layers[1].views[0].image.height = 0; }},
		{"layer type", [](auto &s, float, float) { s.layers[0].type = ipc::LayerType(99); }},
		{"cube as a flat image", [](auto &s, float, float) { s.layers[0].views[0].image = s.layers[4].views[0].image; }},
		{"flat image as a cube", [](auto &s, float, float) { s.layers[4].views[0].image.swapchain = 1; }},
		{"cube index", [](auto &s, float, float) { s.layers[4].views[0].image.arrayIndex = 2; }},
		{"depth as colour", [](auto &s, float, float) { s.layers[1].views[0].image.swapchain = 3; }},
		{"colour as depth", [](auto &s, float, float) { s.layers[0].views[1].depth.image.swapchain = 1; }},
		{"depth beyond the edge", [](auto &s, float, float) { s.layers[0].views[1].depth.image.x = 1; }},
		{"NaN depth", [](auto &s, float n, float) { s.layers[0].views[0].depth.inverseBias = n; }},
		{"infinite depth", [](auto &s, float, float i) { s.layers[0].views[0].depth.inverseScale = i; }},
		{"infinite radius", [](auto &s, float, float i) { s.layers[2].curved.radius = i; }},
		{"negative radius", [](auto &s, float, float) { s.layers[3].curved.radius = -1; }},
		{"NaN texture coordinate", [](auto &s, float n, float) { s.layers[2].curved.uvAhead.y = n; }},
		{"infinite texture coordinate", [](auto &s, float, float i) { s.layers[3].curved.uvPerUnit.x = i; }},
		{"NaN colour scale", [](auto &s, float n, float) { s.layers[4].colorScale.a = n; }},
		{"infinite colour bias", [](auto &s, float, float i) { s.layers[0].colorBias.g = i; }},
		{"blend factor", [](auto &s, float, float) { s.layers[1].blend.destinationAlpha = 6; }},
		{"blend factors neither given nor not", [](auto &s, float, float) { s.layers[1].blend.given = 2; }},
		{"comparison of depths", [](auto &s, float, float) { s.layers[0].depthTest.compareOp = 8; }},
		{"depth test neither given nor not", [](auto &s, float, float) { s.layers[0].depthTest.given = 2; }},
		{"depth neither written nor not", [](auto &s, float, float) { s.layers[0].depthTest.writes = 2; }},
		{"NaN depth range", [](auto &s, float n, float) { s.layers[0].views[1].depth.testedFrom = n; }},
		{"endless depth range", [](auto &s, float, float i) { s.layers[0].views[1].depth.testedTo = i; }},
		{"negative depth range", [](auto &s, float, float) { s.layers[0].views[0].depth.testedTo = -1; }},
		{"passthrough layer",
		 [](auto &s, float, float) {
			 s.layers[0].type = ipc::LayerType::passthrough;
			 s.layers[0].passthrough = ipc::maxPassthroughLayers;
		 }},
		{"layer frame", [](auto &s, float, float) { s.layers[0].frame = ipc::LayerFrame(7); }},
		{"eyes", [](auto &s, float, float) { s.layers[1].eyes = 4; }},
		{"NaN position", [](auto &s, float n, float) { s.layers[0].views[0].pose.position.x = n; }},
		{"position out of this world", [](auto &s, float, float) { s.layers[0].views[0].pose.position.x = 1e30f; }},
		{"orientation that is no unit",
		 [](auto &s, float, float) {
			 s.layers[0].views[1].pose.orientation = {0, 0, 0, 2};
		 }},
		{"NaN angle", [](auto &s, float n, float) { s.layers[0].views[0].fov.angleUp = n; }},
		{"angle beyond a half space", [](auto &s, float, float) { s.layers[0].views[0].fov.angleUp = 1.6f; }},
		{"field of view without width", [](auto &s, float, float) { s.layers[0].views[0].fov.angleLeft = 0.7f; }},
		{"infinite quad", [](auto &s, float, float i) { s.layers[1].width = i; }},
		{"negative quad", [](auto &s, float, float) { s.layers[1].height = -1; }},
		{"blend mode", [](auto &s, float, float) { s.blendMode = 9; }},
	};
	for (const auto &[name, change] : cases) {
		ipc::Submission submission = good();
		change(submission, nan, infinity);
		EXPECT_FALSE(accepted(submission)) << name;
	}
}

TEST(DecodeVibrate, KnowsTwoMotorsAndAmplitudesFromNothingToAll)
{
	const auto isTaken = [](const ipc::Vibrate &message) {
		try {
			return std::holds_alternative<ipc::Vibrate>(decodeFrameRequest(bytesOf(message), find));
		} catch (const Malformed &) {
			return false;
		}
	};
	EXPECT_TRUE(isTaken({.motors = 3, .amplitude = 1, .duration = std::numeric_limits<XrDuration>::min()}));
	EXPECT_FALSE(isTaken({.motors = 4}));
	for (const float amplitude : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
		EXPECT_FALSE(isTaken({.motors = 1, .amplitude = amplitude})) << amplitude;
}

TEST(DecodeCreateSession, KnowsNoMoreThanYesAndNo)
{
	for (uint32_t ipc::CreateSession::*field :
		 {&ipc::CreateSession::headless, &ipc::CreateSession::overlay, &ipc::CreateSession::hasDepth}) {
		ipc::CreateSession message;
		message.*field = 1;
		EXPECT_TRUE(std::holds_alternative<ipc::CreateSession>(decodeRequest(bytesOf(message))));
		message.*field = 2;
		EXPECT_THROW(decodeRequest(bytesOf(message)), Malformed);
	}
}

TEST(DecodeSubmission, ItsLengthIsThatOfItsLayers)
{
	ipc::Received received = bytesOf(good());
	received.size -= 1;
	EXPECT_THROW(decodeFrameRequest(received, find), Malformed);
	received.size = offsetof(ipc::Submission, layers) - 1;
	EXPECT_THROW(decodeFrameRequest(received, find), Malformed);
	received = bytesOf(good());
	const uint32_t many = ipc::maxLayers + 1;
	std::memcpy(received.bytes.data() + offsetof(ipc::Submission, layerCount), &many, sizeof(many));
	EXPECT_THROW(decodeFrameRequest(received, find), Malformed);
}

TEST(DecodeRequest, KnowsItsMessagesAndNoOthers)
{
	EXPECT_TRUE(std::holds_alternative<ipc::Recenter>(decodeRequest(bytesOf(ipc::Recenter{}))));
	ipc::Received received = bytesOf(ipc::Recenter{});
	received.size = 3;
	EXPECT_THROW(decodeRequest(received), Malformed) << "shorter than a header";
	received = bytesOf(ipc::Recenter{});
	received.size++;
	EXPECT_THROW(decodeRequest(received), Malformed) << "longer than the message";
	EXPECT_THROW(decodeRequest(bytesOf(ipc::Welcome{})), Malformed) << "a reply is no request";
	EXPECT_THROW(decodeRequest(bytesOf(ipc::WaitFrame{})), Malformed) << "belongs to the frame channel";
	EXPECT_THROW(decodeFrameRequest(bytesOf(ipc::Recenter{}), find), Malformed);
}

TEST(DecodeRequest, ValuesOutOfRangeAreRefused)
{
	EXPECT_TRUE(acceptedRequest(ipc::Hello{}));
	EXPECT_FALSE(acceptedRequest(ipc::Hello{.magic = 1}));
	EXPECT_FALSE(acceptedRequest(ipc::Hello{.role = ipc::Role(2)}));
	EXPECT_FALSE(acceptedRequest(ipc::SessionRunning{.running = 2}));
	ipc::CreateSwapchain swapchain;
	swapchain.spec.width = swapchain.spec.height = 64;
	EXPECT_TRUE(acceptedRequest(swapchain));
	const auto refused = [&](auto change) {
		ipc::CreateSwapchain bad = swapchain;
		change(bad);
		return !acceptedRequest(bad);
	};
	EXPECT_TRUE(refused([](auto &s) { s.imageCount = 0; }));
	EXPECT_TRUE(refused([](auto &s) { s.imageCount = ipc::maxImages + 1; }));
	EXPECT_TRUE(refused([](auto &s) { s.spec.width = 0; }));
	EXPECT_TRUE(refused([](auto &s) { s.spec.height = Quota::extent + 1; }));
	EXPECT_TRUE(refused([](auto &s) { s.spec.samples = 3; }));
	EXPECT_TRUE(refused([](auto &s) { s.spec.arrayLayers = 0; }));
	EXPECT_FALSE(acceptedRequest(ipc::SetSetting{.value = std::nanf("")}));
	EXPECT_FALSE(acceptedRequest(ipc::SetSetting{.setting = ipc::Setting(3)}));
	EXPECT_FALSE(acceptedRequest(ipc::Screenshot{.kind = ipc::PictureKind(2)}));
}

TEST(DecodeRequest, WhatIsSaidOfPassthroughIsChecked)
{
	const float nan = std::numeric_limits<float>::quiet_NaN();
	EXPECT_TRUE(acceptedRequest(ipc::ShowPassthrough{.layer = ipc::everyPassthroughLayer, .shown = 1}));
	EXPECT_FALSE(acceptedRequest(ipc::ShowPassthrough{.layer = ipc::everyPassthroughLayer + 1}));
	EXPECT_FALSE(acceptedRequest(ipc::ShowPassthrough{.shown = 2}));
	EXPECT_TRUE(acceptedRequest(ipc::StylePassthrough{.brightness = -100, .contrast = 1000, .saturation = 0}));
	EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.layer = ipc::everyPassthroughLayer}));
	EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.mapped = 2}));
	for (const float bad : {-0.1f, nan}) {
		EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.opacity = bad}));
		EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.edge = {0, bad, 0, 0}}));
		EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.contrast = bad}));
		EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.saturation = bad}));
		EXPECT_FALSE(acceptedRequest(ipc::ForcePassthrough{.tolerance = bad}));
		EXPECT_FALSE(acceptedRequest(ipc::ForcePassthrough{.softness = bad}));
		EXPECT_FALSE(acceptedRequest(ipc::ForcePassthrough{.opacity = bad}));
		EXPECT_FALSE(acceptedRequest(ipc::ForcePassthrough{.colour = {0, 0, bad}}));
	}
	EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.brightness = 101}));
	EXPECT_FALSE(acceptedRequest(ipc::StylePassthrough{.brightness = nan}));
	EXPECT_TRUE(acceptedRequest(ipc::ForcePassthrough{.mode = ipc::Forced::underlay}));
	EXPECT_FALSE(acceptedRequest(ipc::ForcePassthrough{.mode = ipc::Forced(4)}));
}
