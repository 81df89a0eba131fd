// Linked into the programs of a build with AddressSanitizer: what the software driver and the validation layer keep until the process ends
// can be told from leaks of ours only while their modules are loaded, and the Vulkan loader unloads them with its last instance.
#include <dlfcn.h>
#include <initializer_list>

namespace
{

[[maybe_unused]] const bool kept = [] {
	for (const char *module : {"libvulkan_lvp.so", "libVkLayer_khronos_validation.so", "libvulkan.so.1"})
		::dlopen(module, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE); // one that is not there cannot leak
	return true;
}();

} // namespace
