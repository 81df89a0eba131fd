#include "runtime/openxr/interaction_profiles.h"
#include <algorithm>

namespace arift::openxr
{
namespace
{

using namespace std::literals;

constexpr std::string_view input = "/input/";

bool isThere(const InteractionProfile &profile, const Features &features)
{
	const bool inCore = profile.since == Since::version1_0 || (profile.since == Since::version1_1 && features.is1_1);
	return inCore || (profile.extension != Extension::count && features.extensions.has(profile.extension));
}

XrActionType typeOf(char letter)
{
	switch (letter) {
	case 'b': return XR_ACTION_TYPE_BOOLEAN_INPUT;
	case 'f': return XR_ACTION_TYPE_FLOAT_INPUT;
	case 'v': return XR_ACTION_TYPE_VECTOR2F_INPUT;
	case 'p': return XR_ACTION_TYPE_POSE_INPUT;
	default: return XR_ACTION_TYPE_VIBRATION_OUTPUT;
	}
}

bool takePrefix(std::string_view &word, std::string_view prefix)
{
	if (!word.starts_with(prefix)) return false;
	word.remove_prefix(prefix.size());
	return true;
}

/// One word of InteractionProfile::components; nothing where it is not for this hand or not there.
std::optional<Component> componentIn(std::string_view word, std::string_view userPath, const Features &features)
{
	if (takePrefix(word, "L:") && !userPath.ends_with("/left")) return {};
	if (takePrefix(word, "R:") && !userPath.ends_with("/right")) return {};
	if (takePrefix(word, "1.1:") && !features.is1_1) return {};
	if (takePrefix(word, "fb:") && !features.extensions.has(Extension::FB_touch_controller_proximity)) return {};
	const size_t colon = word.rfind(':');
	const std::string_view path = word.substr(0, colon);
	return Component{path.starts_with('/') ? std::string(path) : std::string(input).append(path), typeOf(word[colon + 1])};
}

bool isHand(std::string_view userPath) { return userPath.ends_with("/left") || userPath.ends_with("/right"); }

/// XR_EXT_dpad_binding: every thumbstick and trackpad is a directional pad as well; only the latter has a centre to press.
void addDirections(std::vector<Component> &components)
{
	for (size_t i = 0, count = components.size(); i < count; ++i) {
		if (components[i].type != XR_ACTION_TYPE_VECTOR2F_INPUT) continue;
		const std::string pad = components[i].path;
		for (const std::string_view direction : {"up"sv, "down"sv, "left"sv, "right"sv, "center"sv})
			if (direction != "center" || pad.ends_with("trackpad"))
				components.push_back({pad + "/dpad_" + std::string(direction), XR_ACTION_TYPE_BOOLEAN_INPUT});
	}
}

/// How well a component suits an action that was bound to its parent; the least is the best.
size_t unsuitability(std::string_view component, XrActionType type)
{
	constexpr std::array forBoolean{"/click"sv, "/value"sv, "/force"sv, "/touch"sv};
	constexpr std::array forFloat{"/value"sv, "/force"sv, "/click"sv};
	const std::span<const std::string_view> wanted =
		type == XR_ACTION_TYPE_FLOAT_INPUT ? std::span<const std::string_view>(forFloat) : std::span<const std::string_view>(forBoolean);
	const auto found = std::ranges::find_if(wanted, [&](std::string_view ending) { return component.ends_with(ending); });
	return size_t(found - wanted.begin());
}

} // namespace

const InteractionProfile *findInteractionProfile(std::string_view path, const Features &features)
{
	if (!takePrefix(path, "/interaction_profiles/")) return nullptr;
	for (const InteractionProfile &profile : interactionProfiles())
		if (profile.name == path && isThere(profile, features)) return &profile;
	return nullptr;
}

std::vector<Component> componentsOf(const InteractionProfile &profile, std::string_view userPath, const Features &features)
{
	std::vector<Component> components;
	for (std::string_view rest = profile.components; !rest.empty();) {
		const size_t end = std::min(rest.find(' '), rest.size());
		if (auto component = componentIn(rest.substr(0, end), userPath, features)) components.push_back(std::move(*component));
		rest.remove_prefix(std::min(end + 1, rest.size()));
	}
	const auto addPose = [&](const char *path) { components.push_back({path, XR_ACTION_TYPE_POSE_INPUT}); };
	if (isHand(userPath)) {
		if (features.is1_1 || features.extensions.has(Extension::KHR_maintenance1)) addPose("/input/grip_surface/pose");
		if (features.extensions.has(Extension::EXT_palm_pose)) addPose("/input/palm_ext/pose");
		if (features.extensions.has(Extension::EXT_hand_interaction)) {
			addPose("/input/pinch_ext/pose");
			addPose("/input/poke_ext/pose");
		}
	}
	if (features.extensions.has(Extension::EXT_dpad_binding)) addDirections(components);
	return components;
}

std::optional<SourcePath> splitSource(const InteractionProfile &profile, std::string_view path)
{
	for (const std::string_view user : profile.userPaths)
		if (path.starts_with(user) && path.size() > user.size() && path[user.size()] == '/')
			return SourcePath{path.substr(0, user.size()), path.substr(user.size())};
	return std::nullopt;
}

std::optional<Component> resolveSource(const InteractionProfile &profile, std::string_view path, XrActionType type,
									   const Features &features)
{
	const auto source = splitSource(profile, path);
	if (!source || source->rest.find('/', 1) == source->rest.npos) return std::nullopt;
	const std::vector<Component> components = componentsOf(profile, source->user, features);
	const Component *best = nullptr;
	for (const Component &component : components) {
		if (component.path == source->rest) return component;
		const bool isBelow = component.path.starts_with(source->rest) && component.path[source->rest.size()] == '/';
		if (!isBelow) continue;
		if (!best || unsuitability(component.path, type) < unsuitability(best->path, type)) best = &component;
	}
	return best ? std::optional(*best) : std::nullopt;
}

bool isTopLevelUserPath(std::string_view path, const Features &features)
{
	constexpr std::array all{"/user/hand/left"sv, "/user/hand/right"sv, "/user/head"sv, "/user/gamepad"sv, "/user/treadmill"sv};
	constexpr std::array htcHands{"/user/hand_htc/left"sv, "/user/hand_htc/right"sv};
	if (std::ranges::find(all, path) != all.end()) return true;
	return features.extensions.has(Extension::HTC_hand_interaction) && std::ranges::find(htcHands, path) != htcHands.end();
}

} // namespace arift::openxr
