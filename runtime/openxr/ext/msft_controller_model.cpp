#include "runtime/openxr/ext/msft_controller_model.h"
#include "runtime/openxr/interaction_profiles.h"

namespace arift::openxr
{
namespace
{

[[noreturn]] void refuse(XrControllerModelKeyMSFT key)
{
	throw Error(XR_ERROR_CONTROLLER_MODEL_KEY_INVALID_MSFT, "{} is no key of xrGetControllerModelKeyMSFT", uint64_t(key));
}

} // namespace

void getControllerModelKey(Session &session, XrPath topLevelUserPath, XrControllerModelKeyStateMSFT &state)
{
	const std::string &text = session.instance.paths.text(topLevelUserPath);
	if (!isTopLevelUserPath(text, session.instance.features()))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no top level user path", text);
	state.modelKey = XR_NULL_CONTROLLER_MODEL_KEY_MSFT;
}

XrResult loadControllerModel(Session &, XrControllerModelKeyMSFT key, OutputArray<uint8_t>) { refuse(key); }

void getControllerModelProperties(Session &, XrControllerModelKeyMSFT key, XrControllerModelPropertiesMSFT &) { refuse(key); }

void getControllerModelState(Session &, XrControllerModelKeyMSFT key, XrControllerModelStateMSFT &) { refuse(key); }

} // namespace arift::openxr
