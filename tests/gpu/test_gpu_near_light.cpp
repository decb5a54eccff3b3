// Near lights on the GPU and in C++, against exact irradiance in double. Errors are relative to the light's peak over
// normals, and for a spot's cone to the terms of its argument.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/near_light.h>
#include <rigel/project.h>

#include <array>
#include <cstring>
#include <functional>
#include <limits>

#include "gpu/gpu_test.h"
#include "gpu/near_rows.h"
#include "gpu/twin.h"
#include "lights/describe.h"
#include "lights/lights_for_reference.h"

namespace rigel::test {
namespace {

constexpr int kCases = 100'000;

/// One light seen from one point, and what is known of it in double.
struct Case {
  NearLight light;
  Vec3 p, n;
  double exact = 0;
  double terms = 0;
  std::function<std::string()> describe;
};

double peakOf(const SphereLight& light, Vec3 p, float wrap) {
  return exactIrradiance(light, p, light.position - p, wrap).r;
}
double peakOf(const PointLight& light, Vec3 p, float wrap) {
  return exactIrradiance(PointLight{light.position, light.intensity, light.radius}, p, light.position - p, wrap).r;
}
/// The cone's argument is a difference of cosines over its width.
double peakOf(const SpotLight& light, Vec3 p, float wrap) {
  const double outer = std::cos(static_cast<double>(light.outerAngle));
  const double width = std::max<double>(kMinConeWidth, std::cos(static_cast<double>(light.innerAngle)) - outer);
  return peakOf(PointLight{light.position, light.intensity, light.radius}, p, wrap) *
         (1 + 1.5 * (1 + std::abs(outer)) / width);
}
double peakOf(const DirectionalLight& light, Vec3, float) { return static_cast<double>(light.irradiance.r); }

template <class Light>
Case caseOf(const Light& light, Vec3 p, Vec3 n, float wrap) {
  return {nearLight(light), p, n, exactIrradiance(light, p, n, wrap).r, peakOf(light, p, wrap), [=] {
            return describe(light) + ", p " + describe(p) + ", n " + describe(n) + ", wrap " + describe(wrap);
          }};
}

Vec3 unit(Vec3 v) { return v * (1 / length(v)); }

/// A normal that makes about `angle` with the direction from receiver to light.
Vec3 normalAt(Random& random, const Placement& at, double angle) {
  const Vec3 w = (at.centre - at.receiver) * static_cast<float>(1 / at.distance);
  const Vec3 side = unit(cross(w, random.direction()));
  return unit(w * static_cast<float>(std::cos(angle)) + side * static_cast<float>(std::sin(angle)));
}

/// Half of the normals any, half such that the light crosses the kernel's horizon.
Case hardSphere(Random& random, double distance, float wrap) {
  const Placement at = place(random, distance);
  const SphereLight light = sphereAt(at, hardRatio(random));
  const double alpha = std::asin(std::min(1.0, static_cast<double>(light.radius) / at.distance));
  const double crossing = std::acos(-static_cast<double>(wrap)) + alpha * random.uniform(-1.05, 1.05);
  const double angle = random.index(2) == 0 ? random.uniform(0, M_PI) : std::clamp(crossing, 0.0, M_PI);
  return caseOf(light, at.receiver, normalAt(random, at, angle), wrap);
}

tools::ShaderFunction shader(const std::string& call, const std::string& defines = "") {
  tools::ShaderFunctionSource source;
  source.prelude = defines + "#include <rigel/near_light.glsl>\n";
  source.inputs = kNearInputs;
  source.outputs = {"vec3 e"};
  source.body = kNearBody + "e = " + call + ";";
  return shaderFunction(source);
}

tools::ShaderFunction nearShader() { return shader("rigel_nearIrradiance(light, p, n, wrap)"); }
tools::ShaderFunction cheapShader() { return shader("rigel_cheapIrradiance(light, p, n)"); }
tools::ShaderFunction correctorShader() { return shader("rigel_correctorIrradiance(light, p, n, wrap)"); }

using Twin = std::function<Rgb(const Case&, const NearWrap&)>;
Rgb nearTwin(const Case& c, const NearWrap& wrap) { return nearIrradiance(c.light, c.p, c.n, wrap); }
Rgb cheapTwin(const Case& c, const NearWrap&) { return cheapIrradiance(c.light, c.p, c.n); }
Rgb correctorTwin(const Case& c, const NearWrap& wrap) { return correctorIrradiance(c.light, c.p, c.n, wrap); }

/// How the receiver sees the light: its size, and whether the kernel's horizon crosses it.
std::string familyOf(const Case& c, float wrap) {
  const auto wide = [](Vec3 v) {
    return std::array{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  };
  const auto light = wide(c.light.position), p = wide(c.p), n = wide(c.n);
  const bool directional = c.light.kind == NearLight::Kind::directional;
  double square = 0, cosine = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = directional ? light[i] : light[i] - p[i];
    square += d * d;
    cosine += d * n[i];
  }
  const double distance = std::sqrt(square), ratio = directional ? 0 : static_cast<double>(c.light.radius) / distance;
  const double height =
      std::asin(std::clamp(cosine / distance, -1.0, 1.0)) + std::asin(std::min(1.0, static_cast<double>(wrap)));
  const double size = std::asin(std::min(1.0, ratio));
  const std::string place = std::abs(ratio - 1) < 1e-3 ? "touching"
                            : ratio > 1                ? "inside"
                            : ratio > 0.1              ? "near"
                            : ratio > 1e-3             ? "small"
                                                       : "tiny";
  return place + (height > size ? ", above" : height > -size ? ", across" : ", below") + " the horizon";
}

/// Shader and twin over `cases`, both against the truth; and against each other, which is the stricter where the form
/// approximates: `agreement` of the peak.
void compare(const std::string& name, tools::ShaderFunction function, const Twin& twin, const std::vector<Case>& cases,
             const NearWrap& wrap, double agreement) {
  std::vector<float> rows;
  for (const Case& c : cases) {
    append(rows, gpuNearLight(c.light));
    append(rows, wrap);
    append(rows, c.p);
    append(rows, c.n);
  }
  const std::vector<float> results = run(function, rows);
  ASSERT_EQ(results.size(), 3 * cases.size());
  TwinFamilies families(name);
  double worstDifference = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const float expected = twin(c, wrap).r;
    families[familyOf(c, wrap.a)].add(results[3 * i], expected, c.exact, c.terms, c.describe);
    const double difference = std::abs(static_cast<double>(results[3 * i]) - static_cast<double>(expected)) / c.terms;
    if (!(difference <= worstDifference)) {
      worstDifference = difference;
      EXPECT_LE(difference, agreement) << name << ": shader " << results[3 * i] << ", C++ " << expected << " at "
                                       << c.describe();
      if (difference > agreement) return;
    }
  }
  families.expectWithinTwice();
  std::printf("  shader and C++ differ by %.2g\n", worstDifference);
}

template <class Make>
std::vector<Case> manyCases(int count, const Make& make) {
  std::vector<Case> cases;
  cases.reserve(count);
  for (int k = 0; k < count; ++k) cases.push_back(make());
  return cases;
}

// Two roundings of n.w, of d and of the light's colour apart: worst measured 7e-7.
constexpr double kAgreement = 1.5e-6;
// For a < 0 the kernel meets the horizon vertically, so that the rounding of n.w counts for more: 1.7e-6.
constexpr double kSteepAgreement = 4e-6;

TEST(GpuNearLight, StructsReadBack) {
  struct Block {
    GpuNearLight light;
    GpuWrap wrap;
  } block;
  block.light = {{1, 2, 3}, 4, {5, 6, 7}, 8, {9, 10, 11}, 12, 13, 14, 15, 16};
  block.wrap = {{17, 18, 19, 20}, 21, 22, 23, 24, {25, 26, 27, 28}, 29, 30, 31, 32};
  tools::ShaderFunctionSource source;
  source.uniforms = "GpuNearLight light; GpuWrap wrap;";
  source.inputs = {"float unused"};
  source.outputs = {"float v[32]"};
  source.body =
      "GpuNearLight l = shared_.light; GpuWrap w = shared_.wrap;\n"
      "v = float[32](l.position.x, l.position.y, l.position.z, l.radius, l.colour.x, l.colour.y, l.colour.z,\n"
      "  float(l.kind), l.axis.x, l.axis.y, l.axis.z, l.inverseRange, l.cosOuter, l.inverseConeWidth, l.extent,\n"
      "  l.unused, w.f.x, w.f.y, w.f.z, w.f.w, w.f4, w.a, w.inverse, w.gain, w.blurBand.x, w.blurBand.y,\n"
      "  w.blurBand.z, w.blurBand.w, w.blurBand4, w.blur, w.unused0, w.unused1);";
  tools::ShaderFunction function = shaderFunction(source);
  function.setUniforms(std::as_bytes(std::span(&block, 1)));
  const std::vector<float> values = run(function, std::vector<float>{0});
  ASSERT_EQ(values.size(), 32u);
  for (int i = 0; i < 32; ++i) EXPECT_EQ(values[i], static_cast<float>(i + 1));
}

TEST(GpuNearLight, LambertAnywhere) {
  Random random(401);
  compare("near Lambert, any r/d, inside and touching", nearShader(), nearTwin,
          manyCases(kCases, [&] { return hardSphere(random, random.logUniform(1e-6, 1e6), 0); }), nearWrap(),
          kAgreement);
}

TEST(GpuNearLight, LambertTouchingToTheLastBit) {
  Random random(402);
  compare("near Lambert, touching", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      const Placement at = place(random, random.logUniform(1e-3, 1e3));
                      SphereLight light = sphereAt(at, 1);
                      const float towards = random.index(2) == 0 ? 1e9f : 0.0f;
                      for (int step = random.index(4); step > 0; --step)
                        light.radius = std::nextafter(light.radius, towards);
                      return caseOf(light, at.receiver, random.direction(), 0);
                    }),
          nearWrap(), kAgreement);
}

