// A Rig from the calibration that comes with a recording in the EuRoC/ASL folder layout.
#pragma once
#include "runtime/optics/rig.h"

namespace arift
{

/// Reads the sensor.yaml of cam0, of cam1 where the recording has one, and of imu0 (base/euroc_folder.h says where). T_BS there is the
/// sensor in the body frame, camera axes x right, y down, z forward; lenses are pinhole with radial-tangential or equidistant distortion.
/// The head's frame is put midway between both cameras (into the only one), turned as they are on average (forward -z, image columns along
/// +x), so that a recording replays upright whatever its body frame was. Panel, lens, eyes and neck are the DK1's. Throws InputError with
/// file and line.
Rig rigFromEuroc(const std::filesystem::path &recording);

} // namespace arift
