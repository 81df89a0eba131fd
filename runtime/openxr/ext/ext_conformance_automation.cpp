#include "runtime/openxr/ext/ext_conformance_automation.h"
#include "runtime/openxr/interaction_profiles.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace arift::openxr
{
namespace
{

void requireUser(const Session &session, XrPath path)
{
	const std::string &text = session.instance.paths.text(path);
	if (!isTopLevelUserPath(text, session.instance.features()))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no top level user path", text);
}

void setValue(Session &session, XrPath user, XrPath source, const InputValue &value)
{
	requireUser(session, user);
	const std::string &path = session.instance.paths.text(source);
	if (!path.starts_with(session.instance.paths.text(user) + "/"))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} does not lie below {}", path, session.instance.paths.text(user));
	session.input.changeDevices([&](InputDevices &devices) {
		devices[user].isPlayed = true;
		devices[user].values[source] = value;
	});
}

/// Before the person, where hands are held, until the application says otherwise.
Placed usualPlace(std::string_view user)
{
	const float aside = user.ends_with("left") ? -0.2f : user.ends_with("right") ? 0.2f : 0;
	return {SpaceKind::local, {identityOrientation, {aside, -0.3f, -0.4f}}};
}

} // namespace

void setInputDeviceActive(Session &session, XrPath interactionProfile, XrPath topLevelPath, XrBool32 isActive)
{
	requireUser(session, topLevelPath);
	const std::string &name = session.instance.paths.text(interactionProfile);
	if (!findInteractionProfile(name, session.instance.features()))
		throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no interaction profile of this runtime", name);
	const std::string &user = session.instance.paths.text(topLevelPath);
	const Placed place = usualPlace(user);
	std::array<XrPath, 2> surfaces{};
	std::ranges::transform(std::array{"/input/grip_surface/pose", "/input/palm_ext/pose"}, surfaces.begin(),
						   [&](const char *surface) { return session.instance.paths.atom(user + surface); });
	session.input.changeDevices([&](InputDevices &devices) {
		InputDevice &device = devices[topLevelPath];
		device.isPlayed = true;
		device.profile = interactionProfile;
		device.isActive = isActive == XR_TRUE;
		device.place = place;
		for (const XrPath surface : surfaces) device.values.try_emplace(surface, InputValue{{}, onSurface(place)});
	});
}

void setInputDeviceStateBool(Session &session, XrPath topLevelPath, XrPath inputSourcePath, XrBool32 state)
{
	setValue(session, topLevelPath, inputSourcePath, {{state == XR_TRUE ? 1.0f : 0.0f, 0}, {}});
}

void setInputDeviceStateFloat(Session &session, XrPath topLevelPath, XrPath inputSourcePath, float state)
{
	if (!std::isfinite(state)) throw Error(XR_ERROR_VALIDATION_FAILURE, "the state is {}", state);
	setValue(session, topLevelPath, inputSourcePath, {{state, 0}, {}});
}

void setInputDeviceStateVector2f(Session &session, XrPath topLevelPath, XrPath inputSourcePath, XrVector2f state)
{
	if (!std::isfinite(state.x) || !std::isfinite(state.y))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "the state is ({}, {})", state.x, state.y);
	setValue(session, topLevelPath, inputSourcePath, {state, {}});
}

void setInputDeviceLocation(Session &session, XrPath topLevelPath, XrPath inputSourcePath, Space &space, XrPosef pose)
{
	if (&space.session != &session) throw Error(XR_ERROR_VALIDATION_FAILURE, "the space belongs to another session");
	setValue(session, topLevelPath, inputSourcePath, {{}, placedIn(space, pose)});
}

} // namespace arift::openxr
