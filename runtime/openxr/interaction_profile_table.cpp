// The data of interaction_profiles.h, from the registry of OpenXR 1.1.
#include "runtime/openxr/interaction_profiles.h"

namespace arift::openxr
{
namespace
{

using namespace std::literals;

constexpr std::array handPaths{"/user/hand/left"sv, "/user/hand/right"sv};
constexpr std::array htcHandPaths{"/user/hand_htc/left"sv, "/user/hand_htc/right"sv};
constexpr std::array headPaths{"/user/head"sv};
constexpr std::array gamepadPaths{"/user/gamepad"sv};
constexpr std::span<const std::string_view> hands(handPaths), htcHands(htcHandPaths), head(headPaths), gamepad(gamepadPaths);

constexpr InteractionProfile profiles[] = {
	{"khr/simple_controller", "Khronos Simple Controller", Since::version1_0, Extension::count, hands,
	 "select/click:b menu/click:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"google/daydream_controller", "Google Daydream Controller", Since::version1_0, Extension::count, hands,
	 "select/click:b trackpad:v trackpad/x:f trackpad/y:f trackpad/click:b trackpad/touch:b grip/pose:p aim/pose:p"},
	{"htc/vive_controller", "HTC Vive Controller", Since::version1_0, Extension::count, hands,
	 "system/click:b squeeze/click:b menu/click:b trigger/click:b trigger/value:f trackpad:v trackpad/x:f "
	 "trackpad/y:f trackpad/click:b trackpad/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"htc/vive_pro", "HTC Vive Pro", Since::version1_0, Extension::count, head,
	 "system/click:b volume_up/click:b volume_down/click:b mute_mic/click:b"},
	{"microsoft/motion_controller", "Microsoft Mixed Reality Motion Controller", Since::version1_0, Extension::count, hands,
	 "menu/click:b squeeze/click:b trigger/value:f thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "trackpad:v trackpad/x:f trackpad/y:f trackpad/click:b trackpad/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"microsoft/xbox_controller", "Microsoft Xbox Controller", Since::version1_0, Extension::count, gamepad,
	 "menu/click:b view/click:b a/click:b b/click:b x/click:b y/click:b dpad_down/click:b dpad_right/click:b "
	 "dpad_up/click:b dpad_left/click:b shoulder_left/click:b shoulder_right/click:b thumbstick_left/click:b "
	 "thumbstick_right/click:b trigger_left/value:f trigger_right/value:f thumbstick_left:v thumbstick_left/x:f "
	 "thumbstick_left/y:f thumbstick_right:v thumbstick_right/x:f thumbstick_right/y:f /output/haptic_left:h "
	 "/output/haptic_right:h /output/haptic_left_trigger:h /output/haptic_right_trigger:h"},
	{"oculus/go_controller", "Oculus Go Controller", Since::version1_0, Extension::count, hands,
	 "system/click:b trigger/click:b back/click:b trackpad:v trackpad/x:f trackpad/y:f trackpad/click:b "
	 "trackpad/touch:b grip/pose:p aim/pose:p"},
	{"oculus/touch_controller", "Oculus Touch Controller", Since::version1_0, Extension::count, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f "
	 "thumbstick/click:b thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h "
	 "1.1:trigger/proximity:b 1.1:thumb_resting_surfaces/proximity:b fb:trigger/proximity_fb:b "
	 "fb:thumb_fb/proximity_fb:b"},
	{"valve/index_controller", "Valve Index Controller", Since::version1_0, Extension::count, hands,
	 "system/click:b system/touch:b a/click:b a/touch:b b/click:b b/touch:b squeeze/value:f squeeze/force:f "
	 "trigger/click:b trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "thumbstick/touch:b trackpad:v trackpad/x:f trackpad/y:f trackpad/force:f trackpad/touch:b grip/pose:p "
	 "aim/pose:p /output/haptic:h"},
	{"microsoft/hand_interaction", "Microsoft hand interaction", Since::never, Extension::MSFT_hand_interaction, hands,
	 "select/value:f squeeze/value:f grip/pose:p aim/pose:p"},
	{"huawei/controller", "Huawei Controller", Since::never, Extension::HUAWEI_controller_interaction, hands,
	 "home/click:b back/click:b volume_up/click:b volume_down/click:b trigger/click:b trigger/value:f trackpad:v "
	 "trackpad/x:f trackpad/y:f trackpad/click:b trackpad/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"htc/hand_interaction", "HTC hand interaction", Since::never, Extension::HTC_hand_interaction, htcHands,
	 "select/value:f squeeze/value:f grip/pose:p aim/pose:p"},
	{"htc/vive_cosmos_controller", "HTC VIVE Cosmos Controller", Since::version1_1, Extension::HTC_vive_cosmos_controller_interaction,
	 hands,
	 "L:x/click:b L:y/click:b L:menu/click:b R:a/click:b R:b/click:b R:system/click:b shoulder/click:b "
	 "squeeze/click:b trigger/click:b trigger/value:f thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "thumbstick/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"htc/vive_focus3_controller", "HTC VIVE Focus 3 Controller", Since::version1_1, Extension::HTC_vive_focus3_controller_interaction,
	 hands,
	 "L:x/click:b L:y/click:b L:menu/click:b R:a/click:b R:b/click:b R:system/click:b squeeze/click:b "
	 "squeeze/touch:b squeeze/value:f trigger/click:b trigger/touch:b trigger/value:f thumbstick:v thumbstick/x:f "
	 "thumbstick/y:f thumbstick/click:b thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"samsung/odyssey_controller", "Samsung Odyssey Mixed Reality Motion Controller", Since::version1_1,
	 Extension::EXT_samsung_odyssey_controller, hands,
	 "menu/click:b squeeze/click:b trigger/value:f thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "trackpad:v trackpad/x:f trackpad/y:f trackpad/click:b trackpad/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"hp/mixed_reality_controller", "HP Mixed Reality Motion Controller", Since::version1_1, Extension::EXT_hp_mixed_reality_controller,
	 hands,
	 "L:x/click:b L:y/click:b R:a/click:b R:b/click:b menu/click:b squeeze/value:f trigger/value:f thumbstick:v "
	 "thumbstick/x:f thumbstick/y:f thumbstick/click:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"ml/ml2_controller", "Magic Leap 2 Controller", Since::version1_1, Extension::ML_ml2_controller_interaction, hands,
	 "menu/click:b home/click:b trigger/click:b trigger/value:f trackpad:v trackpad/x:f trackpad/y:f "
	 "trackpad/click:b trackpad/force:f trackpad/touch:b grip/pose:p aim/pose:p shoulder/click:b /output/haptic:h"},
	{"facebook/touch_controller_pro", "Meta Quest Touch Pro Controller", Since::never, Extension::FB_touch_controller_pro, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f "
	 "thumbstick/click:b thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h "
	 "thumbrest/force:f stylus_fb/force:f trigger/curl_fb:f trigger/slide_fb:f thumb_fb/proximity_fb:b "
	 "trigger/proximity_fb:b /output/haptic_trigger_fb:h /output/haptic_thumb_fb:h"},
	{"meta/touch_controller_plus", "Meta Quest Touch Plus Controller", Since::never, Extension::META_touch_controller_plus, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f "
	 "thumbstick/click:b thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h "
	 "thumb_meta/proximity_meta:b trigger/proximity_meta:b trigger/curl_meta:f trigger/slide_meta:f trigger/force:f"},
	{"meta/touch_pro_controller", "Meta Quest Touch Pro Controller", Since::version1_1, Extension::count, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f "
	 "thumbstick/click:b thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h "
	 "thumbrest/force:f stylus/force:f thumb_resting_surfaces/proximity:b trigger_curl/value:f trigger_slide/value:f "
	 "trigger/proximity:b /output/haptic_trigger:h /output/haptic_thumb:h"},
	{"meta/touch_plus_controller", "Meta Quest Touch Plus Controller", Since::version1_1, Extension::count, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f "
	 "thumbstick/click:b thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h "
	 "thumb_resting_surfaces/proximity:b trigger/proximity:b trigger_curl/value:f trigger_slide/value:f "
	 "trigger/force:f"},
	{"meta/touch_controller_rift_cv1", "Rift CV1 Controller", Since::version1_1, Extension::count, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b trigger/proximity:b "
	 "thumb_resting_surfaces/proximity:b thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"meta/touch_controller_quest_1_rift_s", "Quest / Rift S Controller", Since::version1_1, Extension::count, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b trigger/proximity:b "
	 "thumb_resting_surfaces/proximity:b thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "thumbstick/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"meta/touch_controller_quest_2", "Quest 2 Controller", Since::version1_1, Extension::count, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/value:f trigger/value:f trigger/touch:b trigger/proximity:b "
	 "thumb_resting_surfaces/proximity:b thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b "
	 "thumbstick/touch:b thumbrest/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"bytedance/pico_neo3_controller", "Bytedance PICO Neo3 Controller", Since::version1_1, Extension::BD_controller_interaction, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b system/click:b "
	 "menu/click:b squeeze/click:b squeeze/value:f trigger/click:b trigger/touch:b trigger/value:f thumbstick:v "
	 "thumbstick/x:f thumbstick/y:f thumbstick/click:b thumbstick/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"bytedance/pico4_controller", "Bytedance PICO 4 Controller", Since::version1_1, Extension::BD_controller_interaction, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:menu/click:b L:y/touch:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "system/click:b squeeze/click:b squeeze/value:f trigger/click:b trigger/touch:b trigger/value:f thumbstick:v "
	 "thumbstick/x:f thumbstick/y:f thumbstick/click:b thumbstick/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
	{"bytedance/pico_g3_controller", "Bytedance PICO G3 Controller", Since::version1_1, Extension::BD_controller_interaction, hands,
	 "trigger/click:b trigger/value:f menu/click:b grip/pose:p aim/pose:p thumbstick:v thumbstick/click:b"},
	{"ext/hand_interaction_ext", "EXT hand interaction profile", Since::never, Extension::EXT_hand_interaction, hands,
	 "grip/pose:p aim/pose:p pinch_ext/value:f pinch_ext/ready_ext:b grasp_ext/value:f grasp_ext/ready_ext:b "
	 "aim_activate_ext/value:f aim_activate_ext/ready_ext:b"},
	{"oppo/mr_controller_oppo", "OPPO MR Controller", Since::never, Extension::OPPO_controller_interaction, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:menu/click:b L:y/touch:b L:heartrate_oppo/value:f R:a/click:b "
	 "R:a/touch:b R:b/click:b R:b/touch:b R:home/click:b squeeze/value:f trigger/touch:b trigger/value:f "
	 "thumbstick:v thumbstick/x:f thumbstick/y:f thumbstick/click:b thumbstick/touch:b grip/pose:p aim/pose:p "
	 "/output/haptic:h"},
	{"yvr/touch_controller_yvr", "YVR Touch Controller", Since::never, Extension::YVR_controller_interaction, hands,
	 "L:x/click:b L:x/touch:b L:y/click:b L:y/touch:b L:menu/click:b R:a/click:b R:a/touch:b R:b/click:b R:b/touch:b "
	 "R:system/click:b squeeze/click:b trigger/value:f trigger/touch:b thumbstick:v thumbstick/x:f thumbstick/y:f "
	 "thumbstick/click:b thumbstick/touch:b grip/pose:p aim/pose:p /output/haptic:h"},
};

} // namespace

std::span<const InteractionProfile> interactionProfiles() { return profiles; }

} // namespace arift::openxr
