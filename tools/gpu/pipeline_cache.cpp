#include "gpu/pipeline_cache.h"

#include "picture/file_replace.h"

#include <cstring>
#include <fstream>
#include <iterator>

namespace rigel::tools {
namespace {

constexpr std::uint32_t kMagic = 0x43504752;  // "RGPC"
constexpr std::uint32_t kVersion = 1;

struct Header {
  std::uint32_t magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t vendor = 0;
  std::uint32_t device = 0;
  std::uint32_t driverVersion = 0;
  std::uint32_t pointerBytes = sizeof(void*);
  std::uint8_t cacheId[VK_UUID_SIZE] = {};
  std::uint64_t bytes = 0;
  std::uint64_t hash = 0;  // of the data
};
static_assert(sizeof(Header) == 56);

/// FNV-1a: against damage, not against malice.
std::uint64_t hashOf(std::span<const std::byte> data) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::byte b : data) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
  return hash;
}

Header headerFor(const VkPhysicalDeviceProperties& device, std::span<const std::byte> data) {
  Header header;
  header.vendor = device.vendorID;
  header.device = device.deviceID;
  header.driverVersion = device.driverVersion;
  std::memcpy(header.cacheId, device.pipelineCacheUUID, VK_UUID_SIZE);
  header.bytes = data.size();
  header.hash = hashOf(data);
  return header;
}

/// What the driver wrote in front of its own data must name this device too (Vulkan 1.1, section 10.6).
bool driverHeaderFits(const VkPhysicalDeviceProperties& device, std::span<const std::byte> data) {
  VkPipelineCacheHeaderVersionOne header{};
  if (data.size() < sizeof(header)) return false;
  std::memcpy(&header, data.data(), sizeof(header));
  return header.headerSize >= sizeof(header) && header.headerSize <= data.size() &&
         header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == device.vendorID &&
         header.deviceID == device.deviceID &&
         std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

std::vector<std::byte> contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  const auto bytes = std::as_bytes(std::span(content));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::byte> packPipelineCache(const VkPhysicalDeviceProperties& device, std::span<const std::byte> data) {
  const Header header = headerFor(device, data);
  std::vector<std::byte> file(sizeof(header) + data.size());
  std::memcpy(file.data(), &header, sizeof(header));
  if (!data.empty()) std::memcpy(file.data() + sizeof(header), data.data(), data.size());
  return file;
}

Result<std::vector<std::byte>> unpackPipelineCache(const VkPhysicalDeviceProperties& device,
                                                   std::span<const std::byte> file) {
  Header header;
  if (file.size() < sizeof(header)) return Error{"shorter than its header", ""};
  std::memcpy(&header, file.data(), sizeof(header));
  if (header.magic != kMagic) return Error{"not a pipeline cache of Rigel", ""};
  if (header.version != kVersion) return Error{"of another version of the format", ""};
  const auto data = file.subspan(sizeof(header));
  if (header.bytes != data.size() || header.hash != hashOf(data)) return Error{"damaged", ""};
  const Header own = headerFor(device, data);
  if (std::memcmp(&header, &own, sizeof(header)) != 0) return Error{"of another device or driver", ""};
  if (!driverHeaderFits(device, data)) return Error{"the driver's part is damaged", ""};
  return std::vector<std::byte>(data.begin(), data.end());
}

std::optional<Error> createPipelineCache(GpuDevice& device, const std::filesystem::path& file) {
  std::vector<std::byte> data;
  std::error_code ignored;
  if (!file.empty() && std::filesystem::exists(file, ignored)) {
    auto unpacked = unpackPipelineCache(device.properties, contentOf(file));
    if (unpacked)
      data = *std::move(unpacked);
    else
      device.note("pipeline cache " + file.string() + " is ignored: " + unpacked.error().message);
  }
  auto info = vulkanStruct<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  const VkResult result = vkCreatePipelineCache(device.device, &info, nullptr, &device.pipelineCache);
  if (result != VK_SUCCESS) return vulkanError(result, "a pipeline cache");
  return {};
}

std::optional<Error> savePipelineCache(const GpuDevice& device, const std::filesystem::path& file) {
  std::size_t size = 0;
  VkResult result = vkGetPipelineCacheData(device.device, device.pipelineCache, &size, nullptr);
  std::vector<std::byte> data(size);
  if (result == VK_SUCCESS) {
    result = vkGetPipelineCacheData(device.device, device.pipelineCache, &size, data.data());
  }
  if (result != VK_SUCCESS) return vulkanError(result, "reading the pipeline cache");
  data.resize(size);
  const std::vector<std::byte> bytes = packPipelineCache(device.properties, data);
  const auto written = replaceFile(file, [&](const std::filesystem::path& aside) {
    std::ofstream stream(aside, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
  if (!written) return written.error();
  return {};
}

}  // namespace rigel::tools
