// Recordings. Input: one byte that chooses the reader, then a .brd file; a trajectory; or cam0/data.csv, imu0/data.csv and an image,
// separated by lines of four dashes.
#include "drivers/replay/brd_file.h"
#include "drivers/replay/euroc.h"
#include "runtime/base/error.h"
#include "runtime/base/pose.h"
#include "tests/fuzz/input.h"
#include <cmath>
#include <vector>

using namespace arift;

namespace
{

using fuzz::Bytes;

void checkTrajectory(const Trajectory &trajectory)
{
	fuzz::require(!trajectory.empty(), "a trajectory has poses");
	for (size_t i = 1; i < trajectory.size(); ++i) fuzz::require(trajectory[i].seconds > trajectory[i - 1].seconds, "times rise");
	const TimedPose middle = interpolate(trajectory, (trajectory.front().seconds + trajectory.back().seconds) / 2);
	fuzz::require(std::abs(glm::length(middle.orientation) - 1) < 1e-3, "orientations are unit quaternions");
}

void readBrdFile(const fuzz::Folder &folder, Bytes bytes)
{
	const replay::BrdRecording recording = replay::readBrd(folder.write("recording.brd", bytes));
	fuzz::require(!recording.records.empty() && recording.rate > 0, "a recording has records and a rate");
	const glm::dquat axes = replay::imuInHead(recording);
	fuzz::require(std::abs(glm::length(axes) - 1) < 1e-3, "the sensor's axes in the head are a rotation");
	checkTrajectory(replay::headTrajectory(recording, axes));
}

void readEurocFolder(const fuzz::Folder &folder, Bytes rest)
{
	folder.write("euroc/cam0/data.csv", fuzz::nextPart(rest));
	folder.write("euroc/imu0/data.csv", fuzz::nextPart(rest));
	folder.write("euroc/cam0/data/1.png", rest);
	const replay::EurocRecording recording = replay::readEuroc(folder.path() / "euroc");
	const replay::RecordedCamera &camera = recording.cameras[0];
	fuzz::require(!camera.images.empty() && !recording.imu.empty() && recording.length > 0, "a recording has images, samples and a length");
	if (uint64_t(camera.width) * camera.height > 1 << 20) return; // decoding is the PNG library's business
	std::vector<std::byte> pixels(size_t(camera.width) * camera.height);
	replay::decodeImage(camera.images[0].file, camera.width, camera.height, pixels);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const fuzz::Folder folder;
	if (size == 0) return 0;
	const Bytes bytes(data + 1, size - 1);
	try {
		switch (data[0] % 3) {
		case 0: readBrdFile(folder, bytes); break;
		case 1: checkTrajectory(readTrajectoryCsv(folder.write("trajectory.csv", bytes))); break;
		default: readEurocFolder(folder, bytes);
		}
	} catch (const InputError &error) {
		fuzz::require(std::string(error.what()).find(folder.path()) != std::string::npos, "the complaint names the file");
	}
	return 0;
}
