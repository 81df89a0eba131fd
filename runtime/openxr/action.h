// XrActionSet and XrAction. OpenXR 1.1, chapter "Input and Haptics".
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

class ActionSet : public Object
{
public:
	ActionSet(Instance &owner, const XrActionSetCreateInfo &info);
	~ActionSet() override;
	void requireAlive() const override { instance.requireAlive(); }

	Instance &instance;
	const std::shared_ptr<ActionSetCore> core;
};

template <> struct HandleOf<ActionSet> {
	using type = XrActionSet;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_ACTION_SET;
};

class Action : public Object
{
public:
	Action(ActionSet &set, const XrActionCreateInfo &info);
	~Action() override;
	void requireAlive() const override { instance.requireAlive(); }

	/// A subaction path in a request: XR_NULL_PATH, or one the action was made with. Throws XR_ERROR_PATH_INVALID or
	/// XR_ERROR_PATH_UNSUPPORTED.
	void requireSubaction(XrPath path) const;
	/// Throws XR_ERROR_ACTION_TYPE_MISMATCH.
	void requireType(XrActionType wanted) const;

	Instance &instance;
	const std::shared_ptr<const ActionCore> core;
};

template <> struct HandleOf<Action> {
	using type = XrAction;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_ACTION;
};

void createActionSet(Instance &instance, const XrActionSetCreateInfo &info, XrActionSet &set);
void destroyActionSet(EvenIfLost<ActionSet> set);
void createAction(ActionSet &set, const XrActionCreateInfo &info, XrAction &action);
void destroyAction(EvenIfLost<Action> action);
void suggestInteractionProfileBindings(Instance &instance, const XrInteractionProfileSuggestedBinding &info);

void attachSessionActionSets(Session &session, const XrSessionActionSetsAttachInfo &info);
void getCurrentInteractionProfile(Session &session, XrPath topLevelUserPath, XrInteractionProfileState &state);
void getActionStateBoolean(Session &session, const XrActionStateGetInfo &info, XrActionStateBoolean &state);
void getActionStateFloat(Session &session, const XrActionStateGetInfo &info, XrActionStateFloat &state);
void getActionStateVector2f(Session &session, const XrActionStateGetInfo &info, XrActionStateVector2f &state);
void getActionStatePose(Session &session, const XrActionStateGetInfo &info, XrActionStatePose &state);
XrResult syncActions(Session &session, const XrActionsSyncInfo &info);
XrResult enumerateBoundSourcesForAction(Session &session, const XrBoundSourcesForActionEnumerateInfo &info, OutputArray<XrPath> sources);
XrResult getInputSourceLocalizedName(Session &session, const XrInputSourceLocalizedNameGetInfo &info, OutputArray<char> buffer);
XrResult applyHapticFeedback(Session &session, const XrHapticActionInfo &info, const XrHapticBaseHeader *haptic);
XrResult stopHapticFeedback(Session &session, const XrHapticActionInfo &info);

} // namespace arift::openxr
