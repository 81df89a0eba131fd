// OpenGL's functions as this library calls them: found through the application's context, never linked.
#pragma once
#include "runtime/openxr/opengl/gl_context.h"
#include <GL/gl.h>
#include <GL/glext.h>
#include <optional>

namespace arift::openxr
{

#define ARIFT_GL_FUNCTIONS(X)                                                                                                              \
	X(decltype(&::glGetString), GetString)                                                                                                 \
	X(decltype(&::glGetIntegerv), GetIntegerv)                                                                                             \
	X(decltype(&::glGetError), GetError)                                                                                                   \
	X(decltype(&::glFlush), Flush)                                                                                                         \
	X(decltype(&::glGenTextures), GenTextures)                                                                                             \
	X(decltype(&::glDeleteTextures), DeleteTextures)                                                                                       \
	X(decltype(&::glBindTexture), BindTexture)                                                                                             \
	X(decltype(&::glTexParameteri), TexParameteri)                                                                                         \
	X(decltype(&::glGetTexParameteriv), GetTexParameteriv)                                                                                 \
	X(decltype(&::glPixelStorei), PixelStorei)                                                                                             \
	X(decltype(&::glReadPixels), ReadPixels)                                                                                               \
	X(PFNGLTEXSTORAGE2DPROC, TexStorage2D)                                                                                                 \
	X(PFNGLTEXSTORAGE3DPROC, TexStorage3D)                                                                                                 \
	X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                                                           \
	X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                                                     \
	X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                                                           \
	X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                                                                 \
	X(PFNGLFRAMEBUFFERTEXTURELAYERPROC, FramebufferTextureLayer)                                                                           \
	X(PFNGLGENBUFFERSPROC, GenBuffers)                                                                                                     \
	X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                                               \
	X(PFNGLMAPBUFFERRANGEPROC, MapBufferRange)                                                                                             \
	X(PFNGLUNMAPBUFFERPROC, UnmapBuffer)                                                                                                   \
	X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                                                             \
	X(PFNGLBINDBUFFERPROC, BindBuffer)                                                                                                     \
	X(PFNGLFENCESYNCPROC, FenceSync)                                                                                                       \
	X(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                                                                                             \
	X(PFNGLDELETESYNCPROC, DeleteSync)                                                                                                     \
	X(PFNGLGETSTRINGIPROC, GetStringi)
/// GL_EXT_memory_object and GL_EXT_memory_object_fd.
#define ARIFT_GL_SHARING_FUNCTIONS(X)                                                                                                      \
	X(PFNGLGETUNSIGNEDBYTEVEXTPROC, GetUnsignedBytevEXT)                                                                                   \
	X(PFNGLGETUNSIGNEDBYTEI_VEXTPROC, GetUnsignedBytei_vEXT)                                                                               \
	X(PFNGLCREATEMEMORYOBJECTSEXTPROC, CreateMemoryObjectsEXT)                                                                             \
	X(PFNGLDELETEMEMORYOBJECTSEXTPROC, DeleteMemoryObjectsEXT)                                                                             \
	X(PFNGLMEMORYOBJECTPARAMETERIVEXTPROC, MemoryObjectParameterivEXT)                                                                     \
	X(PFNGLIMPORTMEMORYFDEXTPROC, ImportMemoryFdEXT)                                                                                       \
	X(PFNGLBUFFERSTORAGEMEMEXTPROC, BufferStorageMemEXT)                                                                                   \
	X(PFNGLTEXSTORAGEMEM2DEXTPROC, TexStorageMem2DEXT)                                                                                     \
	X(PFNGLTEXSTORAGEMEM3DEXTPROC, TexStorageMem3DEXT)

#define ARIFT_MEMBER(Pfn, name) Pfn name;
struct GlApi {
	ARIFT_GL_FUNCTIONS(ARIFT_MEMBER)
	/// Throws XR_ERROR_GRAPHICS_DEVICE_INVALID that names the function the application's GL lacks.
	explicit GlApi(const GlContext &context);
};
struct GlSharingApi {
	ARIFT_GL_SHARING_FUNCTIONS(ARIFT_MEMBER)
};
#undef ARIFT_MEMBER
/// Nothing where the application's GL has not the extensions.
std::optional<GlSharingApi> findSharing(const GlContext &context);

/// "3.3" of a GL_VERSION: OpenGL's begins with it, OpenGL ES' says "OpenGL ES 3.2 …".
struct GlVersion {
	bool isEs = false;
	int major = 0, minor = 0;
};
GlVersion parseGlVersion(const char *text);

} // namespace arift::openxr
