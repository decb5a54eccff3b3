// Lattice rigs in 3-D textures against double, beside a texture unit in C++: what is lost, coordinates being fractions
// of the whole texture, a texture unit loses anywhere. kFiltered says how much of the lattice that is.
#include "gpu/rig_twin.h"
#include "gpu/texture_twin.h"

namespace rigel::test {
namespace {

using tools::Texture3d;
using tools::TextureFormat;

// Of the sum of absolute terms. lavapipe filters in float32, at coordinates that are rounded as fractions of a whole
// texture: six nodes in seven slabs lose five bits, 2.5e-6 is the worst measured. Shallow ones are within 8e-7.
constexpr double kFiltered = 4e-6;

// Every coefficient is off by up to 2^-11 of itself, and never by more of the largest.
constexpr double kHalf = 0x1p-11;

const std::vector<std::string> kLattices = {"lattice:2x2x2",  "lattice:3x2x2", "lattice:3x2x2:smooth", "lattice:8x4x2",
                                            "lattice:64x2x1", "constant",      "lattice:3x2x2@lsq",    "lattice:5x7x6"};

template <int B, class Texel>
void checkTextures(TextureFormat format, double tolerance, bool wantsSh) {
  Random random(11 + B);
  auto source = rigSource(B, "",
                          wantsSh ? "vec3 sh[RIGEL_SH_COUNT]; rigel_textureSh(textures[0], shared_.rig, p, sh);\n"
                                    "e = vec3(0.0); for (int i = 0; i < RIGEL_SH_COUNT; ++i) e += sh[i] * y[i];"
                                  : "e = rigel_textureIrradiance(textures[0], shared_.rig, p, y);");
  source.texels = false;
  source.textures = 1;
  auto function = shaderFunction(source);
  TwinFamilies families(std::string("texture, ") + (wantsSh ? "SH, " : "irradiance, ") + std::to_string(B) + " bands");
  const int points = 1 + 100000 / static_cast<int>(kLattices.size() * rigBodies().size());
  for (const std::string& spec : kLattices)
    for (const RigBody& body : rigBodies()) {
      const Rig rig = rigOn(spec, body, random);
      const RigRun<B> run(spec + " on the " + body.name, rig, randomFrame(random, 100), rig.shVectors(), points,
                          random);
      const GpuTextureSize size = *textureSize(rig, B);
      std::vector<Texel> texels(size.texels());
      const GpuRig packed = packTexture<B>(rig, run.frame, run.coefficients, std::span<Texel>(texels));
      const auto values = floatsOf(texels);
      setUniforms(function, packed);
      function.setTexture(0, must(Texture3d::create(gpu(), {size.width, size.height, size.depth}, format, values)));
      run.checkIrradiance(rigel::test::run(function, run.rows()), families[run.name], nullptr,
                          TextureTwin<B>(packed, size, values));
    }
  families.expectWithinTwice();
  EXPECT_LE(families.gpuError(), tolerance);
}

TEST(GpuRigTexture, InFloatIsTheLattice) {
  checkTextures<2, GpuVec4>(TextureFormat::rgba32f, kFiltered, false);
  checkTextures<3, GpuVec4>(TextureFormat::rgba32f, kFiltered, false);
  checkTextures<4, GpuVec4>(TextureFormat::rgba32f, kFiltered, false);
  checkTextures<5, GpuVec4>(TextureFormat::rgba32f, kFiltered, false);
}
TEST(GpuRigTexture, InHalfFloatsIsTheLatticeToTheirRounding) {
  checkTextures<3, GpuHalf4>(TextureFormat::rgba16f, kHalf + kFiltered, false);
  checkTextures<5, GpuHalf4>(TextureFormat::rgba16f, kHalf + kFiltered, false);
}
TEST(GpuRigTexture, ShIsTheLattice) { checkTextures<3, GpuVec4>(TextureFormat::rgba32f, kFiltered, true); }

}  // namespace
}  // namespace rigel::test
