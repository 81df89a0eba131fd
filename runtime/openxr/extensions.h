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
	X(KHR_convert_timespec_time)                                                                                                           \
	X(MND_headless)                                                                                                                        \
	X(EXT_debug_utils)

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

inline std::optional<Extension> extensionNamed(std::string_view name)
{
	for (size_t i = 0; i < extensionInfos.size(); ++i)
		if (name == extensionInfos[i].name) return Extension(i);
	return std::nullopt;
}

} // namespace arift::openxr
