#include "drivers/replay/euroc.h"
#include "drivers/files.h"
#include "runtime/base/euroc_folder.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <png.h>

namespace arift::replay
{

namespace
{

namespace fs = std::filesystem;

/// A PNG opened as far as its header.
struct PngFile {
	png_image image{};

	explicit PngFile(const fs::path &file)
	{
		image.version = PNG_IMAGE_VERSION;
		png_image_begin_read_from_file(&image, file.c_str());
	}
	~PngFile() { png_image_free(&image); }
	PngFile(const PngFile &) = delete;
	bool failed() const { return PNG_IMAGE_FAILED(image); }
	bool isGrey8() const { return (image.format & (PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_ALPHA | PNG_FORMAT_FLAG_LINEAR)) == 0; }
};

/// Times are nanoseconds since 1970: anything a recording can have been made at.
int64_t timeIn(const CsvReader &csv, int64_t previous)
{
	const int64_t time = csv.integer(0);
	if (time < 0 || time > INT64_MAX / 2) csv.complain(0, "a time in nanoseconds");
	if (time <= previous) csv.complain(0, "a time after that of the row before");
	return time;
}

template <typename Timed> XrDuration medianInterval(const std::vector<Timed> &items)
{
	if (items.size() < 2) return second;
	std::vector<XrDuration> intervals;
	for (size_t i = 1; i < items.size(); i++) intervals.push_back(items[i].time - items[i - 1].time);
	std::nth_element(intervals.begin(), intervals.begin() + std::ptrdiff_t(intervals.size() / 2), intervals.end());
	return intervals[intervals.size() / 2];
}

void checkImage(const fs::path &file, const CsvReader &csv, RecordedCamera &camera)
{
	if (!fs::exists(file)) throw InputError("{}: no such file, named in {}", file.string(), csv.where());
	const PngFile png(file);
	if (png.failed()) throw InputError("{}: {}, expected a PNG image; named in {}", file.string(), png.image.message, csv.where());
	if (!png.isGrey8())
		throw InputError("{}: not 8-bit grey, expected an image of one 8-bit channel; named in {}", file.string(), csv.where());
	if (camera.images.empty()) {
		camera.width = png.image.width;
		camera.height = png.image.height;
	}
	if (png.image.width != camera.width || png.image.height != camera.height || camera.width > 8192 || camera.height > 8192)
		throw InputError("{}: {} x {}, expected {} x {}; named in {}", file.string(), png.image.width, png.image.height, camera.width,
						 camera.height, csv.where());
}

/// Times are absolute until the recording's begin is known.
RecordedCamera readCamera(const fs::path &folder)
{
	RecordedCamera camera;
	CsvReader csv(folder / "data.csv");
	for (int64_t previous = -1; csv.next();) {
		previous = timeIn(csv, previous);
		const fs::path file = folder / "data" / fs::path(csv.text(1)).filename();
		checkImage(file, csv, camera);
		camera.images.push_back({previous, file});
	}
	if (camera.images.empty()) throw InputError("{}: no images, expected rows timestamp,filename", csv.where());
	camera.frameRate = 1 / inSeconds(medianInterval(camera.images));
	return camera;
}

std::vector<RecordedImu> readImu(const fs::path &file, int64_t begin, int64_t end)
{
	constexpr double mostAngularVelocity = 100, mostAcceleration = 1000;
	std::vector<RecordedImu> samples;
	CsvReader csv(file);
	for (int64_t previous = -1; csv.next();) {
		previous = timeIn(csv, previous);
		RecordedImu sample{.time = previous - begin};
		for (size_t i = 0; i < 3; i++) {
			sample.angularVelocity[int(i)] = csv.number(1 + i);
			sample.acceleration[int(i)] = csv.number(4 + i);
			if (std::abs(csv.number(1 + i)) > mostAngularVelocity) csv.complain(1 + i, "an angular velocity in rad/s");
			if (std::abs(csv.number(4 + i)) > mostAcceleration) csv.complain(4 + i, "an acceleration in m/s^2");
		}
		if (previous >= begin && previous < end) samples.push_back(sample);
	}
	if (samples.empty()) throw InputError("{}: no sample while the images last, expected some from {} to {}", csv.where(), begin, end);
	return samples;
}

} // namespace

EurocRecording readEuroc(const fs::path &folder)
{
	const auto [root, name, isStereo] = findEuroc(folder);
	EurocRecording recording{.name = name};
	recording.cameras[0] = readCamera(root / "cam0");
	if (isStereo) recording.cameras[1] = readCamera(root / "cam1");

	int64_t begin = INT64_MAX, end = 0;
	for (const RecordedCamera &camera : recording.cameras) {
		if (camera.images.empty()) continue;
		begin = std::min(begin, camera.images.front().time);
		end = std::max(end, camera.images.back().time + fromSeconds(1 / camera.frameRate));
	}
	recording.length = end - begin;
	for (RecordedCamera &camera : recording.cameras)
		for (RecordedImage &image : camera.images) image.time -= begin;
	recording.imu = readImu(root / "imu0" / "data.csv", begin, end);
	recording.imuRate = 1 / inSeconds(medianInterval(recording.imu));
	return recording;
}

bool decodeImage(const fs::path &file, uint32_t width, uint32_t height, std::span<std::byte> pixels)
{
	PngFile png(file);
	if (png.failed() || !png.isGrey8() || png.image.width != width || png.image.height != height) return false;
	if (pixels.size() < size_t(width) * height) return false;
	png.image.format = PNG_FORMAT_GRAY;
	return png_image_finish_read(&png.image, nullptr, pixels.data(), png_int_32(width), nullptr) != 0 && !png.failed();
}

} // namespace arift::replay
