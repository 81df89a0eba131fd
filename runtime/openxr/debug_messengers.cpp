#include "runtime/openxr/debug_messengers.h"
#include "runtime/openxr/session.h"

namespace arift::openxr
{
namespace
{

/// A message with what the application has said about its objects.
class Annotated
{
public:
	explicit Annotated(const XrDebugUtilsMessengerCallbackDataEXT &data)
		: data_(data), objects_(data.objects, data.objects + (data.objects ? data.objectCount : 0)), names_(objects_.size())
	{
		for (size_t i = 0; i < objects_.size(); ++i) annotate(objects_[i], names_[i]);
		for (const std::string &label : labelNames_) labels_.push_back({XR_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, label.c_str()});
		data_.objectCount = uint32_t(objects_.size());
		data_.objects = objects_.data();
		if (!data_.sessionLabels) data_.sessionLabelCount = 0; // as an application may say of an array that it has not
		if (labels_.empty()) return;
		data_.sessionLabelCount = uint32_t(labels_.size());
		data_.sessionLabels = labels_.data();
	}
	Annotated(const Annotated &) = delete;
	const XrDebugUtilsMessengerCallbackDataEXT &data() const { return data_; }

private:
	void annotate(XrDebugUtilsObjectNameInfoEXT &info, std::string &name)
	{
		Object *object = handles.find(info.objectHandle, info.objectType);
		if (!object) return;
		name = *object->debugName.lock();
		if (!name.empty()) info.objectName = name.c_str();
		if (info.objectType != XR_OBJECT_TYPE_SESSION) return;
		for (std::string &label : static_cast<Session *>(object)->labels.names()) labelNames_.push_back(std::move(label));
	}

	XrDebugUtilsMessengerCallbackDataEXT data_;
	std::vector<XrDebugUtilsObjectNameInfoEXT> objects_;
	std::vector<std::string> names_, labelNames_;
	std::vector<XrDebugUtilsLabelEXT> labels_;
};

} // namespace

void DebugMessengers::send(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
						   const XrDebugUtilsMessengerCallbackDataEXT &data)
{
	const std::vector<Messenger> now = *all_.lock();
	if (now.empty()) return;
	const Annotated annotated(data);
	for (const auto &[key, info] : now)
		if ((info.messageSeverities & severity) && (info.messageTypes & types))
			info.userCallback(severity, types, &annotated.data(), info.userData);
}

} // namespace arift::openxr
