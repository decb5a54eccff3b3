// What C++ packs is what shaders read: every field of every struct, half floats, the high band.
#include "gpu/rig_twin.h"

#include "reference/worst.h"

#include <rigel/near_light.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace rigel::test {
namespace {

using reference::Worst;

/// `struct_` with bytes that are a different number in each field: floats 1.5, 2.5, ..., ints 1, 2, ... by position.
template <class Struct>
std::vector<float> readBack(const std::string& type, const std::vector<std::string>& fields,
                            const std::vector<int>& integers) {
  std::vector<std::byte> bytes(sizeof(Struct));
  for (std::size_t i = 0; i < sizeof(Struct) / 4; ++i) {
    const bool integer = std::ranges::find(integers, static_cast<int>(i)) != integers.end();
    const auto number = static_cast<float>(i + 1);
    const std::uint32_t word = integer ? static_cast<std::uint32_t>(i + 1) : std::bit_cast<std::uint32_t>(number);
    std::memcpy(&bytes[4 * i], &word, 4);
  }
  tools::ShaderFunctionSource source;
  source.uniforms = "vec4 before; " + type + " value[2];";
  source.inputs = {"float unused_"};
  source.outputs = {"float words[" + std::to_string(sizeof(Struct) / 4) + "]"};
  source.body = "int at = 0;\n";
  for (const std::string& field : fields) source.body += "words[at++] = float(shared_.value[1]." + field + ");\n";
  std::vector<std::byte> block(16 + sizeof(Struct));
  block.insert(block.end(), bytes.begin(), bytes.end());
  auto function = shaderFunction(source);
  function.setUniforms(block);
  return run(function, std::vector<float>{0});
}

/// "name.x", "name.y", ...
std::vector<std::string> components(const std::string& name, const std::string& letters) {
  std::vector<std::string> out;
  for (char letter : letters) out.push_back(name + "." + letter);
  return out;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

void expectCounted(const std::vector<float>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i], static_cast<float>(i + 1)) << "word " << i;
}

TEST(GpuStructs, NearLightIsReadAsItIsWritten) {
  std::vector<std::string> fields = components("position", "xyz");
  append(fields, {"radius"});
  append(fields, components("colour", "xyz"));
  append(fields, {"kind"});
  append(fields, components("axis", "xyz"));
  append(fields, {"inverseRange", "cosOuter", "inverseConeWidth", "extent", "unused"});
  ASSERT_EQ(fields.size(), sizeof(GpuNearLight) / 4);
  expectCounted(readBack<GpuNearLight>("GpuNearLight", fields, {7}));
}

TEST(GpuStructs, WrapIsReadAsItIsWritten) {
  std::vector<std::string> fields = components("f", "xyzw");
  append(fields, {"f4", "a", "inverse", "gain"});
  append(fields, components("blurBand", "xyzw"));
  append(fields, {"blurBand4", "blur", "unused0", "unused1"});
  ASSERT_EQ(fields.size(), sizeof(GpuWrap) / 4);
  expectCounted(readBack<GpuWrap>("GpuWrap", fields, {}));
}

TEST(GpuStructs, RigIsReadAsItIsWritten) {
  std::vector<std::string> fields = components("centre", "xyz");
  append(fields, {"offset"});
  for (const std::string axis : {"axisX", "axisY", "axisZ"}) append(fields, components(axis, "xyzw"));
  append(fields, {"kind", "vectors", "scale", "highBand"});
  append(fields, components("nodes", "xyz"));
  append(fields, {"kernel"});
  append(fields, components("slope", "xyz"));
  append(fields, {"perNode", "highOffset", "gaussOffset", "unused0", "unused1"});
  for (const std::string row : {"falloff[0]", "falloff[1]", "falloff[2]"}) append(fields, components(row, "xyzw"));
  for (const std::string row : {"terms[0]", "terms[1]", "terms[2]", "terms[3]"})
    append(fields, components(row, "xyzw"));
  ASSERT_EQ(fields.size(), sizeof(GpuRig) / 4);
  std::vector<int> integers{3, 16, 17, 19};
  for (int i = 20; i < 32; ++i) integers.push_back(i);
  for (int i = 44; i < 60; ++i) integers.push_back(i);
  expectCounted(readBack<GpuRig>("GpuRig", fields, integers));
}

// A coefficient's own 2^-11, and what the irradiance itself is off in float.
constexpr double kHalf = 0x1p-11 + 2e-6;

