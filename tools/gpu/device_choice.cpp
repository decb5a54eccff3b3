#include "gpu/device_choice.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace rigel::tools {
namespace {

struct FeatureName {
  const char* name;
  VkBool32 VkPhysicalDeviceFeatures::*member;
};

#define RIGEL_FEATURE(name) \
  FeatureName { #name, &VkPhysicalDeviceFeatures::name }
/// Those that a shader of Rigel, or a check of one, may have a use for.
constexpr std::array kFeatures = {
    RIGEL_FEATURE(robustBufferAccess),
    RIGEL_FEATURE(geometryShader),  // gl_PrimitiveID in fragment shaders
    RIGEL_FEATURE(independentBlend),
    RIGEL_FEATURE(fillModeNonSolid),
    RIGEL_FEATURE(pipelineStatisticsQuery),
    RIGEL_FEATURE(vertexPipelineStoresAndAtomics),
    RIGEL_FEATURE(fragmentStoresAndAtomics),
    RIGEL_FEATURE(shaderUniformBufferArrayDynamicIndexing),
    RIGEL_FEATURE(shaderSampledImageArrayDynamicIndexing),
    RIGEL_FEATURE(shaderStorageBufferArrayDynamicIndexing),
    RIGEL_FEATURE(shaderFloat64),
};
#undef RIGEL_FEATURE

bool contains(std::string text, std::string part) {
  const auto lower = [](unsigned char c) { return static_cast<char>(std::tolower(c)); };
  std::ranges::transform(text, text.begin(), lower);
  std::ranges::transform(part, part.begin(), lower);
  return text.find(part) != std::string::npos;
}

int rankOf(VkPhysicalDeviceType type, bool preferCpu) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return preferCpu ? 4 : 0;
    default:
      return 1;
  }
}

std::optional<std::uint32_t> familyOf(VkPhysicalDevice physical, std::uint32_t* timestampBits) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (std::uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & kNeeded) != kNeeded) continue;
    *timestampBits = families[i].timestampValidBits;
    return i;
  }
  return {};
}

/// Why a device does not serve, or "".
std::string shortcomingOf(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties,
                          const DeviceWish& wish) {
  if (properties.apiVersion < VK_API_VERSION_1_1) return "older than Vulkan 1.1";
  std::uint32_t timestampBits = 0;
  if (!familyOf(physical, &timestampBits)) return "no queue for both graphics and compute";
  VkPhysicalDeviceFeatures has{};
  vkGetPhysicalDeviceFeatures(physical, &has);
  std::string missing;
  for (const FeatureName& feature : kFeatures) {
    const bool wanted = std::ranges::find(wish.features, feature.name) != wish.features.end();
    if (wanted && has.*feature.member == VK_FALSE) missing += std::string(missing.empty() ? "" : ", ") + feature.name;
  }
  return missing.empty() ? "" : "lacks " + missing;
}

const char* const kInstall =
    "no Vulkan device: install a driver, on Debian the package mesa-vulkan-drivers (its lavapipe needs no GPU)";

}  // namespace

Result<VkPhysicalDeviceFeatures> featuresNamed(std::span<const std::string> names) {
  VkPhysicalDeviceFeatures features{};
  for (const std::string& name : names) {
    const auto known = std::ranges::find_if(kFeatures, [&](const FeatureName& f) { return name == f.name; });
    if (known == kFeatures.end()) return Error{"not a device feature that Rigel knows", name};
    features.*known->member = VK_TRUE;
  }
  return features;
}

std::optional<Error> chooseDevice(GpuDevice& device, const DeviceWish& wish) {
  std::uint32_t count = 0;
  if (device.instance != VK_NULL_HANDLE) vkEnumeratePhysicalDevices(device.instance, &count, nullptr);
  std::vector<VkPhysicalDevice> all(count);
  if (count > 0) vkEnumeratePhysicalDevices(device.instance, &count, all.data());
  if (count == 0) return Error{kInstall, "Vulkan"};

  int best = -1;
  bool named = false;
  std::string refused, names;
  for (VkPhysicalDevice physical : all) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    names += (names.empty() ? "" : ", ") + std::string(properties.deviceName);
    if (!wish.name.empty() && !contains(properties.deviceName, wish.name)) continue;
    named = true;
    if (const std::string why = shortcomingOf(physical, properties, wish); !why.empty()) {
      refused += (refused.empty() ? "" : "; ") + std::string(properties.deviceName) + " " + why;
      continue;
    }
    const int rank = rankOf(properties.deviceType, wish.preferCpu);
    if (rank <= best) continue;
    best = rank;
    device.physical = physical;
    device.properties = properties;
  }
  if (!named)
    return Error{"no Vulkan device here has that in its name; there are: " + names,
                 wish.namedBy + "\"" + wish.name + "\""};
  if (best < 0) return Error{"no Vulkan device serves: " + refused, "Vulkan"};
  device.queueFamily = *familyOf(device.physical, &device.timestampBits);
  vkGetPhysicalDeviceMemoryProperties(device.physical, &device.memory);
  return {};
}

}  // namespace rigel::tools
