// Compiled pipelines kept from run to run. The file names the device and driver it is for and carries a hash: what is
// damaged, or of another device, driver or version of this format, is left aside with a note, since drivers trust what
// they are handed.
#pragma once

#include "gpu/device.h"

#include <cstddef>
#include <filesystem>
#include <span>

namespace rigel::tools {

/// The file's bytes for what a driver gave.
std::vector<std::byte> packPipelineCache(const VkPhysicalDeviceProperties& device, std::span<const std::byte> data);

/// The driver's data out of a file's bytes; an error says why they are of no use on this device.
Result<std::vector<std::byte>> unpackPipelineCache(const VkPhysicalDeviceProperties& device,
                                                   std::span<const std::byte> file);

/// Fills device.pipelineCache, from `file` if it is there and fits; otherwise empty, with a note if there was a file.
std::optional<Error> createPipelineCache(GpuDevice& device, const std::filesystem::path& file);

std::optional<Error> savePipelineCache(const GpuDevice& device, const std::filesystem::path& file);

}  // namespace rigel::tools
