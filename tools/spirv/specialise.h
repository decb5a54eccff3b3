// SPIR-V as it is once its specialisation constants are known: what a driver gets to compile.
#pragma once

#include <rigel/result.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rigel::tools {

struct SpecialisedConstant {
  std::uint32_t id;
  std::uint32_t bits;
};

/// Inputs and outputs of the stage: those used, or all, for stages before and after that were compiled apart (layers
/// complain of outputs that nobody takes).
enum class StageInterface { used, whole };

/// The module with these constants in place of their defaults, all constants frozen, optimised, names removed,
/// canonical (canonical.h): two shaders that do the same are the same words. Error: what the optimiser says of a module
/// it does not take.
Result<std::vector<std::uint32_t>> specialise(std::span<const std::uint32_t> words,
                                              std::span<const SpecialisedConstant> constants,
                                              StageInterface interface = StageInterface::used);

/// Instructions in the bodies of functions, labels and the ends of functions aside.
int instructionCount(std::span<const std::uint32_t> words);

}  // namespace rigel::tools
