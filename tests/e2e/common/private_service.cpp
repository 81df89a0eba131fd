#include "tests/e2e/common/private_service.h"
#include "runtime/ipc/shared_memory.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

namespace arift::e2e
{
namespace
{

constexpr XrDuration answerLimit = 30 * second; // real time; a software renderer on a busy machine is slow

ChildProcess startService(const PrivateTree &tree, const std::string &configuration, std::vector<std::string> arguments,
						  const std::string &program)
{
	const std::filesystem::path file = tree.write("config/arift/config.toml", configuration);
	arguments.insert(arguments.begin(), {(programDirectory() / program).string(), "--config", file.string()});
	return ChildProcess(arguments, tree.environment(), tree.root() / "service.log");
}

/// The service refuses what it cannot answer in time, devices not yet open or no image finished: on a busy machine it can a little later.
template <typename Reply, typename Request> ipc::Answer<Reply> askAgain(ipc::Requests &connection, const Request &request)
{
	auto answer = connection.ask<Reply>(request, answerLimit);
	for (int again = 0; answer.how == ipc::Answered::refused && again < 5; ++again) answer = connection.ask<Reply>(request, answerLimit);
	return answer;
}

/// The bytes that a reply's descriptor stands for.
template <typename Bytes> Bytes contents(int fd, size_t size)
{
	const ipc::Mapping mapping = ipc::mapReadOnly(fd, size);
	const auto *first = static_cast<const typename Bytes::value_type *>(mapping.address());
	return Bytes(first, first + size);
}

} // namespace

std::optional<ipc::Socket> connectTo(const PrivateTree &tree)
{
	const std::string path = (tree.root() / "runtime/arift/service.sock").string();
	UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
	sockaddr_un address{};
	address.sun_family = AF_UNIX;
	if (path.size() >= sizeof(address.sun_path)) throw std::runtime_error("too long for a socket: " + path);
	path.copy(address.sun_path, sizeof(address.sun_path) - 1);
	if (::connect(fd.get(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0) return std::nullopt;
	return ipc::Socket(std::move(fd));
}

PrivateService::PrivateService(const std::string &configuration, std::vector<std::string> arguments, const std::string &program)
	: tree_(std::make_unique<PrivateTree>()), service_(startService(*tree_, configuration, std::move(arguments), program))
{
	const XrTime deadline = realTime() + answerLimit;
	while (!connection_) {
		if (!service_.running()) throw std::runtime_error("arift-service ended at once:\n" + service_.output());
		if (realTime() > deadline) throw std::runtime_error("arift-service does not listen:\n" + service_.output());
		if (auto connected = connectTo(*tree_))
			connection_ = std::make_unique<ipc::Requests>(std::move(*connected));
		else
			std::this_thread::sleep_for(std::chrono::milliseconds(10));
	}
	ipc::Hello hello;
	hello.role = ipc::Role::monitor;
	hello.pid = uint32_t(::getpid());
	ipc::copyText(hello.applicationName, "end-to-end test");
	const auto answer = connection_->ask<ipc::Welcome>(hello, answerLimit);
	if (!answer) fail("Hello", answer.failure);
	status(); // is answered once the devices are open and images are made
}

PrivateService::~PrivateService() = default;
PrivateService::PrivateService(PrivateService &&) noexcept = default;

void PrivateService::fail(const std::string &what, const ipc::Failed &failure)
{
	throw std::runtime_error(what + ": " + ipc::textOf(failure.text) + "\n" + service_.output());
}

ChildProcess PrivateService::start(const std::string &program, std::vector<std::string> arguments) const
{
	arguments.insert(arguments.begin(), (programDirectory() / program).string());
	return ChildProcess(arguments, tree_->environment(), tree_->root() / (program + ".log"));
}

nlohmann::json PrivateService::status(bool resetFigures)
{
	ipc::GetStatus request;
	request.resetFigures = resetFigures;
	const auto answer = askAgain<ipc::Status>(*connection_, request);
	if (!answer || answer.fdCount != 1) fail("GetStatus", answer.failure);
	return nlohmann::json::parse(contents<std::string>(answer.fds[0].get(), answer.reply.size));
}

PanelPicture PrivateService::screenshot(ipc::PictureKind kind)
{
	ipc::Screenshot request;
	request.kind = kind;
	const auto answer = askAgain<ipc::Picture>(*connection_, request);
	if (!answer || answer.fdCount != 1) fail("Screenshot", answer.failure);
	const size_t size = size_t(answer.reply.width) * answer.reply.height * 4;
	return {answer.reply.width, answer.reply.height, answer.reply.displayTime, contents<std::vector<uint8_t>>(answer.fds[0].get(), size)};
}

void PrivateService::set(ipc::Setting setting, float value)
{
	ipc::SetSetting request;
	request.setting = setting;
	request.value = value;
	const auto answer = connection_->command(request, answerLimit);
	if (!answer) fail("SetSetting", answer.failure);
}

void PrivateService::recenter()
{
	const auto answer = connection_->command(ipc::Recenter{}, answerLimit);
	if (!answer) fail("Recenter", answer.failure);
}

bool eventually(PrivateService &service, const std::function<bool(const nlohmann::json &)> &wanted, XrDuration limit)
{
	for (const XrTime end = realTime() + limit; realTime() < end;)
		if (wanted(service.status())) return true;
	return false;
}

Statistics statisticsOf(const PanelPicture &picture, uint32_t left, uint32_t right)
{
	double sum = 0, squares = 0, lit = 0, count = 0;
	for (uint32_t y = picture.height / 4; y < picture.height * 3 / 4; ++y)
		for (uint32_t x = left; x < right; ++x) {
			const double value = picture.rgba[(size_t(y) * picture.width + x) * 4 + 1];
			sum += value, squares += value * value, lit += value > 8, count += 1;
		}
	return {sum / count, std::sqrt(squares / count - sum / count * (sum / count)), lit / count};
}

std::array<Statistics, 2> statisticsOfEyes(const PanelPicture &panel)
{
	const uint32_t eye = panel.width / 2, edge = panel.width * 5 / 32; // the middle 3/8 of each eye
	return {statisticsOf(panel, edge, eye - edge), statisticsOf(panel, eye + edge, panel.width - edge)};
}

} // namespace arift::e2e
