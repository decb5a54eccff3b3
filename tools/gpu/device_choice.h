// Which of a machine's Vulkan devices is used.
#pragma once

#include "gpu/device.h"

#include <span>

namespace rigel::tools {

struct DeviceWish {
  std::string name = {};                    // part of the device's name, any case; "": any device
  std::string namedBy = {};                 // what told the name, for errors: "RIGEL_VULKAN_DEVICE=" or ""
  bool preferCpu = false;                   // a software device before a GPU
  std::span<const std::string> features{};  // of VkPhysicalDeviceFeatures, by name
};

/// Fills device.physical, .queueFamily, .properties, .memory and .timestampBits. An error names every device and why it
/// does not serve, or, where there is none, the package to install.
std::optional<Error> chooseDevice(GpuDevice& device, const DeviceWish& wish);

/// The features by name; an unknown name is an error.
Result<VkPhysicalDeviceFeatures> featuresNamed(std::span<const std::string> names);

}  // namespace rigel::tools
