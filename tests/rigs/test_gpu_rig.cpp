// Packing of rigs for shaders.
#include "rig_fixture.h"

#include "gpu/packed_rig.h"

#include <rigel/gpu_rig.h>
#include <rigel/half.h>

#include <bit>

namespace rigel::test {
namespace {

const auto kBody = ellipsoid({0.5f, 1, -2}, {2, 0.4f, 0.8f}, 300);

template <int B>
std::vector<RadianceSH<B>> counted(int vectors) {
  std::vector<RadianceSH<B>> out(vectors);
  float next = 1;
  for (auto& sh : out)
    for (Rgb& c : sh.c)
      for (int i = 0; i < 3; ++i) c[i] = next++;
  return out;
}

template <class Texel>
GpuRig describe(const Rig& rig, const RigFrame& frame = {}) {
  std::vector<Texel> buffer(packRigBound(rig, 3));
  return packRig<3>(rig, frame, {}, {}, {}, std::span<Texel>(buffer));
}

float pi(float x) { return static_cast<float>(kPi * static_cast<double>(x)); }

template <int B>
void checkLayout() {
  const Rig rig = rigOf("poly:4", kBody);
  const auto coefficients = counted<B>(3);  // a prefix
  HighBand high;
  high.band = 4;
  for (int i = 0; i < 9; ++i)
    high.c[i] = {3 * static_cast<float>(i) + 1, 3 * static_cast<float>(i) + 2, 3 * static_cast<float>(i) + 3};
  constexpr int kOffset = 11, kUntouched = 7;
  std::vector<GpuVec4> buffer(kOffset + packRigBound(rig, B, 5) + kUntouched, GpuVec4{-1, -1, -1, -1});
  const GpuRig packed = packRig<B>(rig, {}, coefficients, high, {kOffset, 5, 0}, std::span<GpuVec4>(buffer));
  EXPECT_EQ(packed.offset, kOffset);
  EXPECT_EQ(packed.vectors, 3);
  EXPECT_EQ(packed.scale, 1);
  EXPECT_EQ(packed.highBand, 4);
  EXPECT_EQ(packed.highOffset, kOffset + 5 * gpuVectorSize(B));
  const auto floats = floatsOf(buffer);
  const int width = 4 * gpuVectorSize(B);
  for (int i = 0; i < 4 * kOffset; ++i) EXPECT_EQ(floats[i], -1);
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < width; ++i) {
      const bool held = k < 3 && i < 3 * shCount(B);
      EXPECT_EQ(floats[4 * kOffset + k * width + i], held ? pi(coefficients[k].data()[i]) : 0) << k << ' ' << i;
    }
  for (int i = 0; i < 28; ++i)
    EXPECT_EQ(floats[4 * packed.highOffset + i], i < 27 ? pi(static_cast<float>(i + 1)) : 0) << i;
  for (std::size_t i = buffer.size() - kUntouched; i < buffer.size(); ++i) EXPECT_EQ(buffer[i].x, -1);
}

TEST(GpuRig, CoefficientsAreInterleavedTimesPiPaddedWithZeros) {
  checkLayout<2>();
  checkLayout<3>();
  checkLayout<4>();
  checkLayout<5>();
}

TEST(GpuRig, EveryMonomialIsThatOfTheRig) {
  for (const std::string text : {"poly:1", "poly:6", "poly:56", "invquad:12", "auto:16"}) {
    const Rig rig = rigOf(text, kBody);
    const GpuRig packed = describe<GpuVec4>(rig);
    EXPECT_EQ(packed.kind, text[0] == 'i' ? shader_types::kGpuRigInvquad : shader_types::kGpuRigPoly);
    const Vec3 u{0.9f, -0.7f, 0.6f};
    const Vec3 centre = (rig.box().lo + rig.box().hi) * 0.5f, half = (rig.box().hi - rig.box().lo) * 0.5f;
    RigBasis phi;
    rig.basis(centre + Vec3{half.x * u.x, half.y * u.y, half.z * u.z}, phi);
    ASSERT_EQ(phi.count, rig.shVectors());
    std::vector<float> value{1};
    for (int k = 1; k < rig.shVectors(); ++k) {
      ASSERT_LT(termOf(packed, k) / 4, k);
      value.push_back(value[termOf(packed, k) / 4] * u[termOf(packed, k) % 4]);
      EXPECT_NEAR(value[k], phi.value[k], 1e-5f) << text << " monomial " << k;
    }
  }
}

TEST(GpuRig, FalloffIsThatOfTheFrame) {
  Rig rig = rigOf("invquad:4", kBody);
  EXPECT_EQ(describe<GpuVec4>(rig).falloff[2].y, 1);
  std::vector<float> functionals;
  for (const RigSample& sample : rig.samples()) functionals.push_back(1 / (1 + dot(sample.position, sample.position)));
  rig.adapt(functionals, 1);
  const GpuRig packed = describe<GpuVec4>(rig);
  RigBasis phi;
  rig.basis((rig.box().lo + rig.box().hi) * 0.5f, phi);
  EXPECT_NEAR(1 / packed.falloff[2].y, phi.value[0], 1e-5f);
  EXPECT_NE(packed.falloff[0].x, 0);
}

TEST(GpuRig, TensorRigsSayTheirNodesAndSlopes) {
  const GpuRig mixed = describe<GpuVec4>(rigOf("mixed:l3,g,c", kBody));  // longest along x, then z, then y
  EXPECT_EQ(mixed.kind, shader_types::kGpuRigTensor);
  EXPECT_EQ(mixed.nodes.x, 3);
  EXPECT_EQ(mixed.nodes.y, 1);
  EXPECT_EQ(mixed.nodes.z, 1);
  EXPECT_EQ(mixed.slope.x, 0);
  EXPECT_EQ(mixed.slope.y, 0);
  EXPECT_EQ(mixed.slope.z, 1);
  EXPECT_EQ(mixed.perNode, 2);
  const GpuRig gradient = describe<GpuVec4>(rigOf("gradient@gauss", kBody));
  EXPECT_EQ(gradient.kind, shader_types::kGpuRigGauss);
  EXPECT_EQ(gradient.slope.x, 1);
  EXPECT_EQ(gradient.slope.y, 2);
  EXPECT_EQ(gradient.slope.z, 3);
  EXPECT_EQ(gradient.perNode, 4);
  EXPECT_EQ(describe<GpuVec4>(rigOf("lattice:4x3x2:cubic", kBody)).kernel, shader_types::kGpuCubic);
  EXPECT_EQ(describe<GpuVec4>(rigOf("constant@lsq", kBody)).kind, shader_types::kGpuRigConstant);
}

TEST(GpuRig, GaussNodesAreWhereTheRigIsItsOwnSample) {
  const Rig rig = rigOf("lattice:3x2x2@gauss", kBody);
  std::vector<GpuVec4> nodes(packGaussNodesBound(rig));
  ASSERT_EQ(nodes.size(), 4u);  // along x two pairs, along y and z one
  packGaussNodes(rig, nodes);
  const Vec3 centre = (rig.box().lo + rig.box().hi) * 0.5f, half = (rig.box().hi - rig.box().lo) * 0.5f;
  const float u[] = {nodes[0].x, nodes[0].z, nodes[1].x};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(centre.x + half.x * u[i], rig.samples()[i].position.x, 1e-5f);
  EXPECT_EQ(nodes[1].w, 0);
  EXPECT_NEAR(nodes[2].y * (nodes[2].x - nodes[2].z), 1, 1e-5f);
  EXPECT_EQ(packGaussNodesBound(rigOf("lattice:3x2x2", kBody)), 0);
  EXPECT_EQ(packGaussNodesBound(rigOf("poly:6", kBody)), 0);
}

TEST(GpuRig, HalfFloatsRoundToNearestEven) {
  int counted = 0;
  for (int bits = 0; bits < 0x7c00; ++bits) {
    const float here = floatFromHalf(static_cast<std::uint16_t>(bits));
    const float next = bits == 0x7bff ? 65536.0f : floatFromHalf(static_cast<std::uint16_t>(bits + 1));
    const float middle = 0.5f * here + 0.5f * next;
    EXPECT_EQ(halfFromFloat(here), bits);
    EXPECT_EQ(halfFromFloat(-here), bits | 0x8000);
    EXPECT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), bits);
    EXPECT_EQ(halfFromFloat(middle), bits % 2 == 0 ? bits : bits + 1);
    EXPECT_EQ(halfFromFloat(std::nextafter(middle, 1e9f)), bits + 1);
    ++counted;
  }
  EXPECT_EQ(counted, 0x7c00);
  EXPECT_EQ(halfFromFloat(1e30f), 0x7c00);
  EXPECT_EQ(halfFromFloat(-std::numeric_limits<float>::infinity()), 0xfc00);
  EXPECT_TRUE(std::isnan(floatFromHalf(halfFromFloat(std::nanf("")))));
}

