// The least an application needs: the library opened as the loader opens it, functions by name, objects that destroy themselves.
#pragma once
#include "runtime/openxr/api.h"
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace arift
{

/// The library, opened and negotiated with.
class Library
{
public:
	Library()
	{
		library_ = ::dlopen(OPENXR_ARIFT_LIBRARY, RTLD_NOW | RTLD_LOCAL);
		if (!library_) throw std::runtime_error(::dlerror());
		using Negotiate = XrResult(XRAPI_PTR *)(const XrNegotiateLoaderInfo *, XrNegotiateRuntimeRequest *);
		const auto negotiate = reinterpret_cast<Negotiate>(::dlsym(library_, "xrNegotiateLoaderRuntimeInterface"));
		if (!negotiate) throw std::runtime_error(::dlerror());
		const XrNegotiateLoaderInfo info{XR_LOADER_INTERFACE_STRUCT_LOADER_INFO, 1, sizeof(info), 1, 1, XR_MAKE_VERSION(1, 0, 0),
										 XR_MAKE_VERSION(1, 0x3ff, 0xfff)};
		XrNegotiateRuntimeRequest request{XR_LOADER_INTERFACE_STRUCT_RUNTIME_REQUEST, 1, sizeof(request)};
		EXPECT_EQ(negotiate(&info, &request), XR_SUCCESS);
		EXPECT_EQ(request.runtimeInterfaceVersion, 1u);
		version = request.runtimeApiVersion;
		getInstanceProcAddr = request.getInstanceProcAddr;
	}
	~Library() { ::dlclose(library_); }
	Library(const Library &) = delete;

	PFN_xrGetInstanceProcAddr getInstanceProcAddr = nullptr;
	XrVersion version = 0;

private:
	void *library_ = nullptr;
};

struct Application {
	explicit Application(const std::vector<const char *> &extensions = {}, XrVersion version = XR_API_VERSION_1_1)
		: created(create(extensions, version))
	{
	}
	~Application()
	{
		if (instance) get<PFN_xrDestroyInstance>("xrDestroyInstance")(instance);
	}
	Application(const Application &) = delete;

	/// A function of the instance (or of none, before there is one); null where it has none of this name.
	template <typename Pfn> Pfn get(const char *name) const
	{
		PFN_xrVoidFunction function = nullptr;
		library.getInstanceProcAddr(instance, name, &function);
		return reinterpret_cast<Pfn>(function);
	}
	XrSystemId system() const
	{
		const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
		XrSystemId id = XR_NULL_SYSTEM_ID;
		EXPECT_EQ(get<PFN_xrGetSystem>("xrGetSystem")(instance, &info, &id), XR_SUCCESS);
		return id;
	}
	XrSession session(const void *binding = nullptr) const
	{
		const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, binding, 0, system()};
		XrSession made = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateSession>("xrCreateSession")(instance, &info, &made), XR_SUCCESS);
		return made;
	}
	XrSpace space(XrSession session, XrReferenceSpaceType type, XrPosef pose = {{0, 0, 0, 1}, {0, 0, 0}}) const
	{
		const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, pose};
		XrSpace made = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(session, &info, &made), XR_SUCCESS);
		return made;
	}
	XrPath path(const char *text) const
	{
		XrPath atom = XR_NULL_PATH;
		EXPECT_EQ(get<PFN_xrStringToPath>("xrStringToPath")(instance, text, &atom), XR_SUCCESS);
		return atom;
	}
	XrResult poll(XrEventDataBuffer &event) const
	{
		event = {XR_TYPE_EVENT_DATA_BUFFER};
		return get<PFN_xrPollEvent>("xrPollEvent")(instance, &event);
	}
	/// Session states that wait to be polled, in order.
	std::vector<XrSessionState> states() const
	{
		std::vector<XrSessionState> states;
		for (XrEventDataBuffer event; poll(event) == XR_SUCCESS;)
			if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
				states.push_back(reinterpret_cast<XrEventDataSessionStateChanged &>(event).state);
		return states;
	}
	XrResult begin(XrSession session) const
	{
		const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
		return get<PFN_xrBeginSession>("xrBeginSession")(session, &info);
	}
	XrResult wait(XrSession session, XrFrameState &state) const
	{
		state = {XR_TYPE_FRAME_STATE};
		return get<PFN_xrWaitFrame>("xrWaitFrame")(session, nullptr, &state);
	}
	XrResult beginFrame(XrSession session) const { return get<PFN_xrBeginFrame>("xrBeginFrame")(session, nullptr); }
	XrResult endFrame(XrSession session, XrTime time, std::vector<const XrCompositionLayerBaseHeader *> layers = {},
					  XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE) const
	{
		const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO, nullptr, time, mode, uint32_t(layers.size()), layers.data()};
		return get<PFN_xrEndFrame>("xrEndFrame")(session, &info);
	}

	Library library;
	XrInstance instance = XR_NULL_HANDLE;
	XrResult created;

private:
	XrResult create(const std::vector<const char *> &extensions, XrVersion version)
	{
		XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
		info.applicationInfo = {"test application", 1, "test engine", 2, version};
		info.enabledExtensionCount = uint32_t(extensions.size());
		info.enabledExtensionNames = extensions.data();
		return get<PFN_xrCreateInstance>("xrCreateInstance")(&info, &instance);
	}
};

} // namespace arift
