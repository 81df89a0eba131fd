#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"

namespace arift::gpu
{

Device::Device(std::vector<const char *> surfaceExtensions) : handles_(std::make_unique<Handles>(surfaceExtensions)) {}

Device::~Device() = default;

const DeviceIdentity &Device::identity() const { return handles_->identity; }

uint64_t Device::validationMessages() const { return handles_->validationMessages; }

} // namespace arift::gpu