TEST(GpuRig, FloatsFromHalvesAreTheReference) {
  for (int bits = 0; bits < 0x10000; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const float expected = floatFromHalf(half), own = rigel::floatFromHalf(half);
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(own)) << bits;
    } else {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(own), std::bit_cast<std::uint32_t>(expected)) << bits;
    }
  }
}

TEST(GpuRig, HalfFloatsHoldAnyBrightnessToTwoToTheMinus11) {
  const Rig rig = rigOf("poly:2", kBody);
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  double worst = 0;
  for (const float brightness : {1e-20f, 1e-6f, 0.3f, 1.1e5f, 3e30f}) {
    std::vector<RadianceSH<3>> coefficients(2);
    float largest = 0;
    for (auto& sh : coefficients)
      for (Rgb& c : sh.c)
        for (int i = 0; i < 3; ++i) {
          c[i] = brightness * normal(random);
          largest = std::max(largest, std::abs(c[i]));
        }
    std::vector<GpuHalf4> buffer(packRigBound(rig, 3));
    const GpuRig packed = packRig<3>(rig, {}, coefficients, {}, {}, std::span<GpuHalf4>(buffer));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(packed.scale) & 0x7fffff, 0u) << "a power of two";
    const std::vector<float> floats = floatsOf(buffer);
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 27; ++i) {
        const double exact = kPi * static_cast<double>(coefficients[k].data()[i]);
        const double stored = static_cast<double>(floats[k * 28 + i]) * static_cast<double>(packed.scale);
        worst = std::max(worst, std::abs(stored - exact) / std::abs(exact));
      }
  }
  EXPECT_LE(worst, 0x1p-11 * (1 + 1e-3));
  EXPECT_GT(worst, 0x1p-13);
}

