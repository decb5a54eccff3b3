// The harness itself: what goes in comes out, and what is wrong is said with its place.
#include "gpu/gpu_test.h"
#include "gpu/twin.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace rigel::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tools::ShaderFunction;
using tools::ShaderFunctionSource;

ShaderFunctionSource sourceOf(std::vector<std::string> inputs, std::vector<std::string> outputs, std::string body) {
  ShaderFunctionSource source;
  source.inputs = std::move(inputs);
  source.outputs = std::move(outputs);
  source.body = std::move(body);
  return source;
}

/// The error of a source that must not compile.
Error errorOf(const ShaderFunctionSource& source) {
  const auto function = ShaderFunction::create(gpu(), source);
  return function ? Error{"compiled", "nowhere"} : function.error();
}

std::vector<float> counted(std::size_t n) {
  std::vector<float> values(n);
  std::iota(values.begin(), values.end(), 1.0f);
  return values;
}

TEST(ShaderFunction, PassesEveryTypeThrough) {
  const auto source =
      sourceOf({"float a", "int k", "vec2 p", "vec3 n", "vec4 c"},
               {"vec4 c2", "vec3 n2", "vec2 p2", "int k2", "float a2"}, "c2 = c; n2 = n; p2 = p; k2 = k; a2 = a;");
  EXPECT_THAT(evaluate(source, counted(22)), ElementsAre(8, 9, 10, 11, 5, 6, 7, 3, 4, 2, 1,  //
                                                         19, 20, 21, 22, 16, 17, 18, 14, 15, 13, 12));
}

TEST(ShaderFunction, PassesArraysThrough) {
  const auto source = sourceOf({"float w[3]", "vec2 p[2]", "int k[2]"}, {"int i[2]", "vec2 q[2]", "float v[3]"},
                               "for (int j = 0; j < 2; ++j) { i[j] = k[1 - j]; q[j] = p[j].yx; }\nv = w;");
  EXPECT_THAT(evaluate(source, counted(9)), ElementsAre(9, 8, 5, 4, 7, 6, 1, 2, 3));
}

TEST(ShaderFunction, KeepsIntegersToTheirSign) {
  EXPECT_THAT(evaluate(sourceOf({"int k"}, {"int half_", "int bits"}, "half_ = k / 2; bits = k & 7;"),
                       std::vector<float>{-7, 16777215}),
              ElementsAre(-3, 1, 8388607, 7));
}

TEST(ShaderFunction, ReadsUniformsTexelsAndTextures) {
  auto source = sourceOf({"int i", "vec3 uvw"}, {"float sum", "vec4 c"},
                         "sum = shared_.scale * texelFetch(texels, i).z + shared_.row[i].w;\n"
                         "c = textureLod(textures[1], uvw, 0.0) - textureLod(textures[0], uvw, 0.0);");
  source.uniforms = "float scale;\nvec4 row[2];";
  source.texels = true;
  source.textures = 2;
  ShaderFunction function = shaderFunction(source);

  const std::vector<float> block = {10, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  function.setUniforms(std::as_bytes(std::span(block)));
  function.setTexels(counted(8));
  // The first texture is zero; the second goes from 0 to 4 along x.
  const auto zero = tools::Texture3d::create(gpu(), {2, 2, 2}, tools::TextureFormat::rgba16f, std::vector<float>(32));
  std::vector<float> ramp(2 * 4, 0.0f);
  std::fill(ramp.begin() + 4, ramp.end(), 4.0f);
  const auto along = tools::Texture3d::create(gpu(), {2, 1, 1}, tools::TextureFormat::rgba32f, ramp);
  ASSERT_TRUE(zero && along);
  function.setTexture(0, *zero);
  function.setTexture(1, *along);
  const std::vector<float> rows = {0, 0.5f, 0.5f, 0.5f, 1, 0.375f, 0.5f, 0.5f};
  EXPECT_THAT(run(function, rows), ElementsAre(34, 2, 2, 2, 2, 78, 1, 1, 1, 1));

  // Set anew, they are read anew.
  function.setTexels(std::vector<float>(8, 1.0f));
  EXPECT_THAT(run(function, rows), ElementsAre(14, 2, 2, 2, 2, 18, 1, 1, 1, 1));
}

TEST(ShaderFunction, SeesSharedHeadersTypesAndFolders) {
  const TemporaryFolder folder;
  writeFile(folder / "own.glsl", "float twice(float x) { return 2.0 * x; }\n");
  auto source = sourceOf({"float x"}, {"float y"}, "y = twice(x) + shared_.pair.b + shared_.light.radius;");
  source.types = "struct Pair { float a, b; };";
  source.uniforms = "Pair pair; GpuNearLight light;";
  source.prelude = "#include <own.glsl>\n#include <rigel/shader_constants.h>\n";
  source.folders = {folder.path()};
  ShaderFunction function = shaderFunction(source);
  std::vector<float> block(4 + 16);
  block[1] = 5;
  block[4 + 3] = 7;
  function.setUniforms(std::as_bytes(std::span(block)));
  EXPECT_THAT(run(function, std::vector<float>{100}), ElementsAre(212));
}

TEST(ShaderFunction, PassesNanAndInfinityThrough) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values = {
      infinity, -infinity, nan, -0.0f, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()};
  const auto results = evaluate(sourceOf({"float x"}, {"float y"}, "y = x;"), values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(results[i]), std::bit_cast<std::uint32_t>(values[i])) << values[i];
  }
}

