// What monitors ask: status, pictures, settings, recentring, the end.
#include "runtime/compositor/compositor.h"
#include "runtime/ipc/request.h"
#include "runtime/service/client.h"
#include "runtime/service/status.h"
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

constexpr XrDuration pictureLimit = 10 * second;

} // namespace

void Client::answer(const ipc::GetStatus &message)
{
	const Opened opened = world_.await(Stage::ready, ipc::openingLimit);
	nlohmann::json status = describeService(world_.config, opened.compositor->figures(message.resetFigures != 0));
	status["passthrough"] = {{"raw", opened.compositor->rawPassthrough()}};
	status["applications"] = describe(*world_.applicationSettings.lock());
	opened.describeHeadset(status);
	status["input"] = describeInput(world_.config.input);
	world_.describeClients(status["clients"] = nlohmann::json::array());
	// Names come from applications and devices: what is no UTF-8 in them must not keep the rest from being told.
	const std::string text = status.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
	const UniqueFd memory = ipc::makeSealedCopy("arift-status", std::as_bytes(std::span(text)));
	ipc::Status answer;
	answer.size = text.size();
	const int fd = memory.get();
	reply(message.header, answer, {&fd, 1});
}

void Client::answer(const ipc::Screenshot &message)
{
	const Opened opened = world_.await(Stage::ready, ipc::openingLimit);
	const auto picture = opened.compositor->picture(message.kind, pictureLimit);
	if (!picture) throw Refused(XR_ERROR_RUNTIME_FAILURE, "no image was finished within ten seconds");
	const UniqueFd memory = ipc::makeSealedCopy("arift-picture", picture->image.pixels);
	ipc::Picture answer;
	answer.width = picture->image.width;
	answer.height = picture->image.height;
	answer.displayTime = picture->displayTime;
	const int fd = memory.get();
	reply(message.header, answer, {&fd, 1});
}

/// It is in effect whether or not it can be kept.
void Client::keep(const std::vector<std::string> &table, const Overrides::Values &values)
{
	try {
		world_.overrides.keep(table, values);
	} catch (const std::exception &problem) {
		log::warning("what was set holds until the service ends: {}", problem.what());
	}
}

void Client::answer(const ipc::SetSetting &message)
{
	const Opened opened = world_.await(Stage::ready, ipc::openingLimit);
	switch (message.setting) {
	case ipc::Setting::viewOffset:
		if (message.value < 0 || message.value > 1)
			throw Refused(XR_ERROR_VALIDATION_FAILURE,
						  fmt::format("view_offset = {}, expected a number from 0 (eye) to 1 (camera)", message.value));
		world_.views.update([&](ipc::ViewTable &views) { views.viewOffset = message.value; });
		keep({"passthrough"}, {{"view_offset", message.value}});
		break;
	case ipc::Setting::passthroughDistance:
		if (message.value < 0.1f || message.value > 1000)
			throw Refused(XR_ERROR_VALIDATION_FAILURE,
						  fmt::format("passthrough_distance = {}, expected metres from 0.1 to 1000", message.value));
		opened.compositor->setPassthroughDistance(double(message.value));
		keep({"passthrough"}, {{"distance", message.value}});
		break;
	case ipc::Setting::rawPassthrough: opened.compositor->setRawPassthrough(message.value != 0); break;
	}
	reply(message.header, ipc::Done{});
}

void Client::answer(const ipc::Recenter &message)
{
	world_.await(Stage::ready, ipc::openingLimit);
	world_.recenter();
	reply(message.header, ipc::Done{});
}

void Client::answer(const ipc::ShutDown &message)
{
	reply(message.header, ipc::Done{});
	world_.requestStop();
}

void Client::answer(const ipc::ForcePassthrough &message)
{
	const std::string name = ipc::textOf(message.application);
	if (name.empty()) throw Refused(XR_ERROR_VALIDATION_FAILURE, "an application without a name has no settings");
	const ForcedPassthrough forced{message.mode, {message.colour, message.tolerance, message.softness}, message.opacity};
	world_.applicationSettings.update([&](ApplicationTable &table) { table[name].passthrough = forced; });
	world_.forEachSession([&](const std::string &application, Session &session) {
		if (application == name) present(session, name);
	});
	keep({"applications", name}, {{"passthrough", nameOf(forced.mode)},
								  {"color", textOf(forced.key.colour)},
								  {"tolerance", forced.key.tolerance},
								  {"softness", forced.key.softness},
								  {"opacity", forced.opacity}});
	reply(message.header, ipc::Done{});
}

void describeClient(nlohmann::json &list, const Client::About &about)
{
	if (!about.application) return;
	nlohmann::json entry{{"pid", about.pid}, {"name", about.name}, {"state", "connected"},
						 {"submitted", 0},   {"shown", 0},         {"latencyMs", describe(Figure{})}};
	if (about.session) {
		const Session::Count count = about.session->count();
		entry["state"] = about.session->running() ? "running" : "idle";
		entry["submitted"] = count.submitted;
		entry["shown"] = count.shown;
		entry["latencyMs"] = describe(about.session->latency());
	}
	entry["swapchains"] = nlohmann::json::array();
	if (about.swapchains)
		for (const Swapchains::About &swapchain : about.swapchains->abouts())
			entry["swapchains"].push_back({{"width", swapchain.spec.width},
										   {"height", swapchain.spec.height},
										   {"arrayLayers", swapchain.spec.arrayLayers},
										   {"format", swapchain.spec.format},
										   {"images", swapchain.imageCount},
										   {"copied", swapchain.sharing == ipc::Sharing::copies}});
	list.push_back(std::move(entry));
}

} // namespace arift
