// XR_EXT_debug_utils: applications hear of their mistakes.
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"

namespace arift
{
namespace
{

struct DebugMessenger : testing::Test {
	FakeService service;

	/// An application and the last thing it was told.
	struct Listener {
		explicit Listener(XrDebugUtilsMessageTypeFlagsEXT types = XR_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT)
		{
			const XrDebugUtilsMessengerCreateInfoEXT info{.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
														  .messageSeverities = XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
														  .messageTypes = types,
														  .userCallback = hear,
														  .userData = this};
			EXPECT_EQ(get<PFN_xrCreateDebugUtilsMessengerEXT>("xrCreateDebugUtilsMessengerEXT")(application.instance, &info, &messenger),
					  XR_SUCCESS);
		}
		template <typename Pfn> Pfn get(const char *name) const { return application.get<Pfn>(name); }
		static XrBool32 XRAPI_CALL hear(XrDebugUtilsMessageSeverityFlagsEXT, XrDebugUtilsMessageTypeFlagsEXT,
										const XrDebugUtilsMessengerCallbackDataEXT *data, void *user)
		{
			auto &listener = *static_cast<Listener *>(user);
			listener.heard += std::string(data->functionName) + ": " + data->message + "\n";
			listener.names.clear();
			listener.labels.clear();
			for (uint32_t i = 0; i < data->objectCount; ++i)
				listener.names.push_back(data->objects[i].objectName ? data->objects[i].objectName : "");
			for (uint32_t i = 0; i < data->sessionLabelCount; ++i) listener.labels.push_back(data->sessionLabels[i].labelName);
			return XR_FALSE;
		}
		/// A path that is none.
		void mistake() const
		{
			XrPath path = 0;
			EXPECT_EQ(get<PFN_xrStringToPath>("xrStringToPath")(application.instance, "/Bad", &path), XR_ERROR_PATH_FORMAT_INVALID);
		}
		std::string takeHeard() { return std::exchange(heard, {}); }

