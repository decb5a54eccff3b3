#include "gpu/shader_compiler.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>

#include <fstream>
#include <iterator>
#include <memory>

namespace rigel::tools {
namespace {

/// Hands included files to glslang, named as they were asked for.
class FolderIncluder : public glslang::TShader::Includer {
 public:
  explicit FolderIncluder(std::span<const std::filesystem::path> folders) : folders_(folders) {}

  IncludeResult* includeSystem(const char* name, const char*, std::size_t depth) override {
    constexpr std::size_t kDeepest = 64;  // a file that includes itself without a guard
    if (depth > kDeepest) return nullptr;
    for (const std::filesystem::path& folder : folders_) {
      std::ifstream stream(folder / name, std::ios::binary);
      if (!stream || std::filesystem::is_directory(folder / name)) continue;
      auto content =
          std::make_unique<std::string>(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
      const char* data = content->data();
      const std::size_t size = content->size();
      return new IncludeResult(name, data, size, content.release());
    }
    return nullptr;
  }
  IncludeResult* includeLocal(const char* name, const char* from, std::size_t depth) override {
    return includeSystem(name, from, depth);
  }
  void releaseInclude(IncludeResult* result) override {
    if (result == nullptr) return;
    delete static_cast<std::string*>(result->userData);
    delete result;
  }

 private:
  std::span<const std::filesystem::path> folders_;
};

struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

EShLanguage languageOf(ShaderKind kind) {
  switch (kind) {
    case ShaderKind::vertex:
      return EShLangVertex;
    case ShaderKind::fragment:
      return EShLangFragment;
    case ShaderKind::compute:
      return EShLangCompute;
  }
  return EShLangCompute;
}

/// The first "ERROR: PLACE: MESSAGE" of a log.
Error errorOf(const std::string& log) {
  const std::string mark = "ERROR: ";
  const std::size_t start = log.find(mark);
  if (start == std::string::npos) return {"the compiler gives no reason", "shader"};
  const std::size_t from = start + mark.size();
  const std::string line = log.substr(from, log.find('\n', from) - from);
  const std::size_t colon = line.find(": ");
  if (colon == std::string::npos) return {line, "shader"};
  return {line.substr(colon + 2), line.substr(0, colon)};
}

std::size_t uniformBlockBytes(glslang::TProgram& program) {
  if (!program.buildReflection(EShReflectionSeparateBuffers) || program.getNumUniformBlocks() == 0) return 0;
  return static_cast<std::size_t>(program.getUniformBlock(0).size);
}

}  // namespace

Result<CompiledShader> compileShader(ShaderKind kind, std::span<const ShaderText> parts,
                                     std::span<const std::filesystem::path> folders) {
  static const Process kProcess;
  const EShLanguage language = languageOf(kind);
  constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  std::vector<const char*> texts, names;
  std::vector<int> lengths;
  for (const ShaderText& part : parts) {
    texts.push_back(part.text.data());
    names.push_back(part.name.c_str());
    lengths.push_back(static_cast<int>(part.text.size()));
  }
  glslang::TShader shader(language);
  shader.setStringsWithLengthsAndNames(texts.data(), lengths.data(), names.data(), static_cast<int>(texts.size()));
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  FolderIncluder includer(folders);
  if (!shader.parse(GetDefaultResources(), 450, false, kMessages, includer)) return errorOf(shader.getInfoLog());
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) return errorOf(program.getInfoLog());
  CompiledShader compiled;
  glslang::GlslangToSpv(*program.getIntermediate(language), compiled.spirv);
  if (const auto error = validateSpirv(compiled.spirv)) return *error;
  compiled.uniformBlockBytes = uniformBlockBytes(program);
  return compiled;
}

std::optional<Error> validateSpirv(std::span<const std::uint32_t> spirv) {
  std::string message;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) {
    if (message.empty()) message = text;
  });
  if (tools.Validate(spirv.data(), spirv.size())) return {};
  return Error{message, "SPIR-V"};
}

std::filesystem::path shaderLibrary() { return RIGEL_SHADER_LIBRARY; }

}  // namespace rigel::tools