TEST(ShaderFunction, LeavesWhatTheBodyForgetsUnset) {
  const auto results = evaluate(sourceOf({"float x"}, {"float y", "int k", "vec2 v"}, "if (x < 0.0) return; y = x;"),
                                std::vector<float>{-1, 3});
  EXPECT_TRUE(std::isnan(results[0]));
  EXPECT_EQ(results[1], std::numeric_limits<int>::min());
  EXPECT_EQ(results[4], 3);
  EXPECT_TRUE(std::isnan(results[7]));
}

TEST(ShaderFunction, TakesAnyNumberOfRows) {
  ShaderFunction function =
      shaderFunction(sourceOf({"vec3 a"}, {"float sum", "int row"}, "sum = a.x + a.y + a.z; row = int(a.x);"));
  EXPECT_TRUE(run(function, {}).empty());
  for (const std::size_t rows : {1u, 63u, 64u, 65u, 1'000'003u}) {
    std::vector<float> input;
    for (std::size_t i = 0; i < rows; ++i) input.insert(input.end(), {static_cast<float>(i), 1, 2});
    const std::vector<float> output = run(function, input);
    ASSERT_EQ(output.size(), 2 * rows);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      const auto x = static_cast<float>(i);
      wrong += output[2 * i] != x + 3 || output[2 * i + 1] != x ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0) << rows;
  }
}

TEST(ShaderFunctionErrors, NameTheLineOfThePartAtFault) {
  auto source = sourceOf({"float x"}, {"float y"}, "float a = x;\ny = a + undeclared;");
  EXPECT_EQ(errorOf(source).place, "body:2");
  EXPECT_THAT(errorOf(source).message, HasSubstr("'undeclared' : undeclared identifier"));

  source.body = "y = helper(x);";
  source.prelude = "#include <rigel/shader_types.h>\n\nfloat helper(float v) { return v +; }\n";
  EXPECT_EQ(errorOf(source).place, "prelude:3");

  source.prelude = "float helper(float v) { return v; }";
  source.uniforms = "float fine;\nMystery m;";
  EXPECT_EQ(errorOf(source).place, "uniforms:2");

  source.uniforms = "";
  source.types = "struct S {\n  float;\n};";
  EXPECT_EQ(errorOf(source).place, "types:2");
}

TEST(ShaderFunctionErrors, NameTheIncludedFileAndItsLine) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "my");
  writeFile(folder / "my" / "outer.glsl", "#include <my/inner.glsl>\nfloat outer(float x) { return inner(x); }\n");
  writeFile(folder / "my" / "inner.glsl", "float inner(float x) {\n  return x\n}\n");
  auto source = sourceOf({"float x"}, {"float y"}, "y = outer(x);");
  source.prelude = "#include <my/outer.glsl>\n";
  source.folders = {folder.path()};
  EXPECT_EQ(errorOf(source).place, "my/inner.glsl:3");

  writeFile(folder / "my" / "inner.glsl", "float inner(float x) { return x; }\n");
  source.body = "y = outer(x);\ny = none;";
  EXPECT_EQ(errorOf(source).place, "body:2") << "after two includes";

  source.prelude = "\n#include <my/nowhere.glsl>\n";
  EXPECT_EQ(errorOf(source).place, "prelude:2");
  EXPECT_THAT(errorOf(source).message, HasSubstr("my/nowhere.glsl"));

  writeFile(folder / "my" / "nowhere.glsl", "#include <my/nowhere.glsl>\n");
  EXPECT_THAT(errorOf(source).message, HasSubstr("my/nowhere.glsl")) << "a file that includes itself";
}

