#include "runtime/openxr/opengl/gl_api.h"
#include <cstdio>
#include <cstring>

namespace arift::openxr
{
namespace
{

template <typename Pfn> Pfn found(const GlContext &context, const char *name)
{
	const auto function = reinterpret_cast<Pfn>(context.find(name));
	if (!function) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the application's GL has no {}", name);
	return function;
}

} // namespace

GlApi::GlApi(const GlContext &context)
{
#define ARIFT_FIND(Pfn, name) name = found<Pfn>(context, "gl" #name);
	ARIFT_GL_FUNCTIONS(ARIFT_FIND)
#undef ARIFT_FIND
}

std::optional<GlSharingApi> findSharing(const GlContext &context)
{
	const CurrentContext current(context);
	const GlApi gl(context);
	GLint count = 0;
	gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
	bool isThere = false;
	for (GLint i = 0; i < count; ++i) {
		const auto *name = reinterpret_cast<const char *>(gl.GetStringi(GL_EXTENSIONS, GLuint(i)));
		isThere = isThere || (name && std::strcmp(name, "GL_EXT_memory_object_fd") == 0);
	}
	if (!isThere) return std::nullopt;
	GlSharingApi api{};
#define ARIFT_FIND(Pfn, name) api.name = found<Pfn>(context, "gl" #name);
	ARIFT_GL_SHARING_FUNCTIONS(ARIFT_FIND)
#undef ARIFT_FIND
	return api;
}

GlVersion parseGlVersion(const char *text)
{
	GlVersion version;
	constexpr char es[] = "OpenGL ES ";
	version.isEs = std::strncmp(text, es, sizeof es - 1) == 0;
	if (std::sscanf(text + (version.isEs ? sizeof es - 1 : 0), "%d.%d", &version.major, &version.minor) != 2) // NOLINT(cert-err34-c)
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "GL_VERSION is \"{}\", which begins with no number", text);
	return version;
}

} // namespace arift::openxr