TEST(GpuRigPacking, HalfFloatsAddTheirRoundingAndNoMore) {
  Random random(5);
  auto function = shaderFunction(
      rigSource(3, "#define RIGEL_HAS_KIND(rigKind) ((rigKind) == kGpuRigPoly)\n#define RIGEL_POLY_LOOP\n",
                "e = rigel_rigIrradiance(texels, shared_.rig, p, y);"));
  Worst worst("half floats against float32, of the sum of absolute terms");
  for (const RigBody& body : rigBodies()) {
    const Rig rig = rigOn("poly:12", body, random);
    for (const double brightness : {1e-6, 1.0, 3e5, 1e12}) {
      RigRun<3> run(body.name, rig, randomFrame(random, 10), 12, 5200, random);
      for (auto& c : run.coefficients) c = c * static_cast<float>(brightness);
      std::vector<GpuHalf4> buffer(packRigBound(rig, 3));
      setUniforms(function, packRig<3>(rig, run.frame, run.coefficients, {}, {}, std::span<GpuHalf4>(buffer)));
      function.setTexels(floatsOf(buffer));
      const std::vector<float> results = rigel::test::run(function, run.rows());
      const RigReference reference(rig, run.frame);
      for (std::size_t i = 0; i < run.points.size(); ++i) {
        const RigReference::Basis phi = reference.at(run.points[i]);
        for (int c = 0; c < 3; ++c) {
          double exact = 0, sum = 0;
          for (int k = 0; k < 12; ++k)
            for (int j = 0; j < 9; ++j) {
              const double term = std::numbers::pi * static_cast<double>(run.coefficients[k][j][c]) *
                                  static_cast<double>(run.basisOf(i)[j]);
              exact += term * phi.value[k];
              sum += std::abs(term) * phi.absolute[k];
            }
          worst.add(TwinCheck::relativeError(results[3 * i + c], exact, sum), [&] { return run.describe(i); });
        }
      }
    }
  }
  worst.expectWithin(kHalf);
}

template <int B>
void checkHighBand(int band) {
  Random random(7 + band);
  tools::ShaderFunctionSource source;
  source.prelude = "#define RIGEL_BANDS " + std::to_string(B) + "\n#include <rigel/high_band.glsl>\n";
  source.inputs = {"vec3 n"};
  source.outputs = {"vec3 e"};
  source.uniforms = "GpuRig rig; GpuWrap wrap;";
  source.body = "e = rigel_highBandIrradiance(texels, shared_.rig, n, shared_.wrap);";
  source.texels = true;
  struct Block {
    GpuRig rig;
    GpuWrap wrap;
  };
  auto function = shaderFunction(source);
  const RigBody& body = rigBodies().front();
  const Rig rig = rigOn("poly:6", body, random);
  TwinFamilies families("high band " + std::to_string(band) + " beyond " + std::to_string(B));
  for (int set = 0; set < 10; ++set) {
    TwinCheck& check = families["set " + std::to_string(set)];
    HighBand high;
    high.band = band;
    for (int i = 0; i < 2 * band + 1; ++i) high.c[i] = random.colour() * random.uniformf(-3, 3);
    const float a = band == 4 ? 0.0f : random.uniformf(0.1, 0.9);
    const auto coefficients = randomCoefficients<B>(6, 1, random);
    std::vector<GpuVec4> buffer(3 + packRigBound(rig, B));
    const Block block{packRig<B>(rig, {}, coefficients, high, {3, 0, 0}, std::span<GpuVec4>(buffer)), gpuWrap(a)};
    setUniforms(function, block);
    function.setTexels(floatsOf(buffer));
    std::vector<float> rows;
    std::vector<Vec3> normals;
    for (int i = 0; i < 10000; ++i) {
      normals.push_back(random.direction());
      rows.insert(rows.end(), {normals.back().x, normals.back().y, normals.back().z});
    }
    const std::vector<float> results = run(function, rows);
    const auto wrap = wrapCoefficients<kMaxBands>(a);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      float y[25];
      shBasis<5>(normals[i], y);
      for (int c = 0; c < 3; ++c) {
        float twin = 0;
        double exact = 0, sum = 0;
        for (int m = 0; m < 2 * band + 1; ++m) {
          twin += high.c[m][c] * y[band * band + m];
          const double term = std::numbers::pi * static_cast<double>(wrap[band]) * static_cast<double>(high.c[m][c]) *
                              static_cast<double>(y[band * band + m]);
          exact += term;
          sum += std::abs(term);
        }
        check.add(results[3 * i + c], twin * wrap[band] * static_cast<float>(kPi), exact, sum, "a normal");
      }
    }
  }
  families.expectWithinTwice();
}

TEST(GpuRigPacking, HighBandIsTheTwin) {
  checkHighBand<2>(3);
  checkHighBand<3>(3);
  checkHighBand<3>(4);
  checkHighBand<4>(4);
}

}  // namespace
}  // namespace rigel::test