TEST(GpuNearLight, LambertNearlyTouching) {
  // Around the distance where the shader turns to pairs of floats, and down from there.
  Random random(403);
  compare("near Lambert, |1 - r/d| 1e-8 to 0.3", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      const Placement at = place(random, random.logUniform(1e-3, 1e3));
                      const double gap = random.logUniform(1e-8, 0.3);
                      const SphereLight light = sphereAt(at, random.index(2) == 0 ? 1 - gap : 1 + gap);
                      return caseOf(light, at.receiver, normalAt(random, at, random.uniform(0, M_PI)), 0);
                    }),
          nearWrap(), kAgreement);
}

TEST(GpuNearLight, LambertAtTheScalesOfFloat) {
  Random random(404);
  compare("near Lambert, distances 1e-15 to 1e15", nearShader(), nearTwin,
          manyCases(kCases, [&] { return hardSphere(random, random.logUniform(1e-15, 1e15), 0); }), nearWrap(),
          kAgreement);
}

TEST(GpuNearLight, LambertFarFromTheOrigin) {
  Random random(405);
  compare("near Lambert, 1 m apart and 1 to 100 km from the origin", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      const Vec3 p = random.direction() * static_cast<float>(random.logUniform(1e3, 1e5));
                      const SphereLight light{p + random.direction(), random.uniformf(0.1, 1.2), {1, 1, 1}};
                      return caseOf(light, p, random.direction(), 0);
                    }),
          nearWrap(), kAgreement);
}

