// Disk lights in GLSL beside C++: the shared text of the bisector frame against the same formulas in double, views and
// SH against exact ones, the table against DiskTable.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/disk_batch.h>
#include <rigel/disk_table.h>
#include <rigel/project.h>
#include <rigel/shader_disk_irradiance.h>

#include <array>
#include <functional>

#include "gpu/disk_cases.h"
#include "gpu/gpu_test.h"
#include "gpu/near_rows.h"
#include "gpu/twin.h"
#include "lights/describe.h"
#include "look_up.h"

namespace rigel::test {
namespace {

constexpr int kCases = 100'000;

// The shared text.

/// rho, m, z: where diskCone is well conditioned in its floats, whatever the digits of rho - 1.
struct ConeRow {
  float rho, m, z;
  DiskFamily family;
};

ConeRow coneRow(Random& random) {
  const DiskFamily family = kDiskFamilies[random.index(std::size(kDiskFamilies))];
  auto [rho, z] = placeAmong(random, family);
  const double reach = std::hypot(rho, z);
  if (reach > kRigelDiskReach) {
    rho *= kRigelDiskReach / reach;
    z *= kRigelDiskReach / reach;
  }
  return {static_cast<float>(rho), static_cast<float>((rho - 1) * (rho + 1) + z * z), static_cast<float>(z), family};
}

template <class Real>
detail::DiskCone<Real> coneOf(const ConeRow& row) {
  return detail::diskCone(Real(row.rho), Real(row.m), Real(row.z));
}

std::string describe(const ConeRow& row) {
  return "rho " + test::describe(row.rho) + ", m " + test::describe(row.m) + ", z " + test::describe(row.z);
}

tools::ShaderFunctionSource coneSource(std::vector<std::string> outputs, const std::string& body,
                                       const std::string& defines = "") {
  tools::ShaderFunctionSource source;
  source.prelude = defines + "#include <rigel/disk.glsl>\n#include <rigel/shader_disk_irradiance.h>\n";
  source.inputs = {"float rho", "float m", "float z", "vec3 n"};
  source.outputs = std::move(outputs);
  source.body = "RigelDiskCone cone = rigel_diskCone(rho, m, z);\n" + body;
  return source;
}

struct ConeRows {
  std::vector<ConeRow> cases;
  std::vector<Vec3> normals;
  std::vector<float> rows;

