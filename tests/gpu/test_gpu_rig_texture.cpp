// Lattice rigs in 3-D textures against double. The texture unit rounds coordinates and weights as it likes; here is how
// far, on this device, it is from the lattice.
#include "gpu/rig_twin.h"

#include "reference/worst.h"

namespace rigel::test {
namespace {

using reference::Worst;
using tools::Texture3d;
using tools::TextureFormat;

// Relative to the sum of absolute terms. lavapipe filters in float32; coordinates of 64 nodes are off by 64 x 2^-24 of
// a cell: 5e-6 is the worst measured. Slabs deep in the texture add their own coordinate's rounding.
constexpr double kFiltered = 1.2e-5;

// Every coefficient is off by up to 2^-11 of itself, and never by more of the largest.
constexpr double kHalf = 0x1p-11;

const std::vector<std::string> kLattices = {"lattice:2x2x2",  "lattice:3x2x2", "lattice:3x2x2:smooth", "lattice:8x4x2",
                                            "lattice:64x2x1", "constant",      "lattice:3x2x2@lsq",    "lattice:5x7x6"};

template <int B>
std::vector<double> exactIrradiance(const RigReference& reference, const RigRun<B>& run, std::size_t i, double& sum) {
  const RigReference::Basis phi = reference.at(run.points[i]);
  std::vector<double> exact(3);
  sum = 0;
  for (std::size_t k = 0; k < run.coefficients.size(); ++k)
    for (int j = 0; j < shCount(B); ++j)
      for (int c = 0; c < 3; ++c) {
        const double term = std::numbers::pi * static_cast<double>(run.coefficients[k][j][c]) *
                            static_cast<double>(run.basisOf(i)[j]) * phi.value[k];
        exact[c] += term;
        sum += std::abs(term);
      }
  return exact;
}

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
  Worst worst(std::string("texture, ") + (wantsSh ? "SH, " : "irradiance, ") + std::to_string(B) + " bands");
  const int points = 1 + 100000 / static_cast<int>(kLattices.size() * rigBodies().size());
  for (const std::string& spec : kLattices)
    for (const RigBody& body : rigBodies()) {
      // 4 m over 1 mm: its coordinates across are off by 1e-3 however they are computed (the twins in
      // test_gpu_rig_tensor.cpp say so).
      if (body.name == "thread") continue;
      const Rig rig = rigOn(spec, body, random);
      const RigRun<B> run(spec + " on the " + body.name, rig, randomFrame(random, 100), rig.shVectors(), points,
                          random);
      const GpuTextureSize size = *textureSize(rig, B);
      std::vector<Texel> texels(size.texels());
      const GpuRig packed = packTexture<B>(rig, run.frame, run.coefficients, std::span<Texel>(texels));
      const auto values = floatsOf(texels);
      setUniforms(function, packed);
      function.setTexture(0, must(Texture3d::create(gpu(), {size.width, size.height, size.depth}, format, values)));
      const std::vector<float> results = rigel::test::run(function, run.rows());
      const RigReference reference(rig, run.frame);
      for (std::size_t i = 0; i < run.points.size(); ++i) {
        double sum;
        const std::vector<double> exact = exactIrradiance(reference, run, i, sum);
        for (int c = 0; c < 3; ++c)
          worst.add(TwinCheck::relativeError(results[3 * i + c], exact[c], sum), [&] { return run.describe(i); });
      }
    }
  worst.expectWithin(tolerance);
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
