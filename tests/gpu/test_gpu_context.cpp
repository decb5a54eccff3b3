// Finding a device, what is said when there is none, and whether the validation layer would notice a fault.
#include "gpu/device_choice.h"
#include "gpu/gpu_test.h"
#include "gpu/replaced.h"
#include "gpu/run_self.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <cstring>

namespace rigel::test {
namespace {

using namespace tools;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string errorOf(const GpuOptions& options) {
  const auto context = GpuContext::create(options);
  return context ? "created" : context.error().line();
}

TEST(GpuContext, TestsRunOnASoftwareDeviceUnlessToldOtherwise) {
  if (std::getenv("RIGEL_VULKAN_DEVICE") == nullptr) {
    EXPECT_EQ(gpu().device()->properties.deviceType, VK_PHYSICAL_DEVICE_TYPE_CPU) << gpu().name();
  }
  EXPECT_THAT(gpu().versions(), HasSubstr("Vulkan 1."));
  EXPECT_THAT(gpu().notes(), IsEmpty());
}

TEST(GpuContext, NamesTheDevicesThereAre) {
  if (isChild()) {
    gpu();
    return;
  }
  EXPECT_THAT(errorOf({.deviceName = "Voodoo 3"}),
              AllOf(HasSubstr("\"Voodoo 3\": no Vulkan device here"), HasSubstr(gpu().name())));
  EXPECT_EQ(errorOf({.deviceName = gpu().name().substr(0, 4)}), "created");
  EXPECT_THAT(runSelf("RIGEL_VULKAN_DEVICE=Voodoo").output,
              HasSubstr("RIGEL_VULKAN_DEVICE=\"Voodoo\": no Vulkan device here"));
}

TEST(GpuContext, NamesTheFeatureThatIsMissing) {
  EXPECT_EQ(errorOf({.features = {"geometryShader"}}), "created");
  EXPECT_EQ(errorOf({.features = {"warpDrive"}}), "warpDrive: not a device feature that Rigel knows");
  const Replaced none(
      vkGetPhysicalDeviceFeatures, +[](VkPhysicalDevice, VkPhysicalDeviceFeatures* features) { *features = {}; });
  EXPECT_THAT(errorOf({.features = {"geometryShader", "shaderFloat64"}}),
              HasSubstr("lacks geometryShader, shaderFloat64"));
}

TEST(GpuContext, NamesThePackageWithoutADriver) {
  if (isChild()) {
    gpu();
    return;
  }
  const TemporaryFolder folder;
  writeFile(folder / "none.json", "");
  const ChildOutcome outcome = runSelf("VK_DRIVER_FILES=" + (folder / "none.json").string());
  EXPECT_EQ(outcome.exitCode, 1) << "a missing device must fail the test";
  EXPECT_THAT(outcome.output,
              HasSubstr("no Vulkan device: install a driver, on Debian the package mesa-vulkan-drivers"));
}

TEST(GpuContext, NamesThePackageWithoutALoader) {
  if (isChild()) {
    gpu();
    return;
  }
  const TemporaryFolder folder;
  writeFile(folder / "libvulkan.so.1", "not a library");
  const ChildOutcome outcome = runSelf("LD_LIBRARY_PATH=" + folder.path().string());
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.output, HasSubstr("no Vulkan loader (libvulkan.so.1): install a Vulkan driver, on Debian the "
                                        "package mesa-vulkan-drivers"));
}

TEST(GpuContext, NamesThePackageWithoutTheValidationLayer) {
  gpu();
  const Replaced none(
      vkEnumerateInstanceLayerProperties, +[](std::uint32_t* count, VkLayerProperties*) {
        *count = 0;
        return VK_SUCCESS;
      });
  EXPECT_EQ(errorOf({.validation = true}),
            "VK_LAYER_KHRONOS_validation: not installed: on Debian it is in the package vulkan-validationlayers");
  EXPECT_EQ(errorOf({}), "created");
}

// Choosing among devices that are not there.

struct FakeDevice {
  const char* name;
  VkPhysicalDeviceType type;
  std::uint32_t version;
};

std::vector<FakeDevice> fakes;

const FakeDevice& fakeOf(VkPhysicalDevice handle) { return fakes[reinterpret_cast<std::uintptr_t>(handle) - 1]; }

/// The name of the device chosen among `devices`, or the error.
std::string chosen(std::vector<FakeDevice> devices, const DeviceWish& wish) {
  loadVulkan();
  fakes = std::move(devices);
  const Replaced enumerate(
      vkEnumeratePhysicalDevices, +[](VkInstance, std::uint32_t* count, VkPhysicalDevice* all) {
        *count = static_cast<std::uint32_t>(fakes.size());
        for (std::uintptr_t i = 0; all != nullptr && i < *count; ++i)
          all[i] = reinterpret_cast<VkPhysicalDevice>(i + 1);
        return VK_SUCCESS;
      });
  const Replaced describe(
      vkGetPhysicalDeviceProperties, +[](VkPhysicalDevice device, VkPhysicalDeviceProperties* p) {
        *p = {};
        p->deviceType = fakeOf(device).type;
        p->apiVersion = fakeOf(device).version;
        std::strcpy(p->deviceName, fakeOf(device).name);
      });
  const Replaced families(
      vkGetPhysicalDeviceQueueFamilyProperties,
      +[](VkPhysicalDevice, std::uint32_t* count, VkQueueFamilyProperties* all) {
        *count = 2;
        if (all == nullptr) return;
        all[0] = {VK_QUEUE_TRANSFER_BIT, 1, 64, {1, 1, 1}};
        all[1] = {VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT, 1, 36, {1, 1, 1}};
      });
  const Replaced memory(
      vkGetPhysicalDeviceMemoryProperties, +[](VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* p) { *p = {}; });
  const Replaced features(
      vkGetPhysicalDeviceFeatures, +[](VkPhysicalDevice, VkPhysicalDeviceFeatures* f) { *f = {}; });
  GpuDevice device;
  device.instance = reinterpret_cast<VkInstance>(std::uintptr_t{1});
  const auto error = chooseDevice(device, wish);
  device.instance = VK_NULL_HANDLE;
  if (error) return error->line();
  EXPECT_EQ(device.queueFamily, 1u);
  EXPECT_EQ(device.timestampBits, 36u);
  return device.properties.deviceName;
}

TEST(DeviceChoice, PrefersAGpuAndTestsAProcessor) {
  const std::vector<FakeDevice> three = {{"Llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU, VK_API_VERSION_1_3},
                                         {"Small", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, VK_API_VERSION_1_1},
                                         {"Big", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_API_VERSION_1_2}};
  EXPECT_EQ(chosen(three, {}), "Big");
  EXPECT_EQ(chosen(three, {.preferCpu = true}), "Llvmpipe");
  EXPECT_EQ(chosen(three, {.name = "sMALL", .preferCpu = true}), "Small");
  EXPECT_EQ(chosen({three[1], three[2]}, {.preferCpu = true}), "Big");
  EXPECT_EQ(chosen({three[0]}, {}), "Llvmpipe");
  EXPECT_EQ(chosen(three, {.name = "Huge"}),
            "\"Huge\": no Vulkan device here has that in its name; there are: Llvmpipe, Small, Big");
}

TEST(DeviceChoice, SaysWhyNoneServes) {
  EXPECT_EQ(chosen({{"Old", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_API_VERSION_1_0}}, {}),
            "Vulkan: no Vulkan device serves: Old older than Vulkan 1.1");
  EXPECT_THAT(chosen({}, {}), HasSubstr("mesa-vulkan-drivers"));
}

// Whether faults would be noticed.

const char* const kAddOne = "y = x + 1.0;";

/// A buffer of vertices where the shader reads uniforms.
void misuse() {
  const std::array<BindingSlot, 1> slots = {{{0, BindingSlot::Kind::uniform}}};
  GpuBindings bindings = must(GpuBindings::create(gpu(), must(GpuLayout::create(gpu(), slots))));
  const GpuBuffer vertices = must(GpuBuffer::create(gpu(), BufferUse::vertices, 16));
  must(bindings.set(0, vertices));
}

GpuPipeline computing(const GpuLayout& layout, const std::string& declarations, const std::string& body) {
  const ShaderText part{"shader",
                        "#version 450\nlayout(local_size_x = 1) in;\n" + declarations + "void main() { " + body + " }"};
  return must(
      GpuPipeline::compute(gpu(), layout, must(compileShader(ShaderKind::compute, std::span(&part, 1), {})).spirv));
}

/// One dispatch writes a number and the next one reads it, with or without a barrier in between. (The layer keeps quiet
/// about two that write.)
void writeAndRead(bool ordered) {
  const std::array<BindingSlot, 2> slots = {{{0, BindingSlot::Kind::storage}, {1, BindingSlot::Kind::storage}}};
  const GpuLayout layout = must(GpuLayout::create(gpu(), slots));
  const GpuPipeline write = computing(layout, "layout(binding = 0) buffer A { float a; };\n", "a = 2.0;");
  const GpuPipeline read = computing(
      layout, "layout(binding = 0) readonly buffer A { float a; };\nlayout(binding = 1) buffer B { float b; };\n",
      "b = a;");
  const GpuBuffer a = must(GpuBuffer::create(gpu(), BufferUse::output, 4));
  GpuBuffer b = must(GpuBuffer::create(gpu(), BufferUse::output, 4));
  GpuBindings bindings = must(GpuBindings::create(gpu(), layout));
  must(bindings.set(0, a));
  must(bindings.set(1, b));
  GpuCommands commands = must(GpuCommands::create(gpu()));
  must(commands.begin());
  commands.bind(write, bindings);
  commands.dispatch(1);
  if (ordered) commands.barrier();
  commands.bind(read, bindings);
  commands.dispatch(1);
  must(commands.run());
  if (ordered) {
    EXPECT_EQ(b.as<float>()[0], 2);
  }
}

TEST(Validation, NoticesMisuse) {
  misuse();
  EXPECT_THAT(takeGpuMessages(), ElementsAre(HasSubstr("VUID-VkWriteDescriptorSet")));
}

TEST(Validation, NoticesAMissingBarrier) {
  writeAndRead(false);
  EXPECT_THAT(takeGpuMessages(), ::testing::Contains(HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE")));
  writeAndRead(true);
  EXPECT_THAT(takeGpuMessages(), IsEmpty());
}

TEST(Validation, FailsTheTestThatIsAtFault) {
  if (isChild()) {
    misuse();
    return;
  }
  const ChildOutcome outcome = runSelf();
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.output, HasSubstr("VUID-VkWriteDescriptorSet"));
}

TEST(Validation, FailsAProcessThatLeavesObjectsBehind) {
  if (isChild()) {
    gpu();
    VkFence fence = VK_NULL_HANDLE;
    const auto info = vulkanStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    vkCreateFence(gpu().device()->device, &info, nullptr, &fence);
    return;
  }
  const ChildOutcome outcome = runSelf();
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.output, HasSubstr("VUID-vkDestroyDevice-device"));
}

TEST(Validation, CountsShadersAndPipelines) {
  const int modules = gpu().shaderModulesCreated(), pipelines = gpu().pipelinesCreated();
  ShaderFunction function = shaderFunction({.inputs = {"float x"}, .outputs = {"float y"}, .body = kAddOne});
  EXPECT_EQ(gpu().shaderModulesCreated(), modules + 1);
  EXPECT_EQ(gpu().pipelinesCreated(), pipelines + 1);
  run(function, std::vector<float>{1});
  EXPECT_EQ(gpu().pipelinesCreated(), pipelines + 1);
}

}  // namespace
}  // namespace rigel::test
