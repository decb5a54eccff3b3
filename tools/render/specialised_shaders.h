// Shaders as a variant needs them and no more, kept from run to run.
//
// A driver handed an entry shader with its constants beside it first reads all that the shader might do: of lavapipe's
// start with all its own compiled code at hand that is nine tenths (README.md).
#pragma once

#include "gpu/shader.h"

#include <rigel/result.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rigel::tools {

class SpecialisedShaders {
 public:
  /// With what `file` holds, if it is whole and of this version of the format; "" keeps nothing.
  explicit SpecialisedShaders(std::filesystem::path file);

  /// The entry shader of that name (shader_binaries.h) with these constants, optimised: 50 to 150 ms the first time.
  /// Valid while this is.
  Result<std::span<const std::uint32_t>> get(const std::string& name, std::span<const ShaderConstant> constants);

  /// Writes the file, whole or not at all, if there is anything new.
  std::optional<Error> save();

  std::size_t made() const { return made_; }  // not found in the file

 private:
  std::filesystem::path file_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> shaders_;  // by a hash of shader and constants
  std::size_t made_ = 0;
  bool changed_ = false;
};

/// The file's bytes, and back; an error says why they are of no use.
std::vector<std::uint32_t> packShaders(const std::map<std::uint64_t, std::vector<std::uint32_t>>& shaders);
Result<std::map<std::uint64_t, std::vector<std::uint32_t>>> unpackShaders(std::span<const std::uint32_t> file);

}  // namespace rigel::tools
