#include "runtime/openxr/ext/khr_opengl_enable.h"
#include "runtime/openxr/opengl/gl_graphics.h"

namespace arift::openxr
{

void getOpenGLGraphicsRequirements(Instance &instance, XrSystemId system, XrGraphicsRequirementsOpenGLKHR &requirements)
{
	instance.requireSystem(system);
	requirements.minApiVersionSupported = oldestGl;
	requirements.maxApiVersionSupported = newestGl;
	instance.openGlRequirementsKnown = true;
}

void getOpenGLESGraphicsRequirements(Instance &instance, XrSystemId system, XrGraphicsRequirementsOpenGLESKHR &requirements)
{
	instance.requireSystem(system);
	requirements.minApiVersionSupported = oldestGlEs;
	requirements.maxApiVersionSupported = newestGlEs;
	instance.openGlEsRequirementsKnown = true;
}

} // namespace arift::openxr