TEST(GpuRig, HalfFloatsPassOnWhatIsNoNumberAndHoldNoLight) {
  const Rig rig = rigOf("poly:1", kBody);
  std::vector<RadianceSH<3>> coefficients(1);
  std::vector<GpuHalf4> buffer(packRigBound(rig, 3));
  EXPECT_EQ(packRig<3>(rig, {}, coefficients, {}, {}, std::span<GpuHalf4>(buffer)).scale, 1);
  for (float f : floatsOf(std::span(buffer).first(7))) EXPECT_EQ(f, 0);
  coefficients[0][0] = {std::nanf(""), std::numeric_limits<float>::infinity(), 2};
  const GpuRig packed = packRig<3>(rig, {}, coefficients, {}, {}, std::span<GpuHalf4>(buffer));
  const std::vector<float> floats = floatsOf(buffer);
  EXPECT_TRUE(std::isnan(floats[0]));
  EXPECT_TRUE(std::isinf(floats[1]));
  EXPECT_NEAR(floats[2] * packed.scale, 2 * kPi, 2 * kPi * 0x1p-11);
}

TEST(GpuRig, TexturesAreSlabsOfNodesByDecreasingNumber) {
  const Rig rig = rigOf("mixed:xyz:l2,l5,l3", kBody);
  const GpuTextureSize size = *textureSize(rig, 3);
  EXPECT_EQ(size.width, 5);
  EXPECT_EQ(size.height, 3);
  EXPECT_EQ(size.depth, 2 * 7);
  const auto coefficients = counted<3>(30);
  std::vector<GpuVec4> texels(size.texels());
  const GpuRig packed = packTexture<3>(rig, {}, coefficients, std::span<GpuVec4>(texels));
  EXPECT_EQ(packed.kind, shader_types::kGpuRigTexture);
  EXPECT_EQ(packed.nodes.x, 5);
  EXPECT_EQ(packed.nodes.y, 3);
  EXPECT_EQ(packed.nodes.z, 2);
  EXPECT_GT(packed.axisX.y, 2);  // y is the texture's first axis, its half extent 0.4
  const auto floats = floatsOf(texels);
  for (int i = 0; i < 27; ++i)
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 5; ++y)
        for (int z = 0; z < 3; ++z) {
          const int texel = ((i / 4 * 2 + x) * 3 + z) * 5 + y;
          EXPECT_EQ(floats[4 * texel + i % 4], pi(coefficients[x + 2 * (y + 5 * z)].data()[i]));
        }
}

