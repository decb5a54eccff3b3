// Finding a device, and what is said when there is none.
#include "gpu/gpu_test.h"

#include <gmock/gmock.h>

namespace rigel::test {
namespace {

using ::testing::HasSubstr;
using tools::GpuContext;
using tools::GpuOptions;

TEST(GpuContext, TestsRunOnASoftwareDeviceUnlessToldOtherwise) {
  if (std::getenv("RIGEL_VULKAN_DEVICE") == nullptr) {
    EXPECT_EQ(gpu().device()->properties.deviceType, VK_PHYSICAL_DEVICE_TYPE_CPU) << gpu().name();
  }
  EXPECT_THAT(gpu().versions(), HasSubstr("Vulkan 1."));
}

}  // namespace
}  // namespace rigel::test
