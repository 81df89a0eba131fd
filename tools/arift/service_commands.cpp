#include "runtime/base/error.h"
#include "runtime/ipc/launch.h"
#include "runtime/ipc/shared_memory.h"
#include "tools/arift/commands.h"
#include "tools/arift/monitor.h"
#include "tools/arift/png_file.h"
#include <cerrno>
#include <cstring>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace arift::tools
{

namespace
{

template <typename Reply> ipc::Mapping mapped(const ipc::Answer<Reply> &answer, size_t size)
{
	if (answer.fdCount != 1) throw std::runtime_error("the service answered without its content");
	return ipc::mapReadOnly(answer.fds[0].get(), size);
}

void print(const nlohmann::json &status)
{
	const auto &service = status["service"], &headset = status["headset"], &frames = status["frames"], &tracker = status["tracker"];
	const auto figure = [](const nlohmann::json &value) {
		return fmt::format("{:.1f} ms (p99 {:.1f})", value["median"].get<double>(), value["p99"].get<double>());
	};
	std::cout << fmt::format("service   {} (pid {}), up {:.0f} s, {} clock\n", service["version"].get<std::string>(),
							 service["pid"].get<int>(), service["uptime"].get<double>(), status["clock"]["mode"].get<std::string>());
	std::cout << fmt::format("headset   {}, rig \"{}\"\n", headset["name"].get<std::string>(), headset["rig"].get<std::string>());
	if (const auto problem = headset["problem"].get<std::string>(); !problem.empty()) std::cout << "          " << problem << "\n";
	std::cout << fmt::format("frames    {} shown, {:.1f} per second, {} missed, {:.1f} ms of CPU each\n", frames["shown"].get<uint64_t>(),
							 frames["perSecond"].get<double>(), frames["missed"].get<uint64_t>(), frames["cpuMsPerFrame"].get<double>());
	std::cout << fmt::format("          camera age {}, pose age {}, composing {}\n", figure(frames["cameraAgeMs"]),
							 figure(frames["poseAgeMs"]), figure(frames["composeMs"]));
	std::cout << fmt::format("          {} gaps, the longest between two images {:.1f} ms, {} images without a camera{}\n",
							 frames["gaps"].get<uint64_t>(), frames["longestGapMs"].get<double>(), frames["withoutCamera"].get<uint64_t>(),
							 status["passthrough"]["raw"].get<bool>() ? "; raw passthrough: no holograms" : "");
	std::string stages;
	for (const char *stage : {"wake", "choose", "plan", "upload", "record", "draw", "present"}) // in their order in time
		stages += fmt::format(" {} {:.1f}", stage, frames["stagesMs"][stage]["median"].get<double>());
	std::cout << fmt::format("          of that, in ms:{}\n", stages);
	for (const auto &camera : status["cameras"])
		std::cout << fmt::format("camera    {}: {:.1f} per second, {} received, {} dropped, {} malformed\n",
								 camera["name"].get<std::string>(), camera["frameRate"].get<double>(), camera["received"].get<uint64_t>(),
								 camera["dropped"].get<uint64_t>(), camera["malformed"].get<uint64_t>());
	std::cout << fmt::format("tracker   {}: {:.0f} samples per second, {} lost, {} malformed reports\n", tracker["name"].get<std::string>(),
							 tracker["rate"].get<double>(), tracker["lost"].get<uint64_t>(), tracker["malformed"].get<uint64_t>());
	for (const auto &device : status["input"]) {
		const auto problem = device["problem"].get<std::string>();
		std::cout << fmt::format("input     {} ({}, {}): {}{}\n", device["name"].get<std::string>(), device["kind"].get<std::string>(),
								 device["node"].get<std::string>(), device["on"].get<bool>() ? "on" : "off",
								 problem.empty() ? "" : fmt::format(", but cannot be read: {}", problem));
	}
	for (const auto &application : status["applications"])
		std::cout << fmt::format("settings  of \"{}\": passthrough {}\n", application["name"].get<std::string>(),
								 application["passthrough"].get<std::string>());
	for (const auto &client : status["clients"]) {
		std::cout << fmt::format("client    {} (pid {}): {}, {} submitted, {} shown, seen {} after they came\n",
								 client["name"].get<std::string>(), client["pid"].get<int>(), client["state"].get<std::string>(),
								 client["submitted"].get<uint64_t>(), client["shown"].get<uint64_t>(), figure(client["latencyMs"]));
		for (const auto &swapchain : client["swapchains"])
			std::cout << fmt::format("          {} images of {}x{}, {} layers, VkFormat {}, {}\n", swapchain["images"].get<int>(),
									 swapchain["width"].get<int>(), swapchain["height"].get<int>(), swapchain["arrayLayers"].get<int>(),
									 swapchain["format"].get<int>(),
									 swapchain["copied"].get<bool>() ? "copied through the CPU's memory" : "in shared memory of the GPU");
	}
}

} // namespace

void runService(const std::vector<std::string> &arguments)
{
	const std::string program = ipc::findService().string();
	if (program.empty()) throw std::runtime_error("arift-service is neither beside this program nor on PATH");
	std::vector<std::string> texts{program};
	texts.insert(texts.end(), arguments.begin(), arguments.end());
	std::vector<char *> pointers;
	for (std::string &text : texts) pointers.push_back(text.data());
	pointers.push_back(nullptr);
	::execv(program.c_str(), pointers.data());
	throw InputError("{}: {}", program, std::strerror(errno));
}

nlohmann::json statusOf(Monitor &monitor, bool resetFigures)
{
	ipc::GetStatus request;
	request.resetFigures = resetFigures;
	const auto answer = monitor.ask<ipc::Status>(request);
	const ipc::Mapping memory = mapped(answer, answer.reply.size);
	return nlohmann::json::parse(std::string_view(static_cast<const char *>(memory.address()), answer.reply.size));
}

void status(const StatusOptions &options)
{
	Monitor monitor;
	const nlohmann::json status = statusOf(monitor, options.reset);
	if (options.json)
		std::cout << status.dump(2) << '\n';
	else
		print(status);
}

void screenshot(const std::string &file, bool eyes)
{
	Monitor monitor;
	ipc::Screenshot request;
	request.kind = eyes ? ipc::PictureKind::eyes : ipc::PictureKind::panel;
	const auto answer = monitor.ask<ipc::Picture>(request);
	const ipc::Picture &picture = answer.reply;
	const size_t size = size_t(picture.width) * picture.height * 4;
	const ipc::Mapping memory = mapped(answer, size);
	writePng(file, picture.width, picture.height, {static_cast<const std::byte *>(memory.address()), size});
}

void recenter() { Monitor().ask<ipc::Done>(ipc::Recenter{}); }

void stop() { Monitor().ask<ipc::Done>(ipc::ShutDown{}); }

void showRawPassthrough(bool raw)
{
	ipc::SetSetting request;
	request.setting = ipc::Setting::rawPassthrough;
	request.value = raw ? 1 : 0;
	Monitor().ask<ipc::Done>(request);
}

void set(const std::string &name, double value)
{
	ipc::SetSetting request;
	request.setting = name == "view_offset" ? ipc::Setting::viewOffset : ipc::Setting::passthroughDistance;
	request.value = float(value);
	Monitor().ask<ipc::Done>(request);
}

} // namespace arift::tools