		const Application application{{"XR_EXT_debug_utils", "XR_MND_headless"}};
		XrDebugUtilsMessengerEXT messenger = XR_NULL_HANDLE;
		std::string heard;
		std::vector<std::string> names, labels; ///< of the last message
	};
	static constexpr const char *ofBadPath = "xrStringToPath: \"/Bad\" is not a well-formed path\n";
};

TEST_F(DebugMessenger, HearsWhatTheApplicationDidWrongUntilItIsDestroyed)
{
	Listener listener;
	listener.mistake();
	EXPECT_EQ(listener.takeHeard(), ofBadPath);
	ASSERT_EQ(listener.get<PFN_xrDestroyDebugUtilsMessengerEXT>("xrDestroyDebugUtilsMessengerEXT")(listener.messenger), XR_SUCCESS);
	listener.mistake();
	EXPECT_EQ(listener.takeHeard(), "");
}

TEST_F(DebugMessenger, HearsOfItsOwnInstanceAndWhatIsBelowItAlone)
{
	Listener one, other;
	other.mistake();
	EXPECT_EQ(one.takeHeard(), "");
	EXPECT_EQ(other.takeHeard(), ofBadPath);
	const XrSession session = one.application.session();
	EXPECT_EQ(one.get<PFN_xrEndSession>("xrEndSession")(session), XR_ERROR_SESSION_NOT_RUNNING);
	EXPECT_EQ(one.takeHeard(), "xrEndSession: the session is not running: its state is 2\n");
	EXPECT_EQ(other.takeHeard(), "");
	EXPECT_EQ(one.get<PFN_xrEndSession>("xrEndSession")(XR_NULL_HANDLE), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(one.takeHeard() + other.takeHeard(), "") << "nobody knows whose mistake it is";
}

TEST_F(DebugMessenger, HearsWhatIsSubmittedToItsOwnInstance)
{
	Listener one(XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT), other(XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT);
	const XrDebugUtilsMessengerCallbackDataEXT data{
		.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT, .messageId = "id", .functionName = "here", .message = "text"};
	const auto submit = [&](XrDebugUtilsMessageTypeFlagsEXT types) {
		EXPECT_EQ(one.get<PFN_xrSubmitDebugUtilsMessageEXT>("xrSubmitDebugUtilsMessageEXT")(
					  one.application.instance, XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT, types, &data),
				  XR_SUCCESS);
	};
	submit(XR_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT);
	EXPECT_EQ(one.takeHeard(), "");
	submit(XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT);
	EXPECT_EQ(one.takeHeard(), "here: text\n");
	EXPECT_EQ(other.takeHeard(), "");
}

/// xrSubmitDebugUtilsMessageEXT
TEST_F(DebugMessenger, IsToldOfNoObjectsAndLabelsWhereTheArraysAreNull)
{
	Listener listener(XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT);
	const XrDebugUtilsMessengerCallbackDataEXT data{.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT,
													.functionName = "here",
													.message = "text",
													.objectCount = 1,
													.sessionLabelCount = 1};
	EXPECT_EQ(listener.get<PFN_xrSubmitDebugUtilsMessageEXT>("xrSubmitDebugUtilsMessageEXT")(
				  listener.application.instance, XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT, XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT,
				  &data),
			  XR_SUCCESS);
	EXPECT_EQ(listener.takeHeard(), "here: text\n");
	EXPECT_TRUE(listener.names.empty() && listener.labels.empty());
}

/// What names and labels are told to: the application's one session, which is the object of every message.
struct DebugAnnotation : DebugMessenger {
	const Listener listener{XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT};
	const XrSession session = listener.application.session();

	XrDebugUtilsObjectNameInfoEXT named(const char *name) const
	{
		return {XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, XR_OBJECT_TYPE_SESSION, reinterpret_cast<uint64_t>(session), name};
	}
	XrResult setName(const XrDebugUtilsObjectNameInfoEXT &info) const
	{
		return listener.get<PFN_xrSetDebugUtilsObjectNameEXT>("xrSetDebugUtilsObjectNameEXT")(listener.application.instance, &info);
	}
	void begin(const char *name) const
	{
		label<PFN_xrSessionBeginDebugUtilsLabelRegionEXT>("xrSessionBeginDebugUtilsLabelRegionEXT", name);
	}
	void insert(const char *name) const { label<PFN_xrSessionInsertDebugUtilsLabelEXT>("xrSessionInsertDebugUtilsLabelEXT", name); }
	void end() const
	{
		EXPECT_EQ(listener.get<PFN_xrSessionEndDebugUtilsLabelRegionEXT>("xrSessionEndDebugUtilsLabelRegionEXT")(session), XR_SUCCESS);
	}
	template <typename Pfn> void label(const char *function, const char *name) const
	{
		const XrDebugUtilsLabelEXT info{XR_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name};
		EXPECT_EQ(listener.get<Pfn>(function)(session, &info), XR_SUCCESS);
	}
	/// A message about the session, which its sender calls `name`.
	void submit(const char *name) const
	{
		XrDebugUtilsObjectNameInfoEXT object = named(name);
		XrDebugUtilsMessengerCallbackDataEXT data{
			.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT, .messageId = "id", .functionName = "here", .message = "text"};
		data.objectCount = 1;
		data.objects = &object;
		EXPECT_EQ(listener.get<PFN_xrSubmitDebugUtilsMessageEXT>("xrSubmitDebugUtilsMessageEXT")(
					  listener.application.instance, XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
					  XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT, &data),
				  XR_SUCCESS);
	}
	using Texts = std::vector<std::string>;
};

TEST_F(DebugAnnotation, MessagesCallObjectsByTheNamesThatTheApplicationGaveThem)
{
	submit("the sender's");
	EXPECT_EQ(listener.names, Texts{"the sender's"});
	ASSERT_EQ(setName(named("mine")), XR_SUCCESS);
	submit("the sender's");
	EXPECT_EQ(listener.names, Texts{"mine"});
	ASSERT_EQ(setName(named("")), XR_SUCCESS);
	submit(nullptr);
	EXPECT_EQ(listener.names, Texts{""}) << "an empty name takes it back";
	XrDebugUtilsObjectNameInfoEXT wrong = named("nobody");
	wrong.objectType = XR_OBJECT_TYPE_SPACE;
	EXPECT_EQ(setName(wrong), XR_ERROR_HANDLE_INVALID);
}

TEST_F(DebugAnnotation, MessagesSayWhatTheSessionIsDoingTheNewestFirst)
{
	insert("alone");
	submit(nullptr);
	EXPECT_EQ(listener.labels, Texts{"alone"});
	begin("outer");
	begin("inner");
	insert("step");
	submit(nullptr);
	EXPECT_EQ(listener.labels, (Texts{"step", "inner", "outer"})) << "a region ends an individual label";
	insert("next step");
	end();
	submit(nullptr);
	EXPECT_EQ(listener.labels, Texts{"outer"});
	end();
	end();
	submit(nullptr);
	EXPECT_EQ(listener.labels, Texts{}) << "what did not begin does not end";
}

TEST_F(DebugMessenger, OneThatCannotBeMadeMakesNoInstance)
{
	const Library library;
	const char *extension = "XR_EXT_debug_utils";
	const XrDebugUtilsMessengerCreateInfoEXT mute{.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO, &mute};
	info.applicationInfo = {"test application", 1, "", 0, XR_API_VERSION_1_0};
	info.enabledExtensionCount = 1;
	info.enabledExtensionNames = &extension;
	PFN_xrVoidFunction create = nullptr;
	ASSERT_EQ(library.getInstanceProcAddr(XR_NULL_HANDLE, "xrCreateInstance", &create), XR_SUCCESS);
	XrInstance instance = XR_NULL_HANDLE;
	EXPECT_EQ(reinterpret_cast<PFN_xrCreateInstance>(create)(&info, &instance), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(library.getInstanceProcAddr(instance, "xrEndFrame", &create), XR_ERROR_HANDLE_INVALID) << "it is destroyed again";
}

} // namespace
} // namespace arift