  explicit ConeRows(std::uint64_t seed) {
    Random random(seed);
    for (int k = 0; k < kCases; ++k) {
      cases.push_back(coneRow(random));
      const auto& [rho, m, z, family] = cases.back();
      // Half of the normals such that the horizon crosses the cone.
      Vec3 n = random.direction();
      if (random.index(2) == 0) n = unitOf({n.x, n.y, n.z * coneOf<float>(cases.back()).sy});
      normals.push_back(n);
      rows.insert(rows.end(), {rho, m, z, n.x, n.y, n.z});
    }
  }
};

TEST(GpuDisk, ConesAreTheTwins) {
  const ConeRows all(901);
  const std::vector<float> values = evaluate(
      coneSource(
          {"float c[10]"},
          "c = float[10](cone.sx2, cone.cx2, cone.sy2, cone.cy2, cone.sx, cone.cx, cone.sy, cone.cy, cone.t, cone.u);"),
      all.rows);
  TwinFamilies families("cone of a disk");
  for (int k = 0; k < kCases; ++k) {
    const auto twin = coneOf<float>(all.cases[k]);
    const auto exact = coneOf<double>(all.cases[k]);
    const float t[] = {twin.sx2, twin.cx2, twin.sy2, twin.cy2, twin.sx, twin.cx, twin.sy, twin.cy, twin.t, twin.u};
    const double e[] = {exact.sx2, exact.cx2, exact.sy2, exact.cy2, exact.sx,
                        exact.cx,  exact.sy,  exact.cy,  exact.t,   exact.u};
    for (int i = 0; i < 10; ++i)
      families[nameOf(all.cases[k].family)].add(values[10 * k + i], t[i], e[i], std::abs(e[i]),
                                                [&] { return describe(all.cases[k]); });
  }
  families.expectWithinTwice();
}

template <class Real>
std::array<Real, 8> listed(const detail::DiskMoments<Real>& q) {
  return {q.q00, q.q20, q.q22, q.q30, q.q32, q.q40, q.q42, q.q44};
}

/// ||q|| of the moments, per vector irradiance, with (1, 0).
double normOf(const std::array<double, 8>& q) {
  double sum = kRigelY1 * kRigelY1;
  for (const double x : q) sum += x * x;
  return std::sqrt(sum);
}

const std::vector<std::string> kMomentOutputs = {"float v[8]"};
const std::string kListMoments = "v = float[8](q.q00, q.q20, q.q22, q.q30, q.q32, q.q40, q.q42, q.q44);";

/// `moments`: the twin's of a float cone, the truth's of a double one.
template <class Moments>
void checkMoments(const std::string& name, const std::string& defines, const Moments& moments) {
  const ConeRows all(902);
  auto source = coneSource(kMomentOutputs, "RigelDiskMoments q = rigel_diskMoments(cone);\n" + kListMoments, defines);
  source.texels = true;
  auto function = shaderFunction(source);
  setDiskTable(function);
  const std::vector<float> values = run(function, all.rows);
  TwinFamilies families(name);
  for (int k = 0; k < kCases; ++k) {
    const auto twin = listed(moments(coneOf<float>(all.cases[k])));
    const auto exact = listed(moments(coneOf<double>(all.cases[k])));
    for (std::size_t i = 0; i < 8; ++i)
      families[nameOf(all.cases[k].family)].add(
          values[8 * static_cast<std::size_t>(k) + i], twin[i], exact[i], normOf(exact),
          [&] { return "moment " + std::to_string(i) + " at " + describe(all.cases[k]); });
  }
  families.expectWithinTwice();
}

TEST(GpuDisk, MomentsOfFourNodes) {
  checkMoments("moments of 4 nodes", "#define RIGEL_DISK_NODES 4\n",
               [](const auto& cone) { return detail::diskMoments4<5>(cone); });
}
TEST(GpuDisk, MomentsOfSixNodes) {
  checkMoments("moments of 6 nodes", "", [](const auto& cone) { return detail::diskMoments6<5>(cone); });
}
TEST(GpuDisk, MomentsOfEightNodes) {
  checkMoments("moments of 8 nodes", "#define RIGEL_DISK_NODES 8\n",
               [](const auto& cone) { return detail::diskMoments8<5>(cone); });
}

const std::string kTable =
    "#define RIGEL_DISK_TEXEL(texture, x, y) texelFetch(texels, 1024 * (texture) + 32 * (y) + (x))\n";

struct TableTwin {
  auto operator()(const detail::DiskCone<float>& cone) const {
    return detail::tabulatedMoments<5>(DiskTable::view(), cone);
  }
  auto operator()(const detail::DiskCone<double>& cone) const { return detail::exactDiskMoments(cone); }
};
TEST(GpuDisk, MomentsOfTheTable) { checkMoments("moments of the table", kTable, TableTwin()); }

TEST(GpuDisk, LambertOfACone) {
  const ConeRows all(903);
  const std::vector<float> values =
      evaluate(coneSource({"float e"}, "e = rigel_diskLambert(cone, n.x, n.y, n.z);"), all.rows);
  TwinFamilies families("clipped Lambert of a disk");
  for (int k = 0; k < kCases; ++k) {
    const Vec3 n = all.normals[static_cast<std::size_t>(k)];
    const auto at = [&](auto cone) {
      using Real = decltype(cone.t);
      return detail::diskLambert(cone, Real(n.x), Real(n.y), Real(n.z));
    };
    families[nameOf(all.cases[k].family)].add(values[static_cast<std::size_t>(k)], at(coneOf<float>(all.cases[k])),
                                              at(coneOf<double>(all.cases[k])), 1,
                                              [&] { return describe(all.cases[k]) + ", n " + test::describe(n); });
  }
  families.expectWithinTwice();
}

// Lights in the world.

struct Method {
  std::string name, defines;
  RadianceSH<5> (*twin)(const DiskLight&, Vec3);
};
/// As vectors have it, in float but for what cancels, as the shader. projectDisk has all of the view in double.
template <DiskNodes N>
RadianceSH<5> byNodes(const DiskLight& light, Vec3 p) {
  std::array<float, 25> sh;
  projectDiskBatch<5>(light, {{&p.x, 1}, {&p.y, 1}, {&p.z, 1}}, N, sh);
  RadianceSH<5> out;
  for (int i = 0; i < 25; ++i) out[i] = light.radiance * sh[static_cast<std::size_t>(i)];
  return out;
}
const Method kMethods[] = {
    {"4 nodes", "#define RIGEL_DISK_NODES 4\n", byNodes<DiskNodes::four>},
    {"6 nodes", "", byNodes<DiskNodes::six>},
    {"8 nodes", "#define RIGEL_DISK_NODES 8\n", byNodes<DiskNodes::eight>},
    {"the table", kTable, [](const DiskLight& light, Vec3 p) { return DiskTable::project<5>(light, p); }},
};

tools::ShaderFunction shFunction(int bands, const Method& method) {
  const std::string count = std::to_string(bands * bands);
  tools::ShaderFunctionSource source;
  source.prelude =
      "#define RIGEL_BANDS " + std::to_string(bands) + "\n" + method.defines + "#include <rigel/disk.glsl>\n";
  source.inputs = kNearInputs;
  source.outputs = {"float sh[" + count + "]"};
  source.body = kNearBody +
                "RigelDiskView view = rigel_viewDisk(light, p);\n"
                "rigel_diskSh(rigel_diskMoments(view.cone), view, sh);\n"
                "for (int i = 0; i < " +
                count + "; ++i) sh[i] *= light.colour.x * view.flux;";
  source.texels = true;
  auto function = shaderFunction(source);
  setDiskTable(function);
  return function;
}

// What the view costs in float, per ||q||: 9.3e-7, most of it the flux, off by as much from the chain of roundings to
// the angles of the cone. projectDisk and DiskTable::project have it in double and round it last (1.4e-7 for small
// disks).
constexpr double kShAgreement = 1.2e-6;

/// Shader and twin against exact SH and against each other, which is the stricter: the method's own error hides much.
void checkSh(const Method& method, int bands, int countOfEach) {
  tools::ShaderFunction function = shFunction(bands, method);
  TwinFamilies families("SH of a disk by " + method.name + ", " + std::to_string(bands) + " bands");
  double worst = 0;
  for (const DiskFamily family : kDiskFamilies) {
    Random random(910 + static_cast<std::uint64_t>(family));
    std::vector<DiskCase> cases;
    for (int k = 0; k < countOfEach; ++k) cases.push_back(diskCase(random, family));
    const std::vector<float> values = run(function, rowsOf(cases, nearWrap()));
    const auto size = static_cast<std::size_t>(bands * bands);
    TwinCheck& check = families[nameOf(family)];
    ASSERT_EQ(values.size(), size * cases.size());
    for (std::size_t k = 0; k < cases.size(); ++k) {
      const RadianceSH<5> twin = method.twin(cases[k].light, cases[k].p);
      std::array<double, 75> exact;
      projectDiskExact(cases[k].light, cases[k].p, 5, exact);
      double square = 0;
      for (std::size_t i = 0; i < 25; ++i) square += exact[3 * i] * exact[3 * i];
      const double norm = std::sqrt(square);
      for (std::size_t i = 0; i < size; ++i) {
        const float value = values[k * size + i], own = twin[static_cast<int>(i)].r;
        const auto text = [&] { return "coefficient " + std::to_string(i) + " of " + describe(cases[k]); };
        check.add(value, own, exact[3 * i], norm, text);
        const double difference = TwinCheck::relativeError(value, own, norm);
        worst = std::max(worst, difference);
        EXPECT_LE(difference, kShAgreement) << method.name << ", " << text();
      }
    }
  }
  // The table's functions have their twins above and among the nodes'; in the world its twin has no view in float.
  families.expectWithinTwice(method.defines == kTable ? kShAgreement : TwinCheck::kHalfUlp);
  std::printf("  shader and C++ differ by %.2g\n", worst);
}

TEST(GpuDisk, ShOfFiveBands) {
  for (const Method& method : kMethods) checkSh(method, 5, 1000);
}
TEST(GpuDisk, ShOfFewerBands) {
  for (const int bands : {2, 3, 4})
    for (const std::size_t method : {1, 3}) checkSh(kMethods[method], bands, 16000 / (bands * bands));
}

}  // namespace
}  // namespace rigel::test
