// A GLSL expression or function as a C++ function, for unit tests of shaders: rows of inputs go in, rows of outputs
// come out, the device computes. shaders/README.md has an example.
#pragma once

#include "gpu/commands.h"
#include "gpu/shader_compiler.h"
#include "gpu/shader_variable.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// Text is compiled in the order types, uniforms, prelude, body; errors name these parts and the line within them.
struct ShaderFunctionSource {
  std::string prelude = {};          // "#define RIGEL_BANDS 5\n#include <rigel/sh.glsl>\n" and helper functions
  std::vector<std::string> inputs;   // one declaration each: "vec3 n", "float w[12]"; of float, int, vec2, vec3, vec4
  std::vector<std::string> outputs;  // the same: "float y[9]"; what the body does not set is NaN, or INT_MIN
  std::string body;                  // statements that read the inputs and set the outputs; may `return`
  std::string uniforms = {};         // members of a std140 block called shared_: "GpuRig rig; vec4 coefficients[64];"
  bool texels = false;               // declares `uniform samplerBuffer texels` of RGBA32F
  int textures = 0;                  // declares `uniform sampler3D textures[n]`
  std::string types = {};            // structs and macros that the uniforms need; <rigel/shader_types.h> is included
  std::vector<std::filesystem::path> folders = {};  // where includes are looked up before Rigel's library
};

class ShaderFunction {
 public:
  /// Compiles it. Errors: the compiler's, at PART:LINE or FILE:LINE; a declaration that is none; a limit of the device.
  static Result<ShaderFunction> create(GpuContext& context, const ShaderFunctionSource& source);

  /// Rows of inputs, packed without padding, integers as floats (exact to 2^24), give rows of outputs likewise. Any
  /// number of rows. Errors: not whole rows; uniforms, texels or textures not set; out of memory, time-out.
  Result<std::vector<float>> operator()(std::span<const float> rows);

  void setUniforms(std::span<const std::byte> block);    // all of the block's std140 bytes
  void setTexels(std::span<const float> rgba);           // a multiple of 4
  void setTexture(int index, const Texture3d& texture);  // is kept

  int inputFloats() const { return inputFloats_; }    // a row
  int outputFloats() const { return outputFloats_; }  // a row

 private:
  ShaderFunction(const GpuContext& context, const ShaderFunctionSource& source, GpuPipeline pipeline,
                 GpuBindings bindings, GpuCommands commands);
  std::optional<Error> bindShared();
  std::optional<Error> reserve(std::size_t rows);
  std::size_t blockRows() const;
  std::optional<Error> runBlock(std::span<const float> rows, std::span<float> results);

  GpuContext context_;
  std::string uniformsDeclared_;
  bool hasTexels_;
  int textureCount_;
  int inputFloats_ = 0;
  int outputFloats_ = 0;
  std::size_t uniformBytes_ = 0;
  GpuPipeline pipeline_;
  GpuBindings bindings_;
  GpuCommands commands_;
  std::size_t reservedRows_ = 0;
  std::optional<GpuBuffer> inputs_, outputs_, uniforms_, texels_;
  std::vector<std::byte> uniformData_;
  std::vector<float> texelData_;
  std::map<int, Texture3d> textures_;
  bool sharedChanged_ = true;
};

}  // namespace rigel::tools
