#include "gpu/gpu_test.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>

/// Leaks of the system's libraries; Rigel's own still count.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation.so\nleak:libvulkan_lvp.so\nleak:libLLVM\n";
}
#endif

#include <memory>

namespace rigel::test {
namespace {

std::unique_ptr<tools::GpuContext> context;
std::shared_ptr<tools::GpuMessages> messages;

/// Fails whatever test leaves a message behind.
class MessageListener : public ::testing::EmptyTestEventListener {
  void OnTestEnd(const ::testing::TestInfo&) override {
    for (const std::string& message : takeGpuMessages()) ADD_FAILURE() << message;
  }
};

/// Destroys the device while messages still count: objects that were never destroyed are told of only then.
class DeviceEnvironment : public ::testing::Environment {
  void TearDown() override {
    if (context == nullptr) return;
#ifdef __SANITIZE_ADDRESS__
    // Instead of at the end of the process: with its last device the driver is unloaded, and what it keeps in globals
    // (LLVM's tables) then looks lost.
    __lsan_do_leak_check();
#endif
    const std::weak_ptr<tools::GpuDevice> device = context->device();
    context.reset();
    EXPECT_TRUE(device.expired()) << "something made from gpu() outlives the tests";
    for (const std::string& message : takeGpuMessages()) ADD_FAILURE() << message;
  }
};

const bool kListening = [] {
  ::testing::AddGlobalTestEnvironment(new DeviceEnvironment);
  ::testing::UnitTest::GetInstance()->listeners().Append(new MessageListener);
  return true;
}();

}  // namespace

tools::GpuContext& gpu() {
  if (context == nullptr) {
    tools::GpuOptions options;
    options.validation = true;
    options.preferCpuDevice = true;
    context = std::make_unique<tools::GpuContext>(must(tools::GpuContext::create(options)));
    messages = context->messages();
  }
  return *context;
}

std::vector<std::string> takeGpuMessages() {
  return messages != nullptr ? messages->take() : std::vector<std::string>{};
}

tools::ShaderFunction shaderFunction(const tools::ShaderFunctionSource& source) {
  return must(tools::ShaderFunction::create(gpu(), source));
}

std::vector<float> run(tools::ShaderFunction& function, std::span<const float> rows) { return must(function(rows)); }

std::vector<float> evaluate(const tools::ShaderFunctionSource& source, std::span<const float> rows) {
  auto function = shaderFunction(source);
  return run(function, rows);
}

}  // namespace rigel::test
