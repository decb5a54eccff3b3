#include "spirv/specialise.h"

#include "spirv/canonical.h"

#include <fmt/format.h>
#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <string>
#include <unordered_map>

namespace rigel::tools {
namespace {

constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kOpFunction = 54, kOpFunctionParameter = 55, kOpFunctionEnd = 56, kOpLabel = 248;

/// Interface variables that nothing reads are kept by the optimiser's performance passes alone.
void addPasses(spvtools::Optimizer& optimizer, std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values) {
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateUnifyConstantPass())
      .RegisterPerformancePasses()
      .RegisterPass(spvtools::CreateLoopUnrollPass(true))
      .RegisterPerformancePasses()
      .RegisterPass(spvtools::CreateRemoveUnusedInterfaceVariablesPass())
      .RegisterPass(spvtools::CreateEliminateDeadConstantPass())
      .RegisterPass(spvtools::CreateStripDebugInfoPass());
}

}  // namespace

Result<std::vector<std::uint32_t>> specialise(std::span<const std::uint32_t> words,
                                              std::span<const SpecialisedConstant> constants) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  std::string message = "SPIR-V that cannot be optimised";
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t& at, const char* text) {
    if (level <= SPV_MSG_ERROR) message = fmt::format("SPIR-V word {}: {}", at.index, text);
  });
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (const SpecialisedConstant& constant : constants) values[constant.id] = {constant.bits};
  addPasses(optimizer, std::move(values));
  std::vector<std::uint32_t> result;
  if (!optimizer.Run(words.data(), words.size(), &result)) return Error{message, "spirv"};
  return canonical(result);
}

int instructionCount(std::span<const std::uint32_t> words) {
  int count = 0;
  bool inFunction = false;
  for (std::size_t i = kHeaderWords; i < words.size(); i += std::max(1u, words[i] >> 16)) {
    const std::uint32_t op = words[i] & 0xffff;
    if (op == kOpFunction) {
      inFunction = true;
    } else if (op == kOpFunctionEnd) {
      inFunction = false;
    } else if (inFunction && op != kOpFunctionParameter && op != kOpLabel) {
      ++count;
    }
  }
  return count;
}

}  // namespace rigel::tools