TEST(GpuNearLight, Wrap) {
  for (const float wrap : {-0.25f, -0.05f, 0.3f, 0.8f}) {
    Random random(406);
    compare("near wrap " + describe(wrap), nearShader(), nearTwin,
            manyCases(kCases / 4, [&] { return hardSphere(random, random.logUniform(1e-3, 1e3), wrap); }),
            nearWrap(wrap), wrap < 0 ? kSteepAgreement : kAgreement);
  }
}

TEST(GpuNearLight, HalfLambert) {
  Random random(407);
  compare("near half-Lambert", nearShader(), nearTwin,
          manyCases(kCases, [&] { return hardSphere(random, random.logUniform(1e-6, 1e6), 1); }), nearWrap(1),
          kAgreement);
}

TEST(GpuNearLight, EnergyNormalisedWrap) {
  Random random(408);
  const float gain = wrapEnergy(1);
  compare("near half-Lambert, energy normalised", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      Case c = hardSphere(random, 3, 1);
                      c.exact *= 3.0 / 4;
                      c.terms *= 3.0 / 4;
                      return c;
                    }),
          gpuWrap(1, gain), kAgreement);
}

TEST(GpuNearLight, PointWithRange) {
  Random random(409);
  compare("near point light with range", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      const Placement at = place(random, random.logUniform(0.01, 100));
                      return caseOf(pointAt(random, at, random.logUniform(1e-4, 1.5)), at.receiver, random.direction(),
                                    0);
                    }),
          nearWrap(), kAgreement);
}

