#include "tests/fakes/evdev/fake_input_device.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

namespace arift::fake
{

namespace fs = std::filesystem;

namespace
{

constexpr int longestWaitMs = 10'000;

bool isReadable(int fd)
{
	pollfd polled{fd, POLLIN, 0};
	return ::poll(&polled, 1, longestWaitMs) > 0;
}

/// The node is there when it can be opened, and not before.
UniqueFd listenOn(const fs::path &node)
{
	const fs::path path = node.string() + "~";
	UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
	sockaddr_un address{};
	address.sun_family = AF_UNIX;
	if (path.native().size() >= sizeof(address.sun_path)) throw std::runtime_error("too long for a socket: " + path.string());
	std::strcpy(address.sun_path, path.c_str());
	if (::bind(fd.get(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0 || ::listen(fd.get(), 4) != 0)
		throw std::runtime_error(path.string() + ": " + std::strerror(errno));
	fs::rename(path, node);
	return fd;
}

InputState *mapState(const fs::path &file)
{
	const UniqueFd fd(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
	if (::ftruncate(fd.get(), sizeof(InputState)) != 0) throw std::runtime_error(file.string() + ": " + std::strerror(errno));
	void *mapped = ::mmap(nullptr, sizeof(InputState), PROT_READ | PROT_WRITE, MAP_SHARED, fd.get(), 0);
	if (mapped == MAP_FAILED) throw std::runtime_error(file.string() + ": " + std::strerror(errno));
	return new (mapped) InputState;
}

/// As the kernel prints a set: words in hexadecimal, the highest first.
template <int count> void writeBits(const fs::path &file, const Bits<count> &bits)
{
	std::ofstream out(file);
	out << std::hex;
	for (size_t i = std::size(bits.words); i-- > 0;) out << bits.words[i] << (i > 0 ? " " : "\n");
}

} // namespace

InputModel InputModel::keyboard(std::string name)
{
	InputModel model{.name = std::move(name), .keys = {}, .relative = {}, .axes = {}};
	for (int key = KEY_ESC; key <= KEY_PAUSE; ++key) model.keys.push_back(key);
	return model;
}

InputModel InputModel::mouse(std::string name)
{
	return {.name = std::move(name), .keys = {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE}, .relative = {REL_X, REL_Y, REL_WHEEL}, .axes = {}};
}

InputModel InputModel::gamepad(std::string name)
{
	InputModel model{.name = std::move(name),
					 .keys = {BTN_A, BTN_B, BTN_X, BTN_Y, BTN_TL, BTN_TR, BTN_SELECT, BTN_START, BTN_MODE, BTN_THUMBL, BTN_THUMBR},
					 .relative = {},
					 .axes = {},
					 .rumbles = true};
	for (const int stick : {ABS_X, ABS_Y, ABS_RX, ABS_RY}) model.axes.push_back({stick, -32768, 32767, 4096, 0});
	for (const int trigger : {ABS_Z, ABS_RZ}) model.axes.push_back({trigger, 0, 255, 0, 0});
	for (const int hat : {ABS_HAT0X, ABS_HAT0Y}) model.axes.push_back({hat, -1, 1, 0, 0});
	return model;
}

InputFolders::InputFolders(const fs::path &root) : devices(root / "dev/input"), sysfs(root / "sys") { fs::create_directories(devices); }

FakeInputDevice::FakeInputDevice(InputFolders folders, std::string node, const InputModel &model, unsigned permissions)
	: folders_(std::move(folders)), node_(std::move(node)), path_(folders_.devices / node_), state_(mapState(path_.string() + stateEnding))
{
	model.name.copy(state_->name, sizeof(state_->name) - 1);
	state_->id = {.bustype = BUS_USB, .vendor = model.vendor, .product = 1, .version = 1};
	state_->types.set(EV_SYN);
	for (const int key : model.keys) state_->keys.set(key);
	for (const int axis : model.relative) state_->relative.set(axis);
	for (const auto &[code, minimum, maximum, flat, value] : model.axes) {
		state_->absolute.set(code);
		state_->axes[code] = {.value = value, .minimum = minimum, .maximum = maximum, .fuzz = 0, .flat = flat, .resolution = 0};
	}
	if (model.rumbles) state_->effects.set(FF_RUMBLE);
	state_->types.set(EV_KEY, !model.keys.empty());
	state_->types.set(EV_REL, !model.relative.empty());
	state_->types.set(EV_ABS, !model.axes.empty());
	state_->types.set(EV_FF, model.rumbles);
	writeSysfs(model);
	const mode_t before = ::umask(0777 & ~permissions);
	listener_ = listenOn(path_);
	::umask(before);
}

FakeInputDevice::~FakeInputDevice()
{
	fs::remove_all(folders_.sysfs / "class/input" / node_);
	fs::remove(path_);
	fs::remove(path_.string() + stateEnding);
	::munmap(state_, sizeof(InputState));
}

void FakeInputDevice::writeSysfs(const InputModel &model) const
{
	const fs::path device = folders_.sysfs / "class/input" / node_ / "device";
	fs::create_directories(device / "capabilities");
	std::ofstream(device / "name") << model.name << '\n';
	writeBits(device / "capabilities/ev", state_->types);
	writeBits(device / "capabilities/key", state_->keys);
	writeBits(device / "capabilities/rel", state_->relative);
	writeBits(device / "capabilities/abs", state_->absolute);
	writeBits(device / "capabilities/ff", state_->effects);
}

void FakeInputDevice::setPermissions(unsigned permissions) const { ::chmod(path_.c_str(), permissions); }

void FakeInputDevice::waitForReader()
{
	if (reader_) return;
	if (!isReadable(listener_.get())) throw std::runtime_error(node_ + " is not opened by anybody");
	reader_ = UniqueFd(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
}

bool FakeInputDevice::isOpened() const
{
	pollfd polled{listener_.get(), POLLIN, 0};
	return reader_ || ::poll(&polled, 1, 0) > 0;
}

void FakeInputDevice::note(const Change &change)
{
	if (change.type == EV_KEY) state_->pressed.set(change.code, change.value != 0);
	if (change.type == EV_ABS) state_->axes[change.code].value = change.value;
}

void FakeInputDevice::send(std::initializer_list<Change> changes)
{
	waitForReader();
	std::vector<input_event> events;
	for (const Change &change : changes) {
		note(change);
		events.push_back({.time = {}, .type = uint16_t(change.type), .code = uint16_t(change.code), .value = change.value});
	}
	events.push_back({.time = {}, .type = EV_SYN, .code = SYN_REPORT, .value = 0});
	const size_t size = events.size() * sizeof(input_event);
	EXPECT_EQ(::send(reader_.get(), events.data(), size, MSG_NOSIGNAL), ssize_t(size)) << node_ << " is read no more";
}

void FakeInputDevice::overrun(std::initializer_list<Change> missed)
{
	for (const Change &change : missed) note(change);
	send({{EV_SYN, SYN_DROPPED, 0}});
}

std::optional<FakeInputDevice::Played> FakeInputDevice::nextPlayed()
{
	waitForReader();
	union {
		ff_effect effect;
		input_event event;
	} told{};
	while (isReadable(reader_.get())) {
		const ssize_t size = ::recv(reader_.get(), &told, sizeof(told), 0);
		if (size <= 0) return std::nullopt;
		if (size == ssize_t(sizeof(ff_effect))) {
			effect_ = {told.effect.u.rumble.strong_magnitude, told.effect.u.rumble.weak_magnitude, told.effect.replay.length, true};
			continue;
		}
		EXPECT_EQ(told.event.type, EV_FF);
		EXPECT_EQ(told.event.code, 3) << "the number that the kernel gave";
		return told.event.value != 0 ? effect_ : Played{0, 0, 0, false};
	}
	return std::nullopt;
}

} // namespace arift::fake