TEST(GpuRig, HighBandsOfTexturesLieInTheBufferOverTheirScale) {
  HighBand band;
  band.band = 4;
  for (int m = 0; m < 9; ++m) {
    const auto x = static_cast<float>(m);
    band.c[m] = {x + 0.25f, -x - 1, 2 * x};
  }
  GpuRig packed{};
  packed.scale = 8;
  constexpr int kOffset = 3;
  std::vector<GpuVec4> buffer(kOffset + packHighBandBound());
  packHighBand(band, kOffset, buffer, packed);
  EXPECT_EQ(packed.highBand, 4);
  EXPECT_EQ(packed.highOffset, kOffset);
  const auto floats = floatsOf(buffer);
  for (int i = 0; i < 27; ++i) EXPECT_EQ(8 * floats[4 * kOffset + i], pi((&band.c[0].r)[i])) << i;
  packHighBand({}, kOffset, buffer, packed);
  EXPECT_EQ(packed.highBand, 0);
}

TEST(GpuRig, OnlyPlainLatticesAreTextures) {
  for (const std::string text : {"gradient", "mixed:l3,g,c", "lattice:4x3x2:cubic", "lattice:3x2x2@gauss", "poly:6"})
    EXPECT_FALSE(textureSize(rigOf(text, kBody), 3)) << text;
  for (const std::string text : {"constant", "lattice:8x4x2", "lattice:3x2x2:smooth", "lattice:3x2x2@lsq"})
    EXPECT_TRUE(textureSize(rigOf(text, kBody), 3)) << text;
}

TEST(GpuRig, ModelsWithoutShadersAreRefusedByName) {
  int refused = 0;
  for (const std::string& text : everyKindOfSpec()) {
    const auto error = checkGpuRig(specOf(text));
    const bool dropped = text.starts_with("rbf") || text.starts_with("latticegrad") || text.starts_with("hermite");
    EXPECT_EQ(error.has_value(), dropped) << text;
    if (!error) continue;
    ++refused;
    EXPECT_NE(error->line().find("rig '" + text + "': "), std::string::npos) << error->line();
    EXPECT_FALSE(textureSize(rigOf(text, kBody), 3)) << text;
    EXPECT_EQ(packGaussNodesBound(rigOf(text, kBody)), 0) << text;
  }
  EXPECT_GE(refused, 3);
}

TEST(GpuRig, FlatBoxesHaveNoCoordinateAcross) {
  const GpuRig packed = describe<GpuVec4>(rigOf("poly:4", ellipsoid({1, 2, 3}, {1, 0, 2}, 300)));
  EXPECT_EQ(packed.axisY.x, 0);
  EXPECT_EQ(packed.axisY.y, 0);
  EXPECT_EQ(packed.axisY.z, 0);
  EXPECT_EQ(packed.axisY.w, 0);
  EXPECT_NEAR(packed.axisX.x, 1, 1e-2f);
}

}  // namespace
}  // namespace rigel::test
