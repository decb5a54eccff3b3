#include "gpu/vulkan_api.h"

#include <dlfcn.h>

namespace rigel::tools {

#define RIGEL_DEFINE(name) PFN_##name name = nullptr;
RIGEL_VULKAN_FUNCTIONS(RIGEL_DEFINE)
#undef RIGEL_DEFINE

namespace {

std::optional<Error> lookUp() {
  // Never closed: drivers keep threads that must not outlive their code.
  void* loader = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (loader == nullptr) {
    return Error{
        "no Vulkan loader (libvulkan.so.1): install a Vulkan driver, on Debian the package mesa-vulkan-drivers",
        "Vulkan"};
  }
  const char* missing = nullptr;
#define RIGEL_LOOK_UP(name)                                    \
  name = reinterpret_cast<PFN_##name>(::dlsym(loader, #name)); \
  if (name == nullptr) missing = #name;
  RIGEL_VULKAN_FUNCTIONS(RIGEL_LOOK_UP)
#undef RIGEL_LOOK_UP
  if (missing == nullptr) return {};
  return Error{std::string("the Vulkan loader is older than Vulkan 1.1: it lacks ") + missing, "libvulkan.so.1"};
}

const char* causeOf(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of memory (VK_ERROR_OUT_OF_HOST_MEMORY)";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory (VK_ERROR_OUT_OF_DEVICE_MEMORY)";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "out of descriptors (VK_ERROR_OUT_OF_POOL_MEMORY)";
    case VK_ERROR_FRAGMENTED_POOL:
      return "out of descriptors (VK_ERROR_FRAGMENTED_POOL)";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver could not start (VK_ERROR_INITIALIZATION_FAILED)";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost: the driver reset it (VK_ERROR_DEVICE_LOST)";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "memory cannot be mapped (VK_ERROR_MEMORY_MAP_FAILED)";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "a layer is missing (VK_ERROR_LAYER_NOT_PRESENT)";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is missing (VK_ERROR_EXTENSION_NOT_PRESENT)";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing (VK_ERROR_FEATURE_NOT_PRESENT)";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no driver fits (VK_ERROR_INCOMPATIBLE_DRIVER)";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects (VK_ERROR_TOO_MANY_OBJECTS)";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "a format is not supported (VK_ERROR_FORMAT_NOT_SUPPORTED)";
    case VK_ERROR_INVALID_SHADER_NV:
      return "the driver refuses the shader (VK_ERROR_INVALID_SHADER_NV)";
    default:
      return nullptr;
  }
}

}  // namespace

std::optional<Error> loadVulkan() {
  static const std::optional<Error> kOutcome = lookUp();
  return kOutcome;
}

Error vulkanError(VkResult result, const std::string& doing) {
  const char* cause = causeOf(result);
  return {cause != nullptr ? cause : "Vulkan error " + std::to_string(static_cast<int>(result)), doing};
}

}  // namespace rigel::tools
