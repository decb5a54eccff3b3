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

/// RegisterPerformancePasses(), with inputs and outputs kept that nothing uses.
void addPassesThatKeepInterfaces(spvtools::Optimizer& optimizer) {
  const auto add = [&](std::initializer_list<spvtools::Optimizer::PassToken (*)()> passes) {
    for (const auto pass : passes) optimizer.RegisterPass(pass());
    optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass(true));
  };
  const auto scalars = [] { return spvtools::CreateScalarReplacementPass(); };
  const auto unroll = [] { return spvtools::CreateLoopUnrollPass(true); };
  add({spvtools::CreateWrapOpKillPass, spvtools::CreateDeadBranchElimPass, spvtools::CreateMergeReturnPass,
       spvtools::CreateInlineExhaustivePass, spvtools::CreateEliminateDeadFunctionsPass});
  add({spvtools::CreatePrivateToLocalPass, spvtools::CreateLocalSingleBlockLoadStoreElimPass,
       spvtools::CreateLocalSingleStoreElimPass});
  add({+scalars, spvtools::CreateLocalAccessChainConvertPass, spvtools::CreateLocalSingleBlockLoadStoreElimPass,
       spvtools::CreateLocalSingleStoreElimPass});
  add({spvtools::CreateLocalMultiStoreElimPass});
  add({spvtools::CreateCCPPass});
  add({+unroll, spvtools::CreateDeadBranchElimPass, spvtools::CreateRedundancyEliminationPass,
       spvtools::CreateCombineAccessChainsPass, spvtools::CreateSimplificationPass, +scalars,
       spvtools::CreateLocalAccessChainConvertPass, spvtools::CreateLocalSingleBlockLoadStoreElimPass,
       spvtools::CreateLocalSingleStoreElimPass});
  add({spvtools::CreateSSARewritePass});
  add({spvtools::CreateVectorDCEPass, spvtools::CreateDeadInsertElimPass, spvtools::CreateDeadBranchElimPass,
       spvtools::CreateSimplificationPass, spvtools::CreateIfConversionPass, spvtools::CreateCopyPropagateArraysPass,
       spvtools::CreateBlockMergePass, spvtools::CreateRedundancyEliminationPass, spvtools::CreateDeadBranchElimPass,
       spvtools::CreateBlockMergePass, spvtools::CreateSimplificationPass});
}

void addPasses(spvtools::Optimizer& optimizer, std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values,
               StageInterface interface) {
  const auto optimise = [&] {
    if (interface == StageInterface::whole) {
      addPassesThatKeepInterfaces(optimizer);
    } else {
      optimizer.RegisterPerformancePasses().RegisterPass(spvtools::CreateRemoveUnusedInterfaceVariablesPass());
    }
  };
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateUnifyConstantPass());
  optimise();
  optimizer.RegisterPass(spvtools::CreateLoopUnrollPass(true));
  optimise();
  optimizer.RegisterPass(spvtools::CreateEliminateDeadConstantPass())
      .RegisterPass(spvtools::CreateStripDebugInfoPass());
}

}  // namespace

Result<std::vector<std::uint32_t>> specialise(std::span<const std::uint32_t> words,
                                              std::span<const SpecialisedConstant> constants,
                                              StageInterface interface) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  std::string message = "SPIR-V that cannot be optimised";
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t& at, const char* text) {
    if (level <= SPV_MSG_ERROR) message = fmt::format("SPIR-V word {}: {}", at.index, text);
  });
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (const SpecialisedConstant& constant : constants) values[constant.id] = {constant.bits};
  addPasses(optimizer, std::move(values), interface);
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