TEST(GpuNearLight, PointOfNoSize) {
  Random random(410);
  compare("near point light of no size, any distance", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      const Placement at = place(random, random.logUniform(1e-8, 1e8));
                      return caseOf(PointLight{at.centre, {1, 1, 1}, 0, kNoRange}, at.receiver, random.direction(), 0);
                    }),
          nearWrap(), kAgreement);
}

TEST(GpuNearLight, Spot) {
  Random random(411);
  compare("near spot light", nearShader(), nearTwin,
          manyCases(kCases,
                    [&] {
                      const Placement at = place(random, random.logUniform(0.01, 100));
                      const SpotLight light = spotAt(random, at, random.logUniform(1e-3, 1.5));
                      return caseOf(light, at.receiver, normalAt(random, at, random.uniform(0, 1.7)), 0);
                    }),
          nearWrap(), kAgreement);
}

TEST(GpuNearLight, Directional) {
  for (const float wrap : {-0.25f, 0.0f, 0.4f, 1.0f}) {
    Random random(412);
    compare("near directional light, wrap " + describe(wrap), nearShader(), nearTwin,
            manyCases(kCases / 4,
                      [&] {
                        const DirectionalLight light{random.direction() * 3.0f, {2, 2, 3}};
                        return caseOf(light, {9, 9, 9}, random.direction(), wrap);
                      }),
            nearWrap(wrap), kAgreement);
  }
}

TEST(GpuNearLight, Cheap) {
  Random random(413);
  compare("cheap Lambert, any r/d, inside and touching", cheapShader(), cheapTwin,
          manyCases(kCases, [&] { return hardSphere(random, random.logUniform(1e-6, 1e6), 0); }), nearWrap(),
          kAgreement);
}

TEST(GpuNearLight, Corrector) {
  // The truth is what 3 bands leave.
  for (const float wrap : {-0.2f, 0.0f, 0.5f}) {
    Random random(414);
    compare("corrector, wrap " + describe(wrap), correctorShader(), correctorTwin,
            manyCases(kCases / 2,
                      [&] {
                        const Placement at = place(random, 3);
                        const SphereLight light = sphereAt(at, random.index(2) == 0 ? random.uniform(0, 1.2) : 1e-3);
                        Case c = caseOf(light, at.receiver, random.direction(), wrap);
                        c.exact -=
                            static_cast<double>(evaluate(irradianceFromRadiance(project<3>(light, c.p), wrap), c.n).r);
                        return c;
                      }),
            nearWrap(wrap), kAgreement);
  }
}

