#include "tests/bench/frames/shown_frames.h"
#include "tests/bench/frames/frame_code.h"
#include "tests/bench/frames/plain_pass.h"
#include "tests/bench/frames/ring_recording.h"
#include "tests/common/temporary_folder.h"
#include "tests/e2e/common/private_service.h"
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <unistd.h>

namespace arift::bench
{

namespace
{

using namespace arift::e2e;

constexpr auto measured = std::chrono::seconds(5);

struct Load {
	const char *content;
	uint32_t quads;
};

std::string ring(const std::filesystem::path &recording)
{
	return "[headset]\ndriver = \"replay\"\nrig = \"arift\"\n[clock]\nmode = \"real\"\n[compositor]\ntarget = \"offscreen\"\n[replay]\n"
		   "recording = \"" +
		   recording.string() + "\"\n";
}
/// The head rests, so that the number is where it is read.
constexpr const char *live = "[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"real\"\n[compositor]\ntarget = \"offscreen\"\n"
							 "[synthetic]\nmotion = \"rest\"\n";

/// User and system time of a process, seconds.
double processorTime(int pid)
{
	std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
	std::string text;
	std::getline(file, text);
	std::istringstream fields(text.substr(text.rfind(')') + 2));
	std::string skipped;
	for (int i = 0; i < 11; ++i) fields >> skipped;
	double user = 0, system = 0;
	fields >> user >> system;
	return (user + system) / double(::sysconf(_SC_CLK_TCK));
}

uint64_t shownOf(const nlohmann::json &status)
{
	for (const auto &client : status["clients"])
		if (client["name"] == "clearing_application") return client["shown"];
	return 0;
}

/// The number of the frame that the left eye sees.
std::optional<uint32_t> codeIn(const PanelPicture &eyes)
{
	// The eye's image is what the application drew, at another size.
	const double scale = double(eyes.width) / 2 / 1122;
	std::array<double, codeCells> cells{};
	for (uint32_t cell = 0; cell < codeCells; ++cell) {
		const double x = eyes.width / 4.0 + (double(cell) + 0.5 - codeCells / 2.0) * codeCell * scale;
		cells[cell] = eyes.rgba[4 * (size_t(eyes.height / 2) * eyes.width + size_t(x)) + 1];
	}
	return decodeFrame(cells);
}

/// What the left eye sees of the camera, beside what the application draws.
int cameraBrightness(const PanelPicture &eyes) { return eyes.rgba[4 * (size_t(eyes.height) * 3 / 5 * eyes.width + eyes.width / 4) + 1]; }

/// What pictures of the panel show, one after another.
struct Seen {
	int decoded = 0, changed = 0; ///< pictures with a frame's code, and with another one than the picture before
	int otherCameraImages = 0;    ///< than the picture before
	uint64_t counted = 0;         ///< by the service, of the frames between the first picture and the last
	uint64_t drawn = 0;           ///< by the application between them
};
constexpr int pictures = 8;

/// The service is asked after the first picture and before the last, so that it counts no more frames than were drawn.
Seen lookAt(PrivateService &service)
{
	Seen seen;
	std::optional<uint32_t> last;
	int camera = -1;
	uint64_t countedFirst = 0;
	for (int i = 0; i < pictures; ++i) {
		const uint64_t before = shownOf(service.status());
		const PanelPicture eyes = service.screenshot(ipc::PictureKind::eyes);
		seen.otherCameraImages += camera >= 0 && cameraBrightness(eyes) != camera;
		camera = cameraBrightness(eyes);
		const auto code = codeIn(eyes);
		if (!code) continue;
		++seen.decoded;
		if (last) {
			const uint32_t since = (*code - *last) & ((1u << codeBits) - 1);
			seen.drawn += since;
			seen.changed += since > 0;
			seen.counted = before - countedFirst;
		} else {
			countedFirst = shownOf(service.status());
		}
		last = code;
	}
	return seen;
}

/// Pictures of the panel show the application's frames and the cameras' one after another, as many as the service counts.
void checkCount(PrivateService &service, const std::string &what, bool camerasAreSeen)
{
	const Seen seen = lookAt(service);
	const auto of = [](int count) { return std::to_string(count) + " of " + std::to_string(pictures) + " pictures show "; };
	if (seen.decoded < pictures / 2 || seen.changed < seen.decoded / 2)
		throw std::runtime_error(what + ": " + of(seen.decoded) + "a frame's code, " + of(seen.changed) + "another than the one before");
	if (camerasAreSeen && seen.otherCameraImages < pictures / 2)
		throw std::runtime_error(what + ": " + of(seen.otherCameraImages) + "another camera image than the one before");
	if (seen.counted > seen.drawn)
		throw std::runtime_error(what + ": the service counts " + std::to_string(seen.counted) + " frames where pictures show " +
								 std::to_string(seen.drawn));
}

double measure(const std::string &configuration, const char *cameras, const Load &load, double unit)
{
	PrivateService service(configuration);
	ChildProcess application = service.start("clearing_application", {load.content, std::to_string(load.quads)});
	const std::string what =
		std::string(cameras) + ", " + load.content + " layer" + (load.quads > 0 ? " and " + std::to_string(load.quads) + " quads" : "");
	if (!eventually(service, [](const auto &status) { return shownOf(status) > 30; }))
		throw std::runtime_error(what + ": nothing is shown\n" + application.output());
	const uint64_t before = shownOf(service.status(true));
	const XrTime begin = realTime();
	const double used = processorTime(service.process().pid()) + processorTime(application.pid());
	std::this_thread::sleep_for(measured); // the machine is the system's alone while it is measured
	const double cost = processorTime(service.process().pid()) + processorTime(application.pid()) - used;
	const double seconds = inSeconds(realTime() - begin);
	const nlohmann::json status = service.status();
	const double shown = double(shownOf(status) - before);
	if (shown == 0) throw std::runtime_error(what + ": no frame was shown");
	const double each = 1e3 * cost / shown;
	std::printf("%-52s %5.1f ms of CPU per frame shown (%4.1f units), %4.1f shown per second\n", what.c_str(), each, each / unit,
				shown / seconds);
	std::fflush(stdout);
	checkCount(service, what, configuration != live && std::string_view(load.content) != "opaque");
	return each;
}

} // namespace

void shownFrames()
{
	const double unit = plainPassMilliseconds();
	std::printf("%-52s %5.1f ms of CPU: the unit\n", "one sample per pixel, 1280 x 800", unit);
	const test::TemporaryFolder folder;
	writeRing(folder.path());
	const std::string still = ring(folder.path());
	const double translucent = measure(still, "ring of images at 30 Hz", {"translucent", 0}, unit);
	measure(still, "ring of images at 30 Hz", {"opaque", 0}, unit);
	measure(still, "ring of images at 30 Hz", {"transparent", 0}, unit);
	const double quads = measure(still, "ring of images at 30 Hz", {"translucent", 4}, unit);
	std::printf("%-52s %5.1f ms\n", "four quads more", quads - translucent);
	measure(live, "synthetic cameras live", {"translucent", 0}, unit);
	measure(live, "synthetic cameras live", {"transparent", 0}, unit);
}

} // namespace arift::bench
