// The Vulkan instance and the messages of its validation layer.
#pragma once

#include "gpu/device.h"

namespace rigel::tools {

/// Fills device.instance and, where messages are to be had, device.messenger. With `validation` the Khronos layer is
/// on, checks of synchronisation included, and it is an error if it is not installed.
std::optional<Error> createInstance(GpuDevice& device, bool validation);

}  // namespace rigel::tools
