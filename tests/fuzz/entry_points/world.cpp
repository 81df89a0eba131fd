#include "tests/fuzz/entry_points/world.h"
#include "runtime/motion/spaces.h"
#include "runtime/service/decode.h"
#include <filesystem>

namespace arift::fuzz
{
namespace
{

constexpr XrDuration patience = second;

std::vector<UniqueFd> imagesOf(const ipc::CreateSwapchain &create, ipc::SwapchainCreated &)
{
	std::vector<UniqueFd> images;
	for (uint32_t i = 0; i < create.imageCount; ++i) images.emplace_back(::dup(STDERR_FILENO));
	return images;
}

size_t threads()
{
	const std::filesystem::directory_iterator all("/proc/self/task");
	return size_t(std::distance(begin(all), end(all)));
}

/// What this process has open, but for pipes, through which sanitizers speak with what finds names for them.
std::vector<std::string> descriptors()
{
	std::vector<std::string> found;
	std::error_code ignored;
	for (const auto &entry : std::filesystem::directory_iterator("/proc/self/fd")) {
		const std::string target = std::filesystem::read_symlink(entry.path(), ignored).native();
		if (!target.starts_with("pipe:")) found.push_back(entry.path().native() + ": " + target);
	}
	return found;
}

FakeService::Grant granting(ipc::Sharing sharing)
{
	return [sharing](ipc::SessionCreated &created) {
		created.sharing = sharing;
		created.formats[0] = VK_FORMAT_R8G8B8A8_SRGB;
		created.formats[1] = VK_FORMAT_D32_SFLOAT;
		return UniqueFd();
	};
}

std::optional<SwapchainShape> shapeOf(const FakeService::Record &record, uint32_t swapchain)
{
	if (swapchain == 0 || swapchain > record.swapchains.size()) return std::nullopt;
	const ipc::CreateSwapchain &created = record.swapchains[swapchain - 1];
	const gpu::ImageSpec &spec = created.spec;
	return SwapchainShape{spec.width, spec.height, gpu::arraySize(spec), created.imageCount, gpu::kindOf(spec)};
}

float unit(Choices &choices) { return float(choices.byte()) / 128 - 1; }

} // namespace

World::World() : service_(FakeService::usualWelcome(), imagesOf)
{
	for (XrTime time = posesBegin; time <= posesEnd; time += millisecond)
		service_.poses().push({time, rotationAbout({0, 1, 0}, inSeconds(time - posesBegin)), {0, 1, 0}, {0, 0, 0}});
	ipc::TimingTable timing{};
	timing.displayPeriod = millisecond; // who waits for an image to be given up does not wait long
	ipc::ViewTable views = *service_.system().views.read();
	views.viewOffset = 0.5f;
	service_.system().views.write(views);
	timing.latchBeforeDisplay = 20 * millisecond;
	timing.cameras = {ipc::CameraTiming{posesBegin, 16 * millisecond, 10 * millisecond}, {posesBegin, 16 * millisecond, 10 * millisecond}};
	service_.system().timing.write(timing);
	ipc::LensOutlines lenses{};
	for (ipc::LensOutline &lens : lenses) {
		constexpr std::array corners{XrVector2f{-0.5f, -0.5f}, XrVector2f{0.5f, -0.5f}, XrVector2f{0.5f, 0.5f}, XrVector2f{-0.5f, 0.5f}};
		lens.count = uint32_t(corners.size());
		std::ranges::copy(corners, lens.points.begin());
	}
	service_.system().lensOutlines.write(lenses);
	service_.setWatch([this](const ipc::Received &message, bool isFrame) { check(message, isFrame); });
	writePages();
}

/// A client is disconnected that sends what the service's decoder refuses.
void World::check(const ipc::Received &message, bool isFrame)
{
	try {
		if (!isFrame) return static_cast<void>(decodeRequest(message));
		decodeFrameRequest(message, [record = service_.record()](uint32_t swapchain) { return shapeOf(record, swapchain); });
	} catch (const Malformed &problem) {
		std::fprintf(stderr, "the service: %s\n", problem.what());
		require(false, "the library sends nothing that the service refuses");
	}
}

void World::writePages()
{
	service_.system().headset.write({});
	service_.system().clock.write({});
	service_.client().input.write({});
	service_.refuseSessions(XR_SUCCESS);
	service_.setGrant(granting(ipc::Sharing::memory));
	device_.importFails = device_.submitFails = false;
	mayFail_ = isGone_ = false;
}

void World::makeSession(State &state)
{
	const XrInstance handle = state.handles.newest<XrInstance>();
	if (!handle) return;
	auto &instance = openxr::handles.at<openxr::Instance>(handle);
	if (instance.hasSession.exchange(true)) return;
	try {
		auto made = std::make_unique<openxr::Session>(instance, std::make_unique<openxr::FakeGraphics>(device_), nullptr);
		openxr::Session &session = *made;
		state.handles.add(openxr::handles.insert(std::move(made), &instance));
		session.announce();
	} catch (const openxr::Error &) {
		instance.hasSession = false;
	}
}

void World::tell(Choices choices)
{
	using Type = ipc::EventType;
	constexpr std::array types{Type::visibilityChanged, Type::recentered, Type::exitRequested, Type::mainVisibilityChanged,
							   Type::lossPending};
	ipc::Event event{.type = types[choices.byte() % types.size()], .time = usualTime};
	const uint8_t hidden = choices.byte();
	event.visible = hidden & 1 ? 0 : 1;
	event.focused = hidden & 2 ? 0 : 1;
	event.flags = hidden >> 2;
	service_.send(event);
}

void World::play(Choices choices)
{
	ipc::InputTable table{};
	const uint8_t absent = choices.byte();
	for (uint32_t hand = 0; hand < 2; ++hand) {
		const uint8_t pressed = choices.byte();
		table.hands[hand].isThere = absent >> hand & 1 ? 0 : 1;
		table.hands[hand].select = pressed & 1 ? 0 : 1;
		table.hands[hand].menu = pressed & 2 ? 1 : 0;
		table.hands[hand].aimInView.position = {unit(choices), 0, -0.5f};
	}
	table.hasGamepad = absent & 4 ? 0 : 1;
	table.gamepad.buttons = choices.raw<uint16_t>();
	for (size_t side = 0; side < 2; ++side) {
		table.gamepad.triggers[side] = float(choices.byte()) / 255;
		table.gamepad.thumbsticks[side] = {unit(choices), unit(choices)};
	}
	service_.client().input.write(table);
}

void World::fail(Choices choices)
{
	constexpr uint8_t import = 1, submit = 2, refuse = 4, full = 8, missing = 16, copies = 32;
	const uint8_t what = choices.byte();
	device_.importFails = what & import;
	device_.submitFails = what & submit;
	service_.refuseSessions(!(what & refuse) ? XR_SUCCESS : what & full ? XR_ERROR_LIMIT_REACHED : XR_ERROR_RUNTIME_UNAVAILABLE);
	if (what & missing) service_.system().headset.write({.isMissing = 1, .problem = "it was unplugged"});
	service_.setGrant(granting(what & copies ? ipc::Sharing::copies : ipc::Sharing::memory));
	const double rates[] = {1, 1, 0.25, 0}; // as real time, shifted, slow, stepped
	const uint8_t clock = choices.byte() % std::size(rates);
	service_.system().clock.write({.realAnchor = clock == 0 ? 0 : 5 * second, .xrAnchor = clock == 0 ? 0 : second, .rate = rates[clock]});
	mayFail_ = mayFail_ || (what & (import | submit));
}

void World::hangUp()
{
	isGone_ = true;
	service_.hangUp();
}

void World::settle(const openxr::Session &session, uint64_t frame)
{
	const XrTime giveUp = realTime() + patience;
	const auto &held = service_.client().oldestHeldFrame;
	while (!isGone_ && held != frame && session.state() != XR_SESSION_STATE_LOSS_PENDING && realTime() < giveUp) std::this_thread::yield();
}

void World::end()
{
	require(openxr::handles.size() == 0, "with the instances all their handles are gone");
	service_.forgetClients();
	writePages();
	if (threads_ == 0) {
		threads_ = threads();
		descriptors_ = descriptors().size();
	}
	// A thread that was joined may be listed for a moment yet.
	for (const XrTime giveUp = realTime() + patience; threads() > threads_ && realTime() < giveUp;) std::this_thread::yield();
	require(threads() <= threads_, "no thread is left behind");
	const std::vector<std::string> open = descriptors();
	if (open.size() <= descriptors_) return;
	for (const std::string &descriptor : open) std::fprintf(stderr, "%s\n", descriptor.c_str());
	require(false, "no descriptor is left behind");
}

} // namespace arift::fuzz
