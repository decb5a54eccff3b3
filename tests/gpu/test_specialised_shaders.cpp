// The file of specialised shaders: whole or not taken.
#include "render/specialised_shaders.h"

#include "gpu/gpu_test.h"
#include "gpu/shader_compiler.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

namespace rigel::test {
namespace {

using namespace tools;
using Words = std::vector<std::uint32_t>;
using Shaders = std::map<std::uint64_t, Words>;

constexpr std::uint32_t kSpirv = 0x07230203;
const Shaders kSome{{0x123456789abcdefu, {kSpirv, 1, 2, 3}}, {7, {kSpirv, 4}}};

TEST(SpecialisedShaders, TakesBackWhatItPacked) {
  EXPECT_EQ(must(unpackShaders(packShaders(kSome))), kSome);
  EXPECT_EQ(must(unpackShaders(packShaders({}))), Shaders{});
}

TEST(SpecialisedShaders, RefusesEveryTruncationAndEveryChangedWord) {
  const Words file = packShaders(kSome);
  for (std::size_t size = 0; size < file.size(); ++size)
    EXPECT_FALSE(unpackShaders(std::span(file).first(size))) << size;
  for (std::size_t i = 0; i < file.size(); ++i) {
    Words damaged = file;
    damaged[i] ^= 0x1000;
    EXPECT_FALSE(unpackShaders(damaged)) << i;
  }
  EXPECT_FALSE(unpackShaders(packShaders({{1, {}}}))) << "no shader at all";
  EXPECT_FALSE(unpackShaders(packShaders({{1, {42, 43}}}))) << "no SPIR-V";
}

TEST(SpecialisedShaders, KeepsThemFromRunToRun) {
  const TemporaryFolder folder;
  const ShaderConstant poly[] = {shaderConstant(12, true)}, sphere[] = {shaderConstant(7, true)};
  Words first;
  {
    SpecialisedShaders shaders(folder / "shaders");
    const auto words = must(shaders.get("object.frag.bands3", poly));
    first.assign(words.begin(), words.end());
    const auto fault = validateSpirv(words);
    EXPECT_FALSE(fault) << fault->line();
    must(shaders.get("object.frag.bands3", sphere));
    must(shaders.get("object.frag.bands3", poly));
    EXPECT_EQ(shaders.made(), 2u);
    must(shaders.save());
  }
  SpecialisedShaders again(folder / "shaders");
  const auto words = must(again.get("object.frag.bands3", poly));
  EXPECT_EQ(Words(words.begin(), words.end()), first);
  EXPECT_EQ(again.made(), 0u);
  must(again.get("object.frag.bands2", poly));
  EXPECT_EQ(again.made(), 1u) << "another shader with the same constants";
}

TEST(SpecialisedShaders, DoesWithoutAFile) {
  const TemporaryFolder folder;
  const ShaderConstant poly[] = {shaderConstant(12, true)};
  SpecialisedShaders none("");
  must(none.get("object.frag.bands3", poly));
  must(none.save());
  writeFile(folder / "shaders", "damaged, and not for a driver");
  SpecialisedShaders damaged(folder / "shaders");
  must(damaged.get("object.frag.bands3", poly));
  EXPECT_EQ(damaged.made(), 1u);
  must(damaged.save());
  EXPECT_EQ(SpecialisedShaders(folder / "shaders").made(), 0u);
  SpecialisedShaders nowhere(folder / "missing" / "shaders");
  must(nowhere.get("object.frag.bands3", poly));
  EXPECT_TRUE(nowhere.save()) << "it says that it cannot";
  EXPECT_FALSE(none.get("object.frag.bands9", poly)) << "no such shader";
}

}  // namespace
}  // namespace rigel::test
