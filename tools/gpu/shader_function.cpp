#include "gpu/shader_function.h"

#include <algorithm>
#include <cstring>

namespace rigel::tools {
namespace {

constexpr std::uint32_t kGroup = 64;  // rows that run together
enum Binding : std::uint32_t { kInputs, kOutputs, kUniforms, kTexels, kTextures };

std::string block(const char* qualifiers, Binding binding) {
  return std::string("layout(") + qualifiers + "binding = " + std::to_string(binding) + ") ";
}

std::string parameters(std::span<const ShaderVariable> inputs, std::span<const ShaderVariable> outputs) {
  std::string text;
  for (const ShaderVariable& v : inputs) text += (text.empty() ? "in " : ", in ") + v.declaration();
  for (const ShaderVariable& v : outputs) text += (text.empty() ? "inout " : ", inout ") + v.declaration();
  return text;
}

std::string arguments(std::span<const ShaderVariable> inputs, std::span<const ShaderVariable> outputs) {
  std::string text;
  for (const auto& variables : {inputs, outputs}) {
    for (const ShaderVariable& v : variables) text += (text.empty() ? "" : ", ") + v.name;
  }
  return text;
}

/// What comes before the user's own text: a row of inputs and of outputs for each invocation.
std::string head(const ShaderFunctionSource& source) {
  std::string text = "#version 450\n#extension GL_GOOGLE_include_directive : require\n";
  text += "layout(local_size_x = " + std::to_string(kGroup) + ") in;\n";
  text += block("std430, ", kInputs) + "readonly buffer HarnessInputs { float harnessInputs[]; };\n";
  text += block("std430, ", kOutputs) + "writeonly buffer HarnessOutputs { float harnessOutputs[]; };\n";
  if (source.texels) text += block("", kTexels) + "uniform samplerBuffer texels;\n";
  if (source.textures > 0) {
    text += block("", kTextures) + "uniform sampler3D textures[" + std::to_string(source.textures) + "];\n";
  }
  return text;
}

std::vector<ShaderText> textOf(const ShaderFunctionSource& source, std::span<const ShaderVariable> inputs,
                               std::span<const ShaderVariable> outputs) {
  const auto own = [](std::string text) { return ShaderText{"harness", std::move(text)}; };
  std::vector<ShaderText> parts = {own(head(source)), {"types", source.types}};
  if (!source.uniforms.empty()) {
    parts.push_back(own("\n#include <rigel/shader_types.h>\n" + block("std140, ", kUniforms) + "uniform Shared {\n"));
    parts.push_back({"uniforms", source.uniforms});
    parts.push_back(own("\n} shared_;\n"));
  }
  parts.push_back({"prelude", source.prelude});
  parts.push_back(own("\nvoid harnessBody(" + parameters(inputs, outputs) + ") {\n"));
  parts.push_back({"body", source.body});
  // No test for rows beyond the last: an early return in front of reads costs lavapipe 7 times the time.
  parts.push_back(own("\n}\nvoid main() {\n  uint harnessIn = gl_GlobalInvocationID.x * " +
                      std::to_string(floatsOf(inputs)) + "u;\n  uint harnessOut = gl_GlobalInvocationID.x * " +
                      std::to_string(floatsOf(outputs)) + "u;\n" + glslLoads(inputs, "harnessInputs", "harnessIn") +
                      glslUnset(outputs) + "  harnessBody(" + arguments(inputs, outputs) + ");\n" +
                      glslStores(outputs, "harnessOutputs", "harnessOut") + "}\n"));
  return parts;
}

std::vector<BindingSlot> slotsOf(const ShaderFunctionSource& source) {
  using Kind = BindingSlot::Kind;
  std::vector<BindingSlot> slots = {{kInputs, Kind::storage}, {kOutputs, Kind::storage}};
  if (!source.uniforms.empty()) slots.push_back({kUniforms, Kind::uniform});
  if (source.texels) slots.push_back({kTexels, Kind::texels});
  if (source.textures > 0) slots.push_back({kTextures, Kind::texture, static_cast<std::uint32_t>(source.textures)});
  return slots;
}

std::size_t roundedUp(std::size_t rows) { return (rows + kGroup - 1) / kGroup * kGroup; }

}  // namespace

ShaderFunction::ShaderFunction(const GpuContext& context, const ShaderFunctionSource& source, GpuPipeline pipeline,
                               GpuBindings bindings, GpuCommands commands)
    : context_(context),
      uniformsDeclared_(source.uniforms),
      hasTexels_(source.texels),
      textureCount_(source.textures),
      pipeline_(std::move(pipeline)),
      bindings_(std::move(bindings)),
      commands_(std::move(commands)) {}

Result<ShaderFunction> ShaderFunction::create(GpuContext& context, const ShaderFunctionSource& source) {
  const auto inputs = parseShaderVariables(source.inputs);
  if (!inputs) return inputs.error();
  const auto outputs = parseShaderVariables(source.outputs);
  if (!outputs) return outputs.error();
  if (inputs->empty() || outputs->empty()) return Error{"needs an input and an output at least", "shader function"};
  std::vector<std::filesystem::path> folders = source.folders;
  folders.push_back(shaderLibrary());
  const auto compiled = compileShader(ShaderKind::compute, textOf(source, *inputs, *outputs), folders);
  if (!compiled) return compiled.error();

  const auto layout = GpuLayout::create(context, slotsOf(source));
  if (!layout) return layout.error();
  auto pipeline = GpuPipeline::compute(context, *layout, compiled->spirv);
  if (!pipeline) return pipeline.error();
  auto bindings = GpuBindings::create(context, *layout);
  if (!bindings) return bindings.error();
  auto commands = GpuCommands::create(context);
  if (!commands) return commands.error();
  ShaderFunction function(context, source, *std::move(pipeline), *std::move(bindings), *std::move(commands));
  function.inputFloats_ = floatsOf(*inputs);
  function.outputFloats_ = floatsOf(*outputs);
  function.uniformBytes_ = compiled->uniformBlockBytes;
  return function;
}

void ShaderFunction::setUniforms(std::span<const std::byte> data) {
  uniformData_.assign(data.begin(), data.end());
  sharedChanged_ = true;
}

void ShaderFunction::setTexels(std::span<const float> rgba) {
  texelData_.assign(rgba.begin(), rgba.end());
  sharedChanged_ = true;
}

void ShaderFunction::setTexture(int index, const Texture3d& texture) {
  textures_.insert_or_assign(index, texture);
  sharedChanged_ = true;
}

std::optional<Error> ShaderFunction::bindShared() {
  if (!sharedChanged_) return {};
  if (!uniformsDeclared_.empty()) {
    // A struct of C++ may end with the padding that std140 leaves out.
    if (uniformData_.size() < uniformBytes_ || uniformData_.size() > (uniformBytes_ + 15) / 16 * 16) {
      return Error{"the block has " + std::to_string(uniformBytes_) + " bytes, " + std::to_string(uniformData_.size()) +
                       " are set",
                   "uniforms"};
    }
    auto buffer = GpuBuffer::create(context_, BufferUse::uniform, uniformData_);
    if (!buffer) return buffer.error();
    uniforms_ = *std::move(buffer);
    if (const auto error = bindings_.set(kUniforms, *uniforms_)) return error;
  }
  if (hasTexels_) {
    if (texelData_.empty()) return Error{"none are set", "texels"};
    auto buffer = GpuBuffer::of<float>(context_, BufferUse::texels, texelData_);
    if (!buffer) return buffer.error();
    texels_ = *std::move(buffer);
    if (const auto error = bindings_.set(kTexels, *texels_)) return error;
  }
  for (int i = 0; i < textureCount_; ++i) {
    const auto texture = textures_.find(i);
    if (texture == textures_.end()) return Error{"is not set", "textures[" + std::to_string(i) + "]"};
    if (const auto error = bindings_.set(kTextures, texture->second, static_cast<std::uint32_t>(i))) return error;
  }
  sharedChanged_ = false;
  return {};
}

std::size_t ShaderFunction::blockRows() const {
  constexpr std::size_t kBytes = 16 << 20;  // small beside any device's memory, large beside the cost of a submission
  const VkPhysicalDeviceLimits& limits = context_.limits();
  const std::size_t rowBytes = static_cast<std::size_t>(std::max(inputFloats_, outputFloats_)) * sizeof(float);
  const std::size_t byMemory = std::min<std::size_t>(kBytes, limits.maxStorageBufferRange) / rowBytes;
  const std::size_t byGroups = std::size_t{limits.maxComputeWorkGroupCount[0]} * kGroup;
  return std::max<std::size_t>(std::min(byMemory, byGroups) / kGroup * kGroup, kGroup);
}

std::optional<Error> ShaderFunction::reserve(std::size_t rows) {
  if (rows <= reservedRows_) return {};
  auto inputs = GpuBuffer::create(context_, BufferUse::storage, rows * inputFloats_ * sizeof(float));
  if (!inputs) return inputs.error();
  auto outputs = GpuBuffer::create(context_, BufferUse::output, rows * outputFloats_ * sizeof(float));
  if (!outputs) return outputs.error();
  inputs_ = *std::move(inputs);
  outputs_ = *std::move(outputs);
  reservedRows_ = rows;
  if (const auto error = bindings_.set(kInputs, *inputs_)) return error;
  return bindings_.set(kOutputs, *outputs_);
}

Result<std::vector<float>> ShaderFunction::operator()(std::span<const float> rows) {
  const auto width = static_cast<std::size_t>(inputFloats_);
  if (rows.size() % width != 0) {
    return Error{std::to_string(rows.size()) + " floats are no whole number of rows of " + std::to_string(width),
                 "shader function"};
  }
  if (const auto error = bindShared()) return *error;
  const std::size_t count = rows.size() / width;
  const std::size_t perBlock = blockRows();
  if (const auto error = reserve(std::min(roundedUp(count), perBlock))) return *error;
  std::vector<float> results(count * outputFloats_);
  for (std::size_t first = 0; first < count; first += perBlock) {
    const std::size_t n = std::min(perBlock, count - first);
    const auto to = std::span(results).subspan(first * outputFloats_, n * outputFloats_);
    if (const auto error = runBlock(rows.subspan(first * width, n * width), to)) return *error;
  }
  return results;
}

std::optional<Error> ShaderFunction::runBlock(std::span<const float> rows, std::span<float> results) {
  const auto width = static_cast<std::size_t>(inputFloats_);
  const std::size_t count = rows.size() / width;
  const std::size_t padded = roundedUp(count);
  const std::span<float> inputs = inputs_->as<float>();
  std::ranges::copy(rows, inputs.begin());
  // The last group is filled up with the last row: what the body can bear.
  for (std::size_t i = count; i < padded; ++i) {
    std::ranges::copy(rows.last(width), inputs.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
  if (const auto error = commands_.begin()) return error;
  commands_.bind(pipeline_, bindings_);
  commands_.dispatch(static_cast<std::uint32_t>(padded / kGroup));
  if (const auto error = commands_.run()) return error;
  std::memcpy(results.data(), outputs_->bytes().data(), results.size_bytes());
  return {};
}

}  // namespace rigel::tools