TEST(GpuNearLight, KindsThatAreAbsentChangeNothing) {
  // What is left when all other kinds are compiled out gives the same to the last bit.
  Random random(416);
  const std::string kinds[] = {"kGpuDirectional", "kGpuPoint", "kGpuSpot", "kGpuSphere"};
  for (int kind = 0; kind < 4; ++kind) {
    for (const float wrap : {0.0f, 0.5f}) {
      std::vector<float> rows;
      for (int k = 0; k < 10'000; ++k) {
        const Placement at = place(random, 2);
        const double ratio = random.uniform(0.01, 1.2);
        const NearLight light = kind == 0   ? nearLight(DirectionalLight{random.direction(), {1, 2, 3}})
                                : kind == 1 ? nearLight(pointAt(random, at, ratio))
                                : kind == 2 ? nearLight(spotAt(random, at, ratio))
                                            : nearLight(sphereAt(at, ratio));
        append(rows, gpuNearLight(light));
        append(rows, nearWrap(wrap));
        append(rows, at.receiver);
        append(rows, random.direction());
      }
      const std::string defines = "#define RIGEL_HAS_NEAR(kind) ((kind) == " + kinds[kind] + ")\n" +
                                  "#define RIGEL_HAS_NEAR_WRAP " + (wrap == 0 ? "false" : "true") + "\n";
      tools::ShaderFunction all = nearShader();
      tools::ShaderFunction alone = shader("rigel_nearIrradiance(light, p, n, wrap)", defines);
      EXPECT_EQ(run(all, rows), run(alone, rows)) << kinds[kind] << ", wrap " << wrap;
    }
  }
}

TEST(GpuNearLight, NothingComesFromNanOrNoLight) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const NearLight sphere = nearLight(SphereLight{{0, 2, 0}, 1, {1, 1, 1}});
  const Vec3 n{0, 1, 0};
  const std::vector<Case> cases = {{sphere, {kNan, 0, 0}, n, 0, 1, {}},
                                   {sphere, {0, 0, kNan}, n, 0, 1, {}},
                                   {sphere, {kInf, 0, 0}, n, 0, 1, {}},
                                   {sphere, {}, {kNan, 0, 0}, 0, 1, {}},
                                   {sphere, {}, {0, kNan, 0}, 0, 1, {}},
                                   {NearLight{}, {}, n, 0, 1, {}},
                                   {nearLight(PointLight{{kNan, 1, 0}, {1, 1, 1}}), {}, n, 0, 1, {}},
                                   {nearLight(PointLight{{0, 1, 0}, {1, 1, 1}, 0.1f, 0}), {}, n, 0, 1, {}},
                                   {nearLight(SphereLight{{kInf, 1, 0}, 1, {1, 1, 1}}), {}, n, 0, 1, {}},
                                   {nearLight(DirectionalLight{{kNan, 0, 0}, {1, 1, 1}}), {}, n, 0, 1, {}},
                                   {nearLight(DirectionalLight{{0, -1, 0}, {1, 1, 1}}), {}, {kNan, 0, 0}, 0, 1, {}}};
  for (const float wrap : {-0.2f, 0.0f, 0.5f}) {
    for (const auto make : {nearShader, cheapShader, correctorShader}) {
      tools::ShaderFunction function = make();
      std::vector<float> rows;
      for (const Case& c : cases) {
        append(rows, gpuNearLight(c.light));
        append(rows, nearWrap(wrap));
        append(rows, c.p);
        append(rows, c.n);
      }
      const std::vector<float> results = run(function, rows);
      for (std::size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(results[i], 0) << "case " << i / 3 << ", wrap " << wrap;
    }
  }
}

TEST(GpuNearLight, EverythingIsFinite) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
  const float values[] = {0, kSmallest, 1e-37f, 1e-20f, 1, 1e20f, 1e37f, kLargest, -kLargest};
  Random random(415);
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) {
    const auto any = [&] { return values[random.index(9)]; };
    const PointLight point{{any(), any(), any()}, {any(), any(), any()}, any(), any()};
    const SphereLight sphere{{any(), any(), any()}, any(), {any(), any(), any()}};
    append(rows, gpuNearLight(random.index(2) == 0 ? nearLight(point) : nearLight(sphere)));
    append(rows, nearWrap(random.uniformf(-0.3, 1.1)));
    append(rows, Vec3{any(), any(), any()});
    append(rows, random.direction());
  }
  for (const auto make : {nearShader, cheapShader, correctorShader}) {
    tools::ShaderFunction function = make();
    for (const float value : run(function, rows)) ASSERT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace rigel::test
