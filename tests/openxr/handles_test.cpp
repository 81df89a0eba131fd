// Handles, the preconditions in parameter types, and the two-call idiom.
#include "runtime/openxr/entry_point.h"
#include <gtest/gtest.h>

namespace arift::openxr
{
namespace
{

std::vector<int> *destroyed = nullptr;

struct Tree : Object {
	explicit Tree(int number_) : number(number_) {}
	~Tree() override { destroyed->push_back(number); }
	void requireAlive() const override
	{
		if (lost) throw Error(XR_ERROR_SESSION_LOST, "lost");
	}
	int number;
	bool lost = false;
};
struct Other : Object {
	void requireAlive() const override {}
};

} // namespace

template <> struct HandleOf<Tree> {
	using type = XrSession;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_SESSION;
};
template <> struct HandleOf<Other> {
	using type = XrSpace;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_SPACE;
};

namespace
{

template <typename Call> XrResult resultOf(Call call)
{
	try {
		call();
		return XR_SUCCESS;
	} catch (const Error &error) {
		return error.result;
	}
}

struct Handles : testing::Test {
	Handles() { destroyed = &order; }
	~Handles() override { EXPECT_EQ(handles.size(), 0u); }
	XrSession add(int number, const Object *parent = nullptr) { return handles.insert(std::make_unique<Tree>(number), parent); }
	std::vector<int> order;
};

TEST_F(Handles, NullStaleForeignAndWrongKindsAreToldApart)
{
	const XrSession session = add(1);
	EXPECT_EQ(handles.at<Tree>(session).number, 1);
	EXPECT_EQ(resultOf([&] { handles.at<Tree>(XR_NULL_HANDLE); }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf([&] { handles.at<Other>(reinterpret_cast<XrSpace>(session)); }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf([&] { handles.at<Tree>(reinterpret_cast<XrSession>(uint64_t(0x7fff12345678))); }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf([&] { handles.at<Tree>(reinterpret_cast<XrSession>(~uint64_t(0))); }), XR_ERROR_HANDLE_INVALID);
	handles.destroy(handles.at<Tree>(session));
	EXPECT_EQ(resultOf([&] { handles.at<Tree>(session); }), XR_ERROR_HANDLE_INVALID);
	const XrSession next = add(2); // takes the same slot
	EXPECT_EQ(resultOf([&] { handles.at<Tree>(session); }), XR_ERROR_HANDLE_INVALID) << "a stale handle stays stale";
	EXPECT_NE(session, next);
	handles.destroy(handles.at<Tree>(next));
}

TEST_F(Handles, ChildrenGoBeforeTheirParents)
{
	const Tree &root = handles.at<Tree>(add(1));
	const Tree &child = handles.at<Tree>(add(2, &root));
	const XrSession grandchild = add(3, &child);
	const Tree &sibling = handles.at<Tree>(add(4, &root));
	const XrSession stranger = add(5);
	EXPECT_EQ(handles.rootOf<Tree>(reinterpret_cast<uint64_t>(grandchild)), &root);
	EXPECT_EQ(handles.rootOf<Tree>(root.handleValue()), &root);
	EXPECT_EQ(handles.rootOf<Other>(root.handleValue()), nullptr) << "of another kind";
	EXPECT_EQ(handles.rootOf<Tree>(0), nullptr);
	handles.destroy(sibling);
	EXPECT_EQ(order, (std::vector{4}));
	handles.destroy(root);
	EXPECT_EQ(order, (std::vector{4, 3, 2, 1}));
	EXPECT_EQ(resultOf([&] { handles.at<Tree>(grandchild); }), XR_ERROR_HANDLE_INVALID);
	handles.destroy(handles.at<Tree>(stranger));
}

// ---- entry points

XrResult locate(Tree &tree, const XrActionsSyncInfo &info, const XrFrameWaitInfo *optional, XrFrameState &out)
{
	out.predictedDisplayTime = tree.number + int(info.countActiveActionSets) + (optional ? 100 : 0);
	return XR_SESSION_NOT_FOCUSED;
}
using PFN_locate = XrResult(XRAPI_PTR *)(XrSession, const XrActionsSyncInfo *, const XrFrameWaitInfo *, XrFrameState *);
constexpr auto callLocate = EntryPoint<"xrLocate", PFN_locate, locate>::call;

int forgotten = 0;
void forget(EvenIfLost<Tree> tree) { forgotten = tree->number; }
using PFN_forget = XrResult(XRAPI_PTR *)(XrSession);
constexpr auto callForget = EntryPoint<"xrForget", PFN_forget, forget>::call;

XrResult listThree(InputArray<int> inputs, OutputArray<XrViewConfigurationView> views)
{
	return views.fill(uint32_t(inputs.size()),
					  [&](uint32_t i, XrViewConfigurationView &view) { view.maxImageRectWidth = uint32_t(inputs[i]); });
}
using PFN_listThree = XrResult(XRAPI_PTR *)(uint32_t, const int *, uint32_t, uint32_t *, XrViewConfigurationView *);
constexpr auto callListThree = EntryPoint<"xrListThree", PFN_listThree, listThree>::call;

TEST_F(Handles, PreconditionsOfAnEntryPoint)
{
	const XrSession session = add(7);
	XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, nullptr};
	XrFrameState out{XR_TYPE_FRAME_STATE};
	const XrFrameWaitInfo optional{XR_TYPE_FRAME_WAIT_INFO};
	EXPECT_EQ(callLocate(session, &info, nullptr, &out), XR_SESSION_NOT_FOCUSED) << "a function's own result comes through";
	EXPECT_EQ(out.predictedDisplayTime, 8);
	EXPECT_EQ(callLocate(session, &info, &optional, &out), XR_SESSION_NOT_FOCUSED);
	EXPECT_EQ(out.predictedDisplayTime, 108);
	EXPECT_EQ(callLocate(XR_NULL_HANDLE, &info, nullptr, &out), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(callLocate(session, nullptr, nullptr, &out), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(callLocate(session, &info, nullptr, nullptr), XR_ERROR_VALIDATION_FAILURE);
	out.type = XR_TYPE_VIEW;
	EXPECT_EQ(callLocate(session, &info, nullptr, &out), XR_ERROR_VALIDATION_FAILURE) << "wrong type of an output";
	out.type = XR_TYPE_FRAME_STATE;
	const XrFrameWaitInfo wrong{XR_TYPE_FRAME_BEGIN_INFO};
	EXPECT_EQ(callLocate(session, &info, &wrong, &out), XR_ERROR_VALIDATION_FAILURE) << "wrong type of an optional input";
	handles.at<Tree>(session).lost = true;
	EXPECT_EQ(callLocate(session, &info, nullptr, &out), XR_ERROR_SESSION_LOST);
	EXPECT_EQ(callForget(session), XR_SUCCESS) << "what is lost can still be destroyed";
	EXPECT_EQ(forgotten, 7);
	handles.destroy(handles.at<Tree>(session));
}

TEST_F(Handles, TwoCallIdiom)
{
	const int numbers[] = {10, 20, 30};
	uint32_t count = 99;
	EXPECT_EQ(callListThree(3, numbers, 0, &count, nullptr), XR_SUCCESS);
	EXPECT_EQ(count, 3u);
	std::vector<XrViewConfigurationView> views(3, {XR_TYPE_VIEW_CONFIGURATION_VIEW});
	count = 0;
	EXPECT_EQ(callListThree(3, numbers, 2, &count, views.data()), XR_ERROR_SIZE_INSUFFICIENT);
	EXPECT_EQ(count, 3u) << "the needed size is told";
	EXPECT_EQ(callListThree(3, numbers, 3, &count, views.data()), XR_SUCCESS);
	EXPECT_EQ(views[2].maxImageRectWidth, 30u);
	EXPECT_EQ(callListThree(3, numbers, 3, &count, nullptr), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(callListThree(3, numbers, 3, nullptr, views.data()), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(callListThree(3, nullptr, 0, &count, nullptr), XR_ERROR_VALIDATION_FAILURE) << "an input array may not be null";
	views[1].type = XR_TYPE_VIEW;
	views[0].maxImageRectWidth = 1;
	EXPECT_EQ(callListThree(3, numbers, 3, &count, views.data()), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(views[0].maxImageRectWidth, 1u) << "a call that fails has changed nothing";
}

TEST_F(Handles, TextBuffersCountTheirTerminator)
{
	char buffer[4] = "xxx";
	uint32_t count = 0;
	EXPECT_EQ(assignText({4, &count, buffer}, "abcd"), XR_ERROR_SIZE_INSUFFICIENT);
	EXPECT_EQ(count, 5u);
	EXPECT_EQ(assignText({4, &count, buffer}, "abc"), XR_SUCCESS);
	EXPECT_STREQ(buffer, "abc");
}

} // namespace
} // namespace arift::openxr