TEST(ShaderFunctionErrors, QuoteWhatIsNoDeclaration) {
  for (const char* wrong : {"mat3 m", "float", "float 2x", "float a[0]", "float a[n]", "vec3 a, b", ""}) {
    const Error error = errorOf(sourceOf({wrong}, {"float y"}, ""));
    EXPECT_EQ(error.place, "\"" + std::string(wrong) + "\"");
  }
  EXPECT_THAT(errorOf(sourceOf({}, {"float y"}, "")).message, HasSubstr("needs an input"));
  EXPECT_THAT(errorOf(sourceOf({"float x"}, {}, "")).message, HasSubstr("needs an input"));
}

TEST(ShaderFunctionErrors, NameWhatIsNotSet) {
  auto source = sourceOf({"float x"}, {"float y"},
                         "y = shared_.s + texelFetch(texels, 0).x + textureLod(textures[0], vec3(x), 0.0).x;");
  source.uniforms = "float s;";
  source.texels = true;
  source.textures = 1;
  ShaderFunction function = shaderFunction(source);
  const std::vector<float> row = {1};
  const std::array<float, 4> zero{};
  EXPECT_EQ(function(row).error().line(), "uniforms: the block has 4 bytes, 0 are set");
  function.setUniforms(std::as_bytes(std::span(zero)));
  EXPECT_EQ(function(row).error().line(), "texels: none are set");
  function.setTexels(zero);
  EXPECT_EQ(function(row).error().line(), "textures[0]: is not set");
  ShaderFunction pairs = shaderFunction(sourceOf({"vec2 p"}, {"float y"}, "y = p.x;"));
  EXPECT_THAT(pairs(std::vector<float>{1, 2, 3}).error().message, HasSubstr("no whole number of rows"));
}

TEST(TwinCheck, AllowsTwiceTheTwinsErrorAndNoMore) {
  TwinCheck fine("fine");
  fine.add(1.001f, 1.0006f, 1, 1, "x");
  fine.expectWithinTwice();
  TwinCheck worse("worse");
  worse.add(1.002f, 1.0006f, 1, 1, [] { return "x = 3"; });
  EXPECT_NONFATAL_FAILURE(worse.expectWithinTwice(), "x = 3");
  const TwinCheck empty("empty");
  EXPECT_NONFATAL_FAILURE(empty.expectWithinTwice(), "nothing was compared");
  TwinCheck nan("nan");
  nan.add(std::nanf(""), 1, 1, 1, "x");
  EXPECT_NONFATAL_FAILURE(nan.expectWithinTwice(), "shader: nan");
}

TEST(TwinFamilies, ALargeErrorOfTheTwinHidesNoShaderInAnotherFamily) {
  TwinFamilies families("function");
  families["hard"].add(1.001f, 1.1f, 1, 1, "x = 1");
  families["easy"].add(1.00001f, 1.00001f, 1, 1, "x = 2");
  families.expectWithinTwice();
  EXPECT_NEAR(families.gpuError(), 1e-3, 1e-6);
  families["easy"].add(1.001f, 1.00001f, 1, 1, "x = 3");
  EXPECT_NONFATAL_FAILURE(families.expectWithinTwice(), "function, easy\n  shader: 1.00100005");
  families["easy"].add(1, 1.01f, 1, 1, "x = 4");
  families["never"];
  EXPECT_NONFATAL_FAILURE(families.expectWithinTwice(), "function, never: nothing was compared");
  const TwinFamilies empty("empty");
  EXPECT_NONFATAL_FAILURE(empty.expectWithinTwice(), "nothing was compared");
}

TEST(TwinCheck, MeasuresErrorsRelativeToTheTerms) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(TwinCheck::relativeError(1.5f, 1, 4), 0.125);
  EXPECT_EQ(TwinCheck::relativeError(0, 0, 0), 0);
  EXPECT_EQ(TwinCheck::relativeError(1e-30f, 0, 0), infinity);
  EXPECT_EQ(TwinCheck::relativeError(static_cast<float>(infinity), infinity, infinity), 0);
  EXPECT_EQ(TwinCheck::relativeError(3, infinity, infinity), infinity);
  EXPECT_EQ(TwinCheck::relativeError(std::nanf(""), std::nan(""), 1), 0);
  EXPECT_EQ(TwinCheck::relativeError(3, std::nan(""), 1), infinity);
}

}  // namespace
}  // namespace rigel::test
