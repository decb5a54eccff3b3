// What every test of shaders uses: one device for the test process, with the validation layer listening.
#pragma once

#include "gpu/shader_function.h"

#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace rigel::test {

/// A software device where there is one, so that tests see the same everywhere (RIGEL_VULKAN_DEVICE chooses otherwise).
/// Validation and checks of synchronisation are on: any message fails the test that caused it. No device fails the test
/// too.
tools::GpuContext& gpu();

/// gpu()'s messages since the last call, for tests that provoke some.
std::vector<std::string> takeGpuMessages();

/// The value, or the test fails with the error.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().line());
  return *std::move(result);
}
inline void must(const std::optional<Error>& error) {
  if (error) throw std::runtime_error(error->line());
}

/// Compiles a function, or fails the test with the compiler's message.
tools::ShaderFunction shaderFunction(const tools::ShaderFunctionSource& source);

/// Runs it, or fails the test.
std::vector<float> run(tools::ShaderFunction& function, std::span<const float> rows);

/// `body` over the rows at once, for functions that are used once.
std::vector<float> evaluate(const tools::ShaderFunctionSource& source, std::span<const float> rows);

}  // namespace rigel::test
