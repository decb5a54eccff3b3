// One text for modules that say the same.
#pragma once

#include <rigel/result.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rigel::tools {

/// The module with ids numbered, and types, constants and variables declared, in the order in which functions come to
/// need them, without those that nothing needs; decorations and interfaces by number. What a compiler puts in front of
/// functions depends on all that it has ever seen: afterwards only on what is left. Error: words that are no SPIR-V.
Result<std::vector<std::uint32_t>> canonical(std::span<const std::uint32_t> words);

}  // namespace rigel::tools
