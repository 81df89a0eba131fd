// arift: the command line. Parses and hands over; each command is a function in commands.h.
#include "tools/arift/commands.h"
#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

namespace
{

using namespace arift;

void addService(CLI::App &app)
{
	auto *command = app.add_subcommand("service", "run the service here, in the foreground");
	command->prefix_command()->allow_extras();
	command->footer("Every option is handed to arift-service: --config FILE, --set KEY.PATH=VALUE, --idle-exit SECONDS.");
	command->callback([command] { tools::runService(command->remaining()); });
}

void addStatus(CLI::App &app)
{
	auto *command = app.add_subcommand("status", "what the service does and how well");
	auto options = std::make_shared<tools::StatusOptions>();
	command->add_flag("--json", options->json, "as JSON");
	command->add_flag("--reset", options->reset, "start the record of frame figures anew after this answer");
	command->callback([options] { tools::status(*options); });
}

void addScreenshot(CLI::App &app)
{
	auto *command = app.add_subcommand("screenshot", "save what the display shows");
	auto file = std::make_shared<std::string>();
	auto eyes = std::make_shared<bool>(false);
	command->add_option("FILE", *file, "PNG file to write")->required();
	command->add_flag("--eyes", *eyes, "both eyes before the lens correction, side by side");
	command->callback([file, eyes] { tools::screenshot(*file, *eyes); });
}

void addRegistration(CLI::App &app)
{
	auto everybody = std::make_shared<bool>(false);
	const auto add = [&](const char *name, const char *text, void (*run)(bool)) {
		auto *command = app.add_subcommand(name, text);
		const std::string userText = "for this user (default)";
		auto *user = command->add_flag("--user", userText);
		command->add_flag("--system", *everybody, "for every user of this machine (as root)")->excludes(user);
		command->callback([everybody, run] { run(*everybody); });
	};
	add("register", "make ARift the OpenXR runtime that applications use", tools::registerRuntime);
	add("unregister", "put back what was registered before", tools::unregisterRuntime);
}

void addSettings(CLI::App &app)
{
	app.add_subcommand("recenter", "straight ahead is where the head looks now")->callback([] { tools::recenter(); });
	app.add_subcommand("stop", "end the service")->callback([] { tools::stop(); });
	auto *command = app.add_subcommand("set", "change a setting of the running service");
	auto name = std::make_shared<std::string>();
	auto value = std::make_shared<double>(0);
	command->add_option("NAME", *name, "view_offset (0 eye .. 1 camera) or passthrough_distance (metres)")
		->required()
		->check(CLI::IsMember({"view_offset", "passthrough_distance"}));
	command->add_option("VALUE", *value, "a number")->required();
	command->callback([name, value] { tools::set(*name, *value); });
}

void addPassthrough(CLI::App &app)
{
	auto *command = app.add_subcommand("passthrough", "the cameras behind applications; alone: what is set for which");
	auto options = std::make_shared<tools::PassthroughOptions>();
	command->add_option("APPLICATION", options->application,
						"its name; or raw: the cameras alone, without holograms; or holograms: as usual again");
	command->add_option("MODE", options->mode,
						"off: as the application wants it; alpha: through its pictures' alpha; chroma: where they have a colour; "
						"underlay: where it shows nothing");
	command->add_option("--color", options->colour, "chroma: that colour, RRGGBB");
	command->add_option("--tolerance", options->tolerance, "chroma: colours nearer than this are that colour, 0 .. 1");
	command->add_option("--softness", options->softness, "chroma: how soft the edge is, 0 .. 1");
	command->add_option("--opacity", options->opacity, "of the application's pictures, 0 .. 1");
	command->footer("What is not given stays as it is. It is kept, also for an application that is not there yet.");
	command->callback([options] {
		const std::string &name = options->application;
		if (name.empty()) return tools::listPassthrough();
		if (!options->mode.empty()) return tools::forcePassthrough(*options);
		if (name != "raw" && name != "holograms")
			throw CLI::ValidationError(name, "expected an application and its kind of passthrough; or raw or holograms alone");
		tools::showRawPassthrough(name == "raw");
	});
}

} // namespace

int main(int argc, char **argv)
{
	std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error of who writes it
	CLI::App app("ARift: augmented reality on the camera-modified Oculus Rift DK1.", "arift");
	app.require_subcommand(1);
	app.set_version_flag("--version", ARIFT_VERSION);
	addService(app);
	addStatus(app);
	addScreenshot(app);
	addRegistration(app);
	addSettings(app);
	addPassthrough(app);
	try {
		app.parse(argc, argv);
		return 0;
	} catch (const CLI::ParseError &problem) {
		return app.exit(problem);
	} catch (const std::exception &problem) {
		std::cerr << "arift: " << problem.what() << '\n';
		return 1;
	}
}
