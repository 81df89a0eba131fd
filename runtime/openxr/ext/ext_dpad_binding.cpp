#include "runtime/openxr/ext/ext_dpad_binding.h"
#include <cmath>
#include <numbers>

namespace arift::openxr
{
namespace
{

struct Direction {
	DpadRegions bit;
	std::string_view name;
	float x, y;
};
constexpr Direction directions[] = {
	{dpadUp, "dpad_up", 0, 1}, {dpadDown, "dpad_down", 0, -1}, {dpadLeft, "dpad_left", -1, 0}, {dpadRight, "dpad_right", 1, 0}};

DpadRegions regionsAt(const DpadSettings &settings, XrVector2f position)
{
	const float radius = std::hypot(position.x, position.y);
	if (radius <= settings.centerRegion) return dpadCenter;
	DpadRegions regions = 0;
	for (const Direction &direction : directions) {
		const float cosine = (position.x * direction.x + position.y * direction.y) / radius;
		if (cosine >= std::cos(settings.wedgeAngle / 2)) regions |= direction.bit;
	}
	return regions;
}

void require(bool fulfilled, const char *name, float value)
{
	if (!fulfilled) throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is {}", name, value);
}

} // namespace

DpadSettings settingsOf(const XrInteractionProfileDpadBindingEXT &m)
{
	require(m.forceThreshold > 0 && m.forceThreshold <= 1, "forceThreshold", m.forceThreshold);
	require(m.forceThresholdReleased > 0 && m.forceThresholdReleased <= 1, "forceThresholdReleased", m.forceThresholdReleased);
	require(m.forceThresholdReleased <= m.forceThreshold, "above forceThreshold: forceThresholdReleased", m.forceThresholdReleased);
	require(m.centerRegion > 0 && m.centerRegion < 1, "centerRegion", m.centerRegion);
	require(m.wedgeAngle >= 0 && m.wedgeAngle < std::numbers::pi_v<float>, "wedgeAngle", m.wedgeAngle);
	return {m.forceThreshold, m.forceThresholdReleased, m.centerRegion, m.wedgeAngle, m.isSticky == XR_TRUE};
}

DpadRegions dpadRegionNamed(std::string_view component)
{
	for (const Direction &direction : directions)
		if (direction.name == component) return direction.bit;
	return component == "dpad_center" ? dpadCenter : 0;
}

DpadRegions Dpad::update(const DpadSettings &settings, XrVector2f position, DpadPress press)
{
	const DpadRegions here = regionsAt(settings, position);
	if (press.isNeeded)
		isPressed_ = press.force >= (isPressed_ ? settings.forceThresholdReleased : settings.forceThreshold) && press.force > 0;
	else
		isPressed_ = here != dpadCenter;
	if (!isPressed_) return latched_ = 0;
	if (settings.isSticky && latched_ != 0) return latched_;
	return latched_ = here;
}

} // namespace arift::openxr
