// Near disk lights on the GPU and in C++, against exact irradiance in double. Errors are relative to the vector
// irradiance, which no normal that sees the whole disk exceeds.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/exact.h>
#include <rigel/near_light.h>
#include <rigel/project.h>

#include <limits>

#include "gpu/disk_cases.h"
#include "gpu/gpu_test.h"
#include "gpu/twin.h"

namespace rigel::test {
namespace {

constexpr int kCases = 100'000;

const std::string kTable =
    "#define RIGEL_DISK_TEXEL(texture, x, y) texelFetch(texels, 1024 * (texture) + 32 * (y) + (x))\n";

tools::ShaderFunction shader(const std::string& call, const std::string& defines = "") {
  tools::ShaderFunctionSource source;
  source.prelude = defines + "#include <rigel/near_light.glsl>\n";
  source.inputs = kNearInputs;
  source.outputs = {"vec3 e"};
  source.body = kNearBody + "e = " + call + ";";
  source.texels = defines == kTable;
  return shaderFunction(source);
}

/// Half of the normals any, half such that the kernel's horizon crosses the disk.
DiskCase nearCase(Random& random, DiskFamily family, float wrap) {
  DiskCase c = diskCase(random, family);
  c.n = random.direction();
  const detail::LocalDisk disk = detail::localDisk(c.light, c.p);
  if (!disk.lit || random.index(2) == 0) return c;
  const auto view = detail::viewOf<double>(disk);
  const Vec3 w{static_cast<float>(view.zx), static_cast<float>(view.zy), static_cast<float>(view.zz)};
  const double crossing = std::acos(-static_cast<double>(wrap)) + random.uniform(-1.05, 1.05) * std::asin(view.cone.sy);
  const Vec3 side = unitOf(cross(w, random.direction()));
  c.n = unitOf(w * static_cast<float>(std::cos(crossing)) + side * static_cast<float>(std::sin(crossing)));
  return c;
}

// Worst measured 9.6e-7.
constexpr double kLambertError = 2e-6;

/// A form of irradiance: in GLSL, in C++, and what it stands for.
struct Form {
  std::string name, call;
  Rgb (*twin)(const NearLight&, const DiskCase&, const NearWrap&);
  double (*truth)(const DiskCase&, float wrap);
};
double irradianceOf(const DiskCase& c, float wrap) { return exactIrradiance(c.light, c.p, c.n, wrap).r; }
double aboveBand2Of(const DiskCase& c, float wrap) {
  const Rgb bands = evaluate(irradianceFromRadiance(project<3>(c.light, c.p), wrap), c.n);
  return irradianceOf(c, wrap) - static_cast<double>(bands.r);
}
const Form kNear{"near disk", "rigel_nearIrradiance(light, p, n, wrap)",
                 [](const NearLight& light, const DiskCase& c, const NearWrap& wrap) {
                   return nearIrradiance(light, c.p, c.n, wrap);
                 },
                 irradianceOf};
const Form kCheap{
    "cheap disk", "rigel_cheapIrradiance(light, p, n)",
    [](const NearLight& light, const DiskCase& c, const NearWrap&) { return cheapIrradiance(light, c.p, c.n); },
    irradianceOf};
const Form kCorrector{"corrector", "rigel_correctorIrradiance(light, p, n, wrap)",
                      [](const NearLight& light, const DiskCase& c, const NearWrap& wrap) {
                        return correctorIrradiance(light, c.p, c.n, wrap);
                      },
                      aboveBand2Of};

tools::ShaderFunction nearShader(const std::string& defines = "") { return shader(kNear.call, defines); }

/// The vector irradiance; 1 where there is no light.
double termsOf(const DiskCase& c) {
  const detail::LocalDisk disk = detail::localDisk(c.light, c.p);
  return disk.lit ? disk.powerScale * detail::viewOf<double>(disk).flux : 1;
}

/// One family. `agreement`: of shader and C++, the stricter comparison where the form approximates. Gives the worst
/// difference of the two.
double compare(const Form& form, tools::ShaderFunction& function, DiskFamily family, int count, float wrap,
               double agreement, TwinFamilies& families) {
  Random random(920 + static_cast<std::uint64_t>(family));
  const NearWrap packed = nearWrap(wrap);
  std::vector<DiskCase> cases;
  for (int k = 0; k < count; ++k) cases.push_back(nearCase(random, family, wrap));
  const std::vector<float> results = run(function, rowsOf(cases, packed));
  EXPECT_EQ(results.size(), 3 * cases.size());
  TwinCheck& check = families[nameOf(family)];
  double worst = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const DiskCase& c = cases[i];
    const double terms = termsOf(c);
    const float expected = form.twin(c.near(), c, packed).r;
    check.add(results[3 * i], expected, form.truth(c, wrap), terms, [&] { return describe(c); });
    const double difference = TwinCheck::relativeError(results[3 * i], expected, terms);
    worst = std::max(worst, difference);
    EXPECT_LE(difference, agreement) << form.name << ": shader " << results[3 * i] << ", C++ " << expected << " at "
                                     << describe(c);
    if (difference > agreement) break;
  }
  return worst;
}

/// Every family, `count` of each; `error`: the largest that the form may have.
void compareFamilies(const Form& form, tools::ShaderFunction& function, int count, float wrap, double agreement,
                     double error) {
  TwinFamilies families(form.name + ", wrap " + describe(wrap));
  double worst = 0;
  for (const DiskFamily family : kDiskFamilies)
    worst = std::max(worst, compare(form, function, family, count, wrap, agreement, families));
  families.expectWithinTwice();
  EXPECT_LE(families.gpuError(), error) << form.name;
  std::printf("  shader and C++ differ by %.2g\n", worst);
}

// Of shader and C++, per vector irradiance; worst measured 9.9e-7.
constexpr double kAgreement = 2e-6;
// For a < 0 the kernel meets the horizon vertically, so that the rounding of n.w counts for more.
constexpr double kSteepAgreement = 8e-6;
// What the forms are off by themselves, worst near the rim: 3.7 %, 15 %, 6 % (a < 0).
constexpr double kWrapError = 0.045, kCheapError = 0.2, kCorrectorError = 0.08;
// Where the disk fills the hemisphere, 1 - s^2 is all rounding.
constexpr double kCheapAgreement = 4e-4;

TEST(GpuNearDisk, Lambert) {
  tools::ShaderFunction function = nearShader();
  compareFamilies(kNear, function, kCases / 5, 0, kAgreement, kLambertError);
}

TEST(GpuNearDisk, Wrap) {
  tools::ShaderFunction function = nearShader();
  for (const float wrap : {-0.25f, -0.05f, 0.3f, 0.8f, 1.0f})
    compareFamilies(kNear, function, 3000, wrap, wrap < 0 ? kSteepAgreement : kAgreement, kWrapError);
}

TEST(GpuNearDisk, Cheap) {
  tools::ShaderFunction function = shader(kCheap.call);
  compareFamilies(kCheap, function, kCases / 5, 0, kCheapAgreement, kCheapError);
}

TEST(GpuNearDisk, Corrector) {
  tools::ShaderFunction function = shader(kCorrector.call);
  for (const float wrap : {-0.2f, 0.0f, 0.5f})
    compareFamilies(kCorrector, function, 5000, wrap, wrap < 0 ? kSteepAgreement : kAgreement, kCorrectorError);
}

TEST(GpuNearDisk, WrapByTheTable) {
  // Against the shader by quadrature: what the two differ by is their errors in the bands.
  constexpr double kMethods = 1e-3;
  Random random(931);
  for (const float wrap : {-0.2f, 0.5f}) {
    std::vector<DiskCase> cases;
    for (const DiskFamily family : kDiskFamilies)
      for (int k = 0; k < 2000; ++k) cases.push_back(nearCase(random, family, wrap));
    const std::vector<float> rows = rowsOf(cases, nearWrap(wrap));
    tools::ShaderFunction byTable = nearShader(kTable), byNodes = nearShader("#define RIGEL_DISK_NODES 8\n");
    setDiskTable(byTable);
    const std::vector<float> tabulated = run(byTable, rows), integrated = run(byNodes, rows);
    double worst = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const double terms = termsOf(cases[i]);
      const double difference = TwinCheck::relativeError(tabulated[3 * i], integrated[3 * i], terms);
      worst = std::max(worst, difference);
      EXPECT_LE(difference, kMethods) << describe(cases[i]);
    }
    EXPECT_GT(worst, 1e-6) << "is it the table that was read?";
    std::printf("near disk, wrap %g: table and 8 nodes differ by %.2g\n", static_cast<double>(wrap), worst);
  }
}

