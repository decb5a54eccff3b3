// GLSL to SPIR-V at run time, for tests and studies; what ships is compiled when Rigel is built.
#pragma once

#include <rigel/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// A part of a shader's text, under the name that messages call it by; each part counts its lines from 1.
struct ShaderText {
  std::string name;
  std::string text;
};

struct CompiledShader {
  std::vector<std::uint32_t> spirv;   // 1.3, for Vulkan 1.1
  std::size_t uniformBlockBytes = 0;  // of its uniform block, if it has one
};

enum class ShaderKind { vertex, fragment, compute };

/// Compiles the parts, one after the other, as one shader. `#include <FILE>` and `#include "FILE"` are looked up in
/// `folders` (a shader asks for them by `#extension GL_GOOGLE_include_directive : require`). An error is the compiler's
/// first, its place PART:LINE, or FILE:LINE as the file was included.
Result<CompiledShader> compileShader(ShaderKind kind, std::span<const ShaderText> parts,
                                     std::span<const std::filesystem::path> folders);

/// As spirv-val for Vulkan 1.1, which compileShader has every result pass. An error is the first.
std::optional<Error> validateSpirv(std::span<const std::uint32_t> spirv);

/// The folder of Rigel's GLSL library in the source tree.
std::filesystem::path shaderLibrary();

}  // namespace rigel::tools
