#include "tests/e2e/common/private_service.h"
#include "runtime/ipc/shared_memory.h"
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

constexpr XrDuration limit = 30 * second; // real time; a software renderer on a busy machine is slow

std::optional<ipc::Socket> tryConnect(const std::filesystem::path &path)
{
	UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
	sockaddr_un address{};
	address.sun_family = AF_UNIX;
	if (path.native().size() >= sizeof(address.sun_path)) throw std::runtime_error("too long for a socket: " + path.string());
	path.native().copy(address.sun_path, sizeof(address.sun_path) - 1);
	if (::connect(fd.get(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0) return std::nullopt;
	return ipc::Socket(std::move(fd));
}

ChildProcess startService(const PrivateTree &tree, const std::string &configuration, std::vector<std::string> arguments)
{
	const std::filesystem::path file = tree.write("config/arift/config.toml", configuration);
	arguments.insert(arguments.begin(), {(programDirectory() / "arift-service").string(), "--config", file.string()});
	return ChildProcess(arguments, tree.environment(), tree.root() / "service.log");
}

/// The service refuses what it cannot answer in time, devices not yet open or no image finished: on a busy machine it can a little later.
template <typename Reply, typename Request> ipc::Answer<Reply> askAgain(ipc::Requests &connection, const Request &request)
{
	auto answer = connection.ask<Reply>(request, limit);
	for (int again = 0; answer.how == ipc::Answered::refused && again < 5; ++again) answer = connection.ask<Reply>(request, limit);
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

PrivateService::PrivateService(const std::string &configuration, std::vector<std::string> arguments)
	: tree_(std::make_unique<PrivateTree>()), service_(startService(*tree_, configuration, std::move(arguments)))
{
	const XrTime deadline = realTime() + limit;
	const std::filesystem::path socket = tree_->root() / "runtime/arift/service.sock";
	while (!connection_) {
		if (!service_.running()) throw std::runtime_error("arift-service ended at once:\n" + service_.output());
		if (realTime() > deadline) throw std::runtime_error("arift-service does not listen:\n" + service_.output());
		if (auto connected = tryConnect(socket))
			connection_ = std::make_unique<ipc::Requests>(std::move(*connected));
		else
			std::this_thread::sleep_for(std::chrono::milliseconds(10));
	}
	ipc::Hello hello;
	hello.role = ipc::Role::monitor;
	hello.pid = uint32_t(::getpid());
	ipc::copyText(hello.applicationName, "end-to-end test");
	const auto answer = connection_->ask<ipc::Welcome>(hello, limit);
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
	const auto answer = connection_->command(request, limit);
	if (!answer) fail("SetSetting", answer.failure);
}

} // namespace arift::e2e