TEST(GpuNearDisk, KindsThatAreAbsentChangeNothing) {
  // What is left when all other kinds are compiled out gives the same to the last bit.
  Random random(932);
  for (const float wrap : {0.0f, 0.5f}) {
    std::vector<DiskCase> cases;
    for (const DiskFamily family : kDiskFamilies)
      for (int k = 0; k < 1000; ++k) cases.push_back(nearCase(random, family, wrap));
    const std::vector<float> rows = rowsOf(cases, nearWrap(wrap));
    tools::ShaderFunction all = nearShader();
    tools::ShaderFunction alone =
        nearShader(std::string("#define RIGEL_HAS_NEAR(kind) ((kind) == kGpuDisk)\n#define RIGEL_HAS_NEAR_WRAP ") +
                   (wrap == 0 ? "false" : "true") + "\n");
    EXPECT_EQ(run(all, rows), run(alone, rows)) << "wrap " << wrap;
  }
}

std::vector<tools::ShaderFunction> everyForm() {
  std::vector<tools::ShaderFunction> all;
  all.push_back(nearShader());
  all.push_back(shader(kCheap.call));
  all.push_back(shader(kCorrector.call));
  return all;
}

TEST(GpuNearDisk, NothingComesFromNanOrNoLightOrBehind) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const DiskLight down{{0, 2, 0}, {0, -1, 0}, 1, {1, 1, 1}};
  const auto with = [&](auto change) {
    DiskLight light = down;
    change(light);
    return light;
  };
  const Vec3 up{0, 1, 0};
  const std::vector<DiskCase> cases = {
      {down, {kNan, 0, 0}, up},
      {down, {0, 0, kNan}, up},
      {down, {kInf, 0, 0}, up},
      {down, {0, -kInf, 0}, up},
      {down, {}, {kNan, 0, 0}},
      {down, {}, {0, kNan, 0}},
      {down, {0, 3, 0}, up},  // behind
      {down, {0, 3, 0}, {0, -1, 0}},
      {down, {5, 2, 0}, up},     // in its plane
      {down, {0.5f, 2, 0}, up},  // on its face, which is its plane
      {with([&](DiskLight& light) { light.twoSided = true; }), {0.5f, 2, 0}, up},
      {with([&](DiskLight& light) { light.radius = 0; }), {}, up},
      {with([&](DiskLight& light) { light.radius = kNan; }), {}, up},
      {with([&](DiskLight& light) { light.position.x = kNan; }), {}, up},
      {with([&](DiskLight& light) { light.position.x = kInf; }), {}, up},
      {with([&](DiskLight& light) { light.radiance.g = kNan; }), {}, up},
  };
  for (tools::ShaderFunction& function : everyForm()) {
    for (const float wrap : {-0.2f, 0.0f, 0.5f}) {
      const std::vector<float> results = run(function, rowsOf(cases, nearWrap(wrap)));
      for (std::size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(results[i], 0) << "case " << i / 3 << ", wrap " << wrap;
    }
  }
}

TEST(GpuNearDisk, EverythingIsFinite) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
  const float values[] = {0, kSmallest, 1e-37f, 1e-20f, 1, 1e20f, 1e37f, kLargest, -kLargest};
  Random random(933);
  const auto any = [&] { return values[random.index(9)]; };
  std::vector<DiskCase> cases;
  for (int k = 0; k < kCases / 4; ++k) {
    const DiskLight light{
        {any(), any(), any()}, random.direction(), any(), {any(), any(), any()}, random.index(2) == 0};
    cases.push_back({light, {any(), any(), any()}, random.direction()});
  }
  for (tools::ShaderFunction& function : everyForm())
    for (const float wrap : {0.0f, 0.6f})
      for (const float value : run(function, rowsOf(cases, nearWrap(wrap)))) ASSERT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace rigel::test
