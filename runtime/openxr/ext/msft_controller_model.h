// XR_MSFT_controller_model: nothing that people hold here has a model, so every key is null and none can be asked about.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

/// XR_NULL_CONTROLLER_MODEL_KEY_MSFT for every top level user path. Throws XR_ERROR_PATH_INVALID or XR_ERROR_PATH_UNSUPPORTED.
void getControllerModelKey(Session &session, XrPath topLevelUserPath, XrControllerModelKeyStateMSFT &state);
// All of them throw XR_ERROR_CONTROLLER_MODEL_KEY_INVALID_MSFT.
XrResult loadControllerModel(Session &session, XrControllerModelKeyMSFT key, OutputArray<uint8_t> model);
void getControllerModelProperties(Session &session, XrControllerModelKeyMSFT key, XrControllerModelPropertiesMSFT &properties);
void getControllerModelState(Session &session, XrControllerModelKeyMSFT key, XrControllerModelStateMSFT &state);

} // namespace arift::openxr
