// The [[cameras]] tables of a Rig file.
#pragma once
#include "runtime/base/toml.h"
#include "runtime/optics/rig.h"

namespace arift
{

/// `file`: the Rig file, for warnings.
RigCamera readRigCamera(TomlTable &table, const std::filesystem::path &file);

/// A unit quaternion x, y, z, w; the identity where the key is absent.
XrQuaternionf readOrientation(TomlTable &table, const char *key);
/// Three numbers, metres, each at most `limit` in size.
XrVector3f readPosition(TomlTable &table, const char *key, double limit);

} // namespace arift
