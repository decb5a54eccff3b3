// The file of compiled pipelines: handed to a driver only if it is whole and of that driver.
#include "gpu/pipeline_cache.h"

#include "gpu/gpu_test.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <cstring>

namespace rigel::test {
namespace {

using namespace tools;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::size_t kHeaderBytes = 56;

VkPhysicalDeviceProperties someDevice() {
  VkPhysicalDeviceProperties device{};
  device.vendorID = 0x10de;
  device.deviceID = 0x2204;
  device.driverVersion = 7;
  for (std::uint8_t i = 0; i < VK_UUID_SIZE; ++i) device.pipelineCacheUUID[i] = i;
  return device;
}

/// What a driver of `device` might give: Vulkan's header and some content.
std::vector<std::byte> driverData(const VkPhysicalDeviceProperties& device) {
  VkPipelineCacheHeaderVersionOne header{};
  header.headerSize = sizeof(header);
  header.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
  header.vendorID = device.vendorID;
  header.deviceID = device.deviceID;
  std::memcpy(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE);
  std::vector<std::byte> data(sizeof(header) + 100, std::byte{42});
  std::memcpy(data.data(), &header, sizeof(header));
  return data;
}

std::string refusal(const VkPhysicalDeviceProperties& device, std::span<const std::byte> file) {
  const auto unpacked = unpackPipelineCache(device, file);
  return unpacked ? "taken" : unpacked.error().message;
}

TEST(PipelineCache, TakesBackWhatItPacked) {
  const auto data = driverData(someDevice());
  EXPECT_EQ(must(unpackPipelineCache(someDevice(), packPipelineCache(someDevice(), data))), data);
}

TEST(PipelineCache, RefusesEveryTruncationAndEveryChangedByte) {
  const auto file = packPipelineCache(someDevice(), driverData(someDevice()));
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_NE(refusal(someDevice(), std::span(file).first(size)), "taken") << size;
  }
  for (std::size_t i = 0; i < file.size(); ++i) {
    auto damaged = file;
    damaged[i] ^= std::byte{0x10};
    EXPECT_NE(refusal(someDevice(), damaged), "taken") << i;
  }
  auto longer = file;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refusal(someDevice(), longer), "damaged");
}

TEST(PipelineCache, RefusesWhatIsForAnother) {
  const auto file = packPipelineCache(someDevice(), driverData(someDevice()));
  auto vendor = someDevice(), device = someDevice(), driver = someDevice(), cacheId = someDevice();
  ++vendor.vendorID;
  ++device.deviceID;
  ++driver.driverVersion;
  ++cacheId.pipelineCacheUUID[15];
  for (const auto& other : {vendor, device, driver, cacheId}) {
    EXPECT_EQ(refusal(other, file), "of another device or driver");
  }
  // Rigel's header fits and the driver's own does not.
  EXPECT_EQ(refusal(someDevice(), packPipelineCache(someDevice(), driverData(device))), "the driver's part is damaged");
  EXPECT_EQ(refusal(someDevice(), packPipelineCache(someDevice(), {})), "the driver's part is damaged");
  auto newer = file;
  newer[4] = std::byte{2};
  EXPECT_EQ(refusal(someDevice(), newer), "of another version of the format");
  EXPECT_EQ(refusal(someDevice(), std::vector<std::byte>(kHeaderBytes)), "not a pipeline cache of Rigel");
}

GpuContext contextWith(const std::filesystem::path& file) {
  return must(GpuContext::create({.preferCpuDevice = true, .pipelineCache = file}));
}

TEST(PipelineCache, GoesFromOneContextToTheNext) {
  const TemporaryFolder folder;
  const auto file = folder / "pipelines";
  {
    GpuContext first = contextWith(file);
    EXPECT_THAT(first.notes(), IsEmpty()) << "that there is no file yet is nothing to speak of";
    must(ShaderFunction::create(first, {.inputs = {"float x"}, .outputs = {"float y"}, .body = "y = x;"}));
    must(first.savePipelineCache());
  }
  EXPECT_GT(std::filesystem::file_size(file), kHeaderBytes);
  const GpuContext second = contextWith(file);
  EXPECT_THAT(second.notes(), IsEmpty());
  must(second.savePipelineCache());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing is left beside it";
}

TEST(PipelineCache, ADamagedFileIsIgnoredWithANoteAndReplaced) {
  const TemporaryFolder folder;
  const auto file = folder / "pipelines";
  writeFile(file, "not a cache, but longer than the header of one would be, so that there is something to read");
  const GpuContext context = contextWith(file);
  EXPECT_THAT(context.notes(),
              ElementsAre("pipeline cache " + file.string() + " is ignored: not a pipeline cache of Rigel"));
  must(context.savePipelineCache());
  EXPECT_THAT(contextWith(file).notes(), IsEmpty());
}

TEST(PipelineCache, SavingSaysWhatFails) {
  const TemporaryFolder folder;
  const auto error = contextWith(folder / "nowhere" / "pipelines").savePipelineCache();
  ASSERT_TRUE(error);
  EXPECT_THAT(error->line(), HasSubstr("cannot write"));
  EXPECT_FALSE(contextWith("").savePipelineCache());
}

}  // namespace
}  // namespace rigel::test
