// Devices that lack something, run out of memory, are lost or do not finish: a named fallback or a clear error, and
// nothing hangs. Functions of Vulkan are replaced to see it happen.
#include "gpu/gpu_test.h"
#include "gpu/replaced.h"

#include <gmock/gmock.h>

#include <array>
#include <numeric>

namespace rigel::test {
namespace {

using namespace tools;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ShaderFunctionSource doubling() { return {.inputs = {"float x"}, .outputs = {"float y"}, .body = "y = 2.0 * x;"}; }

template <class T>
std::string errorOf(const Result<T>& result) {
  return result ? "no error" : result.error().line();
}

std::string errorOf(const std::optional<Error>& error) { return error ? error->line() : "no error"; }

// Limits.

VkPhysicalDeviceLimits limits;  // of the next context

/// A context of gpu()'s device that claims to have `changed` limits.
GpuContext contextWith(const std::function<void(VkPhysicalDeviceLimits&)>& change) {
  limits = gpu().limits();
  change(limits);
  static PFN_vkGetPhysicalDeviceProperties original;
  original = vkGetPhysicalDeviceProperties;
  const Replaced lying(
      vkGetPhysicalDeviceProperties, +[](VkPhysicalDevice device, VkPhysicalDeviceProperties* p) {
        original(device, p);
        p->limits = limits;
      });
  return must(GpuContext::create({.preferCpuDevice = true}));
}

TEST(GpuLimits, AreNamed) {
  const GpuContext small = contextWith([](VkPhysicalDeviceLimits& l) {
    l.maxTexelBufferElements = 4;
    l.maxStorageBufferRange = 256;
    l.maxUniformBufferRange = 128;
    l.maxImageDimension3D = 8;
    l.maxPushConstantsSize = 16;
  });
  EXPECT_THAT(errorOf(GpuBuffer::create(small, BufferUse::texels, 80)),
              HasSubstr("a texel buffer of 80 bytes: the device takes 64 at most"));
  EXPECT_THAT(errorOf(GpuBuffer::create(small, BufferUse::storage, 260)),
              HasSubstr("a storage buffer of 260 bytes: the device takes 256 at most"));
  EXPECT_THAT(errorOf(Texture3d::create(small, {9, 1, 1}, TextureFormat::rgba32f, std::vector<float>(36))),
              HasSubstr("a 3-D texture of 9 x 1 x 1: the device takes 1 to 8 a side"));
  EXPECT_THAT(errorOf(Texture3d::create(small, {0, 1, 1}, TextureFormat::rgba32f, {})), HasSubstr("0 x 1 x 1"));
  EXPECT_THAT(errorOf(GpuLayout::create(small, {}, 20)),
              HasSubstr("20 bytes of push constants: the device takes 16 at most"));
  const std::array<BindingSlot, 1> slots = {{{0, BindingSlot::Kind::uniform}}};
  GpuBindings bindings = must(GpuBindings::create(small, must(GpuLayout::create(small, slots))));
  const GpuBuffer block = must(GpuBuffer::create(small, BufferUse::uniform, 256));
  EXPECT_THAT(errorOf(bindings.set(0, block)), HasSubstr("a uniform block of 256 bytes: the device takes 128 at most"));
  EXPECT_EQ(errorOf(bindings.set(0, block, 128)), "no error");
}

TEST(GpuLimits, ShaderFunctionsWorkInPartsThatFit) {
  std::vector<float> rows(1000);
  std::iota(rows.begin(), rows.end(), 0.0f);
  for (const bool byGroups : {false, true}) {
    GpuContext small = contextWith([&](VkPhysicalDeviceLimits& l) {
      if (byGroups)
        l.maxComputeWorkGroupCount[0] = 3;
      else
        l.maxStorageBufferRange = 520;
    });
    ShaderFunction function = must(ShaderFunction::create(small, doubling()));
    const std::vector<float> results = must(function(rows));
    for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_EQ(results[i], 2 * rows[i]);
  }
}

TEST(GpuLimits, WithoutTimestampsTimesAreThoseOfTheSubmission) {
  static PFN_vkGetPhysicalDeviceQueueFamilyProperties original;
  gpu();
  original = vkGetPhysicalDeviceQueueFamilyProperties;
  const Replaced lying(
      vkGetPhysicalDeviceQueueFamilyProperties,
      +[](VkPhysicalDevice device, std::uint32_t* count, VkQueueFamilyProperties* all) {
        original(device, count, all);
        for (std::uint32_t i = 0; all != nullptr && i < *count; ++i) all[i].timestampValidBits = 0;
      });
  const GpuContext plain = must(GpuContext::create({.preferCpuDevice = true}));
  GpuCommands commands = must(GpuCommands::create(plain));
  EXPECT_FALSE(commands.hasTimestamps());
  must(commands.begin());
  const int from = commands.mark(), to = commands.mark();
  must(commands.run());
  EXPECT_GT(commands.seconds(from, to), 0);
  GpuCommands timed = must(GpuCommands::create(gpu()));
  EXPECT_TRUE(timed.hasTimestamps());
}

// Formats.

PFN_vkGetPhysicalDeviceFormatProperties originalFormats;

template <VkFormat... Lacking>
void lackLinearFilter(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties) {
  originalFormats(device, format, properties);
  if (((format == Lacking) || ...)) {
    properties->optimalTilingFeatures &= ~VkFormatFeatureFlags{VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT};
  }
}

TEST(GpuFormats, HalfFloatsStandInWhereFloatsAreNotFiltered) {
  const GpuContext own = must(GpuContext::create({.preferCpuDevice = true}));
  originalFormats = vkGetPhysicalDeviceFormatProperties;
  const Replaced lying(vkGetPhysicalDeviceFormatProperties, &lackLinearFilter<VK_FORMAT_R32G32B32A32_SFLOAT>);
  const std::vector<float> fine = {1, 2, 3, 4};
  const Texture3d texture = must(Texture3d::create(own, {1, 1, 1}, TextureFormat::rgba32f, fine));
  must(Texture3d::create(own, {1, 1, 1}, TextureFormat::rgba32f, fine));  // the note comes once
  EXPECT_EQ(texture.format(), TextureFormat::rgba16f);
  EXPECT_EQ(texture.bytes(), 8u);
  EXPECT_THAT(own.notes(), ElementsAre("3-D textures are RGBA16F: the device does not filter RGBA32F"));
  EXPECT_THAT(errorOf(Texture3d::create(own, {1, 1, 1}, TextureFormat::rgba32f, std::array<float, 4>{70000})),
              HasSubstr("70000 is beyond half-float range: scale it"));
}

TEST(GpuFormats, WithoutEitherThereIsAnError) {
  const GpuContext own = must(GpuContext::create({.preferCpuDevice = true}));
  originalFormats = vkGetPhysicalDeviceFormatProperties;
  const Replaced lying(vkGetPhysicalDeviceFormatProperties,
                       &lackLinearFilter<VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT>);
  EXPECT_THAT(errorOf(Texture3d::create(own, {1, 1, 1}, TextureFormat::rgba32f, std::vector<float>(4))),
              HasSubstr("filters neither RGBA32F nor RGBA16F"));
}

TEST(GpuFormats, TexturesTellHowManyValuesTheyWant) {
  EXPECT_THAT(errorOf(Texture3d::create(gpu(), {2, 1, 1}, TextureFormat::rgba16f, std::vector<float>(4))),
              HasSubstr("4 floats given, 8 expected"));
}

// Memory.

int allocationsLeft = 0;
PFN_vkAllocateMemory originalAllocate;

VKAPI_ATTR VkResult VKAPI_CALL runOut(VkDevice device, const VkMemoryAllocateInfo* info,
                                      const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (allocationsLeft-- <= 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  return originalAllocate(device, info, callbacks, memory);
}

TEST(GpuMemory, MoreThanThereIsIsRefusedWithItsSize) {
  EXPECT_THAT(errorOf(GpuBuffer::create(gpu(), BufferUse::vertices, std::size_t{3} << 30)),
              AllOf(HasSubstr("out of device memory"), HasSubstr("3221225472 bytes for vertices")));
  EXPECT_THAT(errorOf(GpuBuffer::create(gpu(), BufferUse::vertices, std::size_t{1} << 50)), HasSubstr("out of"));
  EXPECT_THAT(errorOf(GpuBuffer::create(gpu(), BufferUse::vertices, std::size_t{0})), HasSubstr("no bytes asked for"));
}

TEST(GpuMemory, RunningOutIsAnErrorOfWhateverIsBeingMade) {
  gpu();
  originalAllocate = vkAllocateMemory;
  constexpr std::array kFormats = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_UINT};
  const std::vector<float> values(4 * 8);
  for (int allowed = 0; allowed < 3; ++allowed) {
    const Replaced failing(vkAllocateMemory, &runOut);
    allocationsLeft = allowed;
    EXPECT_THAT(errorOf(RasterTarget::create(gpu(), 64, 64, kFormats)), HasSubstr("out of device memory"));
    if (allowed < 2) {
      allocationsLeft = allowed;
      EXPECT_THAT(errorOf(Texture3d::create(gpu(), {2, 2, 2}, TextureFormat::rgba32f, values)),
                  HasSubstr("out of device memory"));
      ShaderFunction function = shaderFunction(doubling());
      allocationsLeft = allowed;
      EXPECT_THAT(errorOf(function(std::array<float, 1>{1})), HasSubstr("out of device memory"));
      // With memory to be had again it works.
      allocationsLeft = 100;
      EXPECT_THAT(must(function(std::array<float, 1>{1})), ElementsAre(2));
    }
  }
  EXPECT_TRUE(GpuBuffer::create(gpu(), BufferUse::vertices, std::size_t{64}));
}

TEST(GpuMemory, TheNextKindServesWhereOneRunsOut) {
  GpuDevice device;
  device.memory.memoryHeapCount = 1;
  device.memory.memoryHeaps[0].size = 1000;
  device.memory.memoryTypeCount = 3;
  constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  device.memory.memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  device.memory.memoryTypes[1].propertyFlags = kHost;
  device.memory.memoryTypes[2].propertyFlags = kHost | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  static std::vector<std::uint32_t> tried;
  static std::byte mapped;
  tried.clear();
  gpu();
  const Replaced onlyTheFirst(
      vkAllocateMemory, +[](VkDevice, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks*, VkDeviceMemory*) {
        tried.push_back(info->memoryTypeIndex);
        return info->memoryTypeIndex == 1 ? VK_SUCCESS : VK_ERROR_OUT_OF_DEVICE_MEMORY;
      });
  const Replaced map(
      vkMapMemory, +[](VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize, VkMemoryMapFlags, void** to) {
        *to = &mapped;
        return VK_SUCCESS;
      });
  EXPECT_EQ(must(allocateMemory(device, {100, 1, 7}, MemoryUse::upload, "x")).mapped, &mapped);
  EXPECT_THAT(tried, ElementsAre(2, 1));
  tried.clear();
  EXPECT_THAT(errorOf(allocateMemory(device, {100, 1, 5}, MemoryUse::upload, "x")), HasSubstr("out of device memory"));
  EXPECT_THAT(tried, ElementsAre(2));
  tried.clear();
  EXPECT_THAT(errorOf(allocateMemory(device, {2000, 1, 7}, MemoryUse::upload, "x")), HasSubstr("2000 bytes for x"));
  EXPECT_THAT(tried, IsEmpty()) << "larger than the heap";
}

// Work that fails or does not end. Each on a context of its own, which takes no more work afterwards.

TEST(GpuWork, ALostDeviceIsReportedAndTakesNoMoreWork) {
  const GpuContext own = must(GpuContext::create({.preferCpuDevice = true}));
  GpuCommands commands = must(GpuCommands::create(own));
  must(commands.begin());
  {
    const Replaced losing(
        vkQueueSubmit, +[](VkQueue, std::uint32_t, const VkSubmitInfo*, VkFence) { return VK_ERROR_DEVICE_LOST; });
    EXPECT_THAT(errorOf(commands.run()), AllOf(HasSubstr(own.name()), HasSubstr("the device was lost")));
  }
  EXPECT_THAT(errorOf(commands.begin()), HasSubstr("the device was lost"));
  GpuContext copy = own;
  ShaderFunction function = must(ShaderFunction::create(copy, doubling()));
  EXPECT_THAT(errorOf(function(std::array<float, 1>{1})), HasSubstr("the device was lost"));
}

TEST(GpuWork, ADeviceLostWhileWorkingIsReported) {
  gpu();  // keeps the driver loaded, so that what it loses with a lost device is known for its own
  const GpuContext own = must(GpuContext::create({.preferCpuDevice = true}));
  GpuCommands commands = must(GpuCommands::create(own));
  must(commands.begin());
  must(commands.submit());
  {
    const Replaced losing(
        vkWaitForFences,
        +[](VkDevice, std::uint32_t, const VkFence*, VkBool32, std::uint64_t) { return VK_ERROR_DEVICE_LOST; });
    EXPECT_THAT(errorOf(commands.wait()), HasSubstr("the device was lost"));
  }
  EXPECT_THAT(errorOf(commands.begin()), HasSubstr("the device was lost"));
}

TEST(GpuWork, WorkWithoutEndIsGivenUp) {
  GpuContext own = must(GpuContext::create({.preferCpuDevice = true, .timeout = 0.05}));
  // Some seconds of work, which no compiler can foresee the outcome of.
  ShaderFunction function = must(ShaderFunction::create(
      own,
      {.inputs = {"int k"},
       .outputs = {"float y"},
       .body =
           "int s = k;\nfor (int i = 0; i < 100000000; ++i) s = s * 1664525 + 1013904223 + (s >> 3);\ny = float(s);"}));
  const std::vector<float> rows(64 * 64, 1.0f);
  EXPECT_THAT(errorOf(function(rows)), HasSubstr("the work did not end within 0.05 s"));
  EXPECT_THAT(errorOf(function(rows)), HasSubstr("takes no more work"));
  // Other contexts go on; the given up one is left to itself.
  EXPECT_THAT(evaluate(doubling(), std::array<float, 1>{4}), ElementsAre(8));
}

TEST(GpuWork, EveryFailureHasItsWords) {
  EXPECT_EQ(vulkanError(VK_ERROR_OUT_OF_HOST_MEMORY, "a").line(), "a: out of memory (VK_ERROR_OUT_OF_HOST_MEMORY)");
  EXPECT_EQ(vulkanError(static_cast<VkResult>(-12345), "a").line(), "a: Vulkan error -12345");
}

}  // namespace
}  // namespace rigel::test
