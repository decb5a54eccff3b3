// A Vulkan device without a window: what buffers, images, pipelines and commands are made of.
#pragma once

#include "gpu/device.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rigel::tools {

struct GpuOptions {
  bool validation = false;       // the Khronos layer, checks of synchronisation included (slower)
  bool preferCpuDevice = false;  // a software device before a GPU: tests, so that they see the same everywhere
  std::string deviceName = {};   // part of the device's name; "": RIGEL_VULKAN_DEVICE, else any
  std::vector<std::string> features = {};    // of VkPhysicalDeviceFeatures, by name, that must be there
  std::filesystem::path pipelineCache = {};  // file that keeps compiled pipelines from run to run; "": none
  double timeout = 60;                       // s that one submission may take
};

/// One device and one queue. Cheap to copy: copies are the same device, and what was made from it keeps it alive. One
/// thread at a time.
class GpuContext {
 public:
  /// An error says what is missing: the loader, a driver (and the package that brings one), the validation layer, a
  /// device of that name, a feature.
  static Result<GpuContext> create(const GpuOptions& options = {});

  /// As the driver gives it, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string name() const { return device_->properties.deviceName; }
  /// "Vulkan 1.3.230, driver 0.0.1".
  std::string versions() const;
  const VkPhysicalDeviceLimits& limits() const { return device_->properties.limits; }
  /// `bytes` rounded up to where the next dynamic uniform block may start.
  std::size_t uniformStride(std::size_t bytes) const;
  /// Fallbacks that were taken and files that were ignored, one line each.
  const std::vector<std::string>& notes() const { return device_->notes; }

  /// Messages of the validation layer; may be kept beyond the device's end, which brings some.
  const std::shared_ptr<GpuMessages>& messages() const { return device_->messages; }

  /// How many have been created so far.
  int shaderModulesCreated() const { return device_->shaderModulesCreated; }
  int pipelinesCreated() const { return device_->pipelinesCreated; }

  /// Writes options.pipelineCache, whole or not at all; does nothing if there is none.
  std::optional<Error> savePipelineCache() const;

  const SharedDevice& device() const { return device_; }

 private:
  GpuContext(SharedDevice device, std::filesystem::path pipelineCache);

  SharedDevice device_;
  std::filesystem::path pipelineCache_;
};

}  // namespace rigel::tools
