// Every file of the GLSL library compiles when it is all that a shader includes, for every number of bands and every
// kind of shader; twice and together with all others, in any order; and what comes out is valid SPIR-V.
#include "gpu/gpu_test.h"

#include <algorithm>
#include <filesystem>

namespace rigel::test {
namespace {

using namespace tools;

/// "rigel/sh.glsl" and so on, in alphabetical order.
std::vector<std::string> libraryFiles() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(shaderLibrary() / "rigel")) {
    files.push_back("rigel/" + entry.path().filename().string());
  }
  std::ranges::sort(files);
  return files;
}

std::string errorOf(ShaderKind kind, int bands, const std::vector<std::string>& files) {
  std::string text = "#version 450\n#extension GL_GOOGLE_include_directive : require\n#define RIGEL_BANDS " +
                     std::to_string(bands) + "\n";
  for (const std::string& file : files) text += "#include <" + file + ">\n";
  text += "void main() {}\n";
  const ShaderText part{"shader", text};
  const auto compiled = compileShader(kind, std::span(&part, 1), std::array{shaderLibrary()});
  return compiled ? "" : compiled.error().line();
}

class Bands : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(ShaderLibrary, Bands, ::testing::Range(2, 6));

TEST_P(Bands, EveryFileCompilesAlone) {
  const auto files = libraryFiles();
  ASSERT_GE(files.size(), 15u);
  for (const std::string& file : files) {
    for (const ShaderKind kind : {ShaderKind::vertex, ShaderKind::fragment, ShaderKind::compute}) {
      EXPECT_EQ(errorOf(kind, GetParam(), {file, file}), "") << file;
    }
  }
}

TEST_P(Bands, AllFilesCompileTogether) {
  auto files = libraryFiles();
  EXPECT_EQ(errorOf(ShaderKind::fragment, GetParam(), files), "");
  std::ranges::reverse(files);
  EXPECT_EQ(errorOf(ShaderKind::fragment, GetParam(), files), "");
}

TEST(ShaderLibrary, KnowsTwoToFiveBandsAlone) {
  for (const int bands : {1, 6}) EXPECT_NE(errorOf(ShaderKind::fragment, bands, {"rigel/sh.glsl"}), "");
}

TEST(ShaderLibrary, TheValidatorRefusesWhatIsWrong) {
  const ShaderText part{"shader", "#version 450\nvoid main() {}\n"};
  auto spirv = must(compileShader(ShaderKind::fragment, std::span(&part, 1), {})).spirv;
  EXPECT_FALSE(validateSpirv(spirv));
  spirv.pop_back();
  EXPECT_TRUE(validateSpirv(spirv));
}

}  // namespace
}  // namespace rigel::test
