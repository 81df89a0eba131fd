// The extensions this runtime has: name, revision, and which of them an instance has enabled.
#pragma once
#include "runtime/openxr/api.h"
#include <array>
#include <bitset>
#include <optional>
#include <string_view>

namespace arift::openxr
{

#define ARIFT_EXTENSIONS(X)                                                                                                                \
	X(KHR_vulkan_enable)                                                                                                                   \
	X(KHR_vulkan_enable2)                                                                                                                  \
	X(KHR_opengl_enable)                                                                                                                   \
	X(KHR_opengl_es_enable)                                                                                                                \
	X(MNDX_egl_enable)                                                                                                                     \
	X(KHR_convert_timespec_time)                                                                                                           \
	X(KHR_extended_struct_name_lengths)                                                                                                    \
	X(KHR_locate_spaces)                                                                                                                   \
	X(KHR_maintenance1)                                                                                                                    \
	X(KHR_visibility_mask)                                                                                                                 \
	X(KHR_swapchain_usage_input_attachment_bit)                                                                                            \
	X(KHR_vulkan_swapchain_format_list)                                                                                                    \
	X(EXT_debug_utils)                                                                                                                     \
	X(EXT_hand_tracking)                                                                                                                   \
	X(EXT_local_floor)                                                                                                                     \
	X(EXT_palm_pose)                                                                                                                       \
	X(EXT_performance_settings)                                                                                                            \
	X(EXT_user_presence)                                                                                                                   \
	X(EXT_uuid)                                                                                                                            \
	X(MSFT_unbounded_reference_space)                                                                                                      \
	X(FB_color_space)                                                                                                                      \
	X(KHR_composition_layer_color_scale_bias)                                                                                              \
	X(KHR_composition_layer_cube)                                                                                                          \
	X(KHR_composition_layer_cylinder)                                                                                                      \
	X(KHR_composition_layer_depth)                                                                                                         \
	X(KHR_composition_layer_equirect)                                                                                                      \
	X(KHR_composition_layer_equirect2)                                                                                                     \
	X(FB_composition_layer_alpha_blend)                                                                                                    \
	X(FB_composition_layer_depth_test)                                                                                                     \
	X(FB_composition_layer_settings)                                                                                                       \
	X(FB_display_refresh_rate)                                                                                                             \
	X(FB_passthrough)                                                                                                                      \
	X(VARJO_composition_layer_depth_test)                                                                                                  \
	X(META_headset_id)                                                                                                                     \
	X(MSFT_controller_model)                                                                                                               \
	X(META_performance_metrics)                                                                                                            \
	X(EXT_hand_interaction)                                                                                                                \
	X(EXT_hp_mixed_reality_controller)                                                                                                     \
	X(EXT_samsung_odyssey_controller)                                                                                                      \
	X(MSFT_hand_interaction)                                                                                                               \
	X(HTC_hand_interaction)                                                                                                                \
	X(HTC_vive_cosmos_controller_interaction)                                                                                              \
	X(HTC_vive_focus3_controller_interaction)                                                                                              \
	X(ML_ml2_controller_interaction)                                                                                                       \
	X(BD_controller_interaction)                                                                                                           \
	X(FB_touch_controller_pro)                                                                                                             \
	X(FB_touch_controller_proximity)                                                                                                       \
	X(META_touch_controller_plus)                                                                                                          \
	X(HUAWEI_controller_interaction)                                                                                                       \
	X(OPPO_controller_interaction)                                                                                                         \
	X(YVR_controller_interaction)                                                                                                          \
	X(KHR_binding_modification)                                                                                                            \
	X(EXT_active_action_set_priority)                                                                                                      \
	X(EXT_conformance_automation)                                                                                                          \
	X(EXT_dpad_binding)                                                                                                                    \
	X(EXTX_overlay)                                                                                                                        \
	X(MND_headless)

#define ARIFT_ROW(name) name,
enum class Extension : uint32_t { ARIFT_EXTENSIONS(ARIFT_ROW) count };
#undef ARIFT_ROW

struct ExtensionInfo {
	const char *name;
	uint32_t specVersion;
};
#define ARIFT_ROW(name) {"XR_" #name, XR_##name##_SPEC_VERSION},
inline constexpr std::array extensionInfos = std::to_array<ExtensionInfo>({ARIFT_EXTENSIONS(ARIFT_ROW)});
#undef ARIFT_ROW

class ExtensionSet
{
public:
	void enable(Extension extension) { enabled_.set(size_t(extension)); }
	bool has(Extension extension) const { return enabled_.test(size_t(extension)); }
	bool hasAnyOf(std::initializer_list<Extension> extensions) const
	{
		for (const Extension extension : extensions)
			if (has(extension)) return true;
		return false;
	}

private:
	std::bitset<size_t(Extension::count)> enabled_;
};

/// What decides what an instance has.
struct Features {
	bool is1_1 = false;
	ExtensionSet extensions;
};

inline std::optional<Extension> extensionNamed(std::string_view name)
{
	for (size_t i = 0; i < extensionInfos.size(); ++i)
		if (name == extensionInfos[i].name) return Extension(i);
	return std::nullopt;
}

} // namespace arift::openxr
