#include "bench/bench_case.h"

#include <rigel/exact.h>
#include <rigel/near_batch.h>

#include <cmath>
#include <memory>

namespace rigel::tools {
namespace {

/// Floating-point operations a light and point take, as counted for spheres no horizon crosses: 3 for the way to the
/// light, 5 for its square, 8 for inverse distance and cosine, 2 to hold that, 5 for s and c, 2 for the cap and 6 into
/// the sums. What is clipped comes on top.
constexpr double kFlops = 31;

/// Eight lights a hand's breadth to a metre off the body, as seen from its surface r/d is 0.05 to 0.5; the body's
/// points, once more in rows.
struct NearScene {
  enum class Kind { sphere, spot, disk };

  LightSet lights;
  std::vector<NearLight> near;
  std::vector<Vec3> points = bodySurface();
  std::vector<float> rows[6], irradiance;

  explicit NearScene(Kind kind) {
    for (int i = 0; i < 8; ++i) {
      const float phi = 0.8f * static_cast<float>(i);
      const float distance = 0.5f + 0.1f * static_cast<float>(i);
      const Vec3 p{distance * std::cos(phi), 0.2f * static_cast<float>(i - 4), distance * std::sin(phi)};
      if (kind == Kind::spot) lights.add(SpotLight{p, -p, {30, 20, 10}, 0.4f, 0.9f, 0.05f, 10});
      if (kind == Kind::sphere) lights.add(SphereLight{p, 0.1f, {30, 20, 10}});
      if (kind == Kind::disk) lights.add(DiskLight{p, -p, 0.1f, {30, 20, 10}});
      near.push_back(lights.visit(i, [](const auto& light) { return nearLight(light); }));
    }
    for (const Vec3 p : points)
      for (int axis = 0; axis < 3; ++axis) {
        rows[axis].push_back(p[axis]);
        rows[3 + axis].push_back(normalAt(p)[axis]);
      }
    irradiance.resize(3 * points.size());
  }
  static Vec3 normalAt(Vec3 p) { return p * (1 / length(p)); }
  double items() const { return static_cast<double>(near.size() * points.size()); }
};

using ScenePointer = std::shared_ptr<NearScene>;

/// `evaluate(light, p, n)`, light after light and point after point; of the lights of the set or of the near path.
template <class Lights, class Evaluate>
void addScalar(std::vector<BenchCase>& cases, const std::string& name, const std::string& baseline,
               const ScenePointer& scene, const Lights& forLights, const Evaluate& evaluate) {
  cases.push_back({name, "ns/light/point", scene->items(), 1, baseline, [=](benchmark::State& state) {
                     for (auto _ : state)
                       for (const Vec3 p : scene->points) {
                         const Vec3 n = NearScene::normalAt(p);
                         forLights(*scene, [&](const auto& light) {
                           auto e = evaluate(light, p, n);
                           benchmark::DoNotOptimize(e);
                         });
                       }
                   }});
}

void addBatch(std::vector<BenchCase>& cases, const std::string& name, const std::string& baseline,
              const ScenePointer& scene, float wrap) {
  BenchCase batch{
      name, "ns/light/point", scene->items(), 1, baseline, [scene, prepared = nearWrap(wrap)](benchmark::State& state) {
        const auto& rows = scene->rows;
        for (auto _ : state) {
          nearIrradianceBatch(scene->near, {rows[0], rows[1], rows[2]}, {rows[3], rows[4], rows[5]}, prepared,
                              scene->irradiance);
          benchmark::DoNotOptimize(scene->irradiance.data());
          benchmark::ClobberMemory();
        }
      }};
  if (baseline == "near.sphere") batch.flops = kFlops;
  cases.push_back(std::move(batch));
}

}  // namespace

void addNearCases(std::vector<BenchCase>& cases) {
  const auto spheres = std::make_shared<NearScene>(NearScene::Kind::sphere);
  const auto spots = std::make_shared<NearScene>(NearScene::Kind::spot);
  const auto disks = std::make_shared<NearScene>(NearScene::Kind::disk);
  const auto set = [](const NearScene& scene, const auto& body) {
    for (int i = 0; i < scene.lights.size(); ++i) scene.lights.visit(i, body);
  };
  const auto near = [](const NearScene& scene, const auto& body) {
    for (const NearLight& light : scene.near) body(light);
  };
  const auto exact = [](float wrap) {
    return [wrap](const auto& light, Vec3 p, Vec3 n) { return exactIrradiance(light, p, n, wrap); };
  };
  const auto runtime = [](float wrap) {
    return [prepared = nearWrap(wrap)](const NearLight& light, Vec3 p, Vec3 n) {
      return nearIrradiance(light, p, n, prepared);
    };
  };
  const auto cheap = [](const NearLight& light, Vec3 p, Vec3 n) { return cheapIrradiance(light, p, n); };
  addScalar(cases, "near.exact_sphere", "", spheres, set, exact(0));
  addScalar(cases, "near.exact_wrap", "", spheres, set, exact(0.3f));
  addScalar(cases, "near.exact_spot", "", spots, set, exact(0));
  addScalar(cases, "near.sphere", "near.exact_sphere", spheres, near, runtime(0));
  addScalar(cases, "near.sphere.cheap", "near.exact_sphere", spheres, near, cheap);
  addScalar(cases, "near.wrap", "near.exact_wrap", spheres, near, runtime(0.3f));
  addScalar(cases, "near.spot", "near.exact_spot", spots, near, runtime(0));
  addScalar(cases, "near.disk", "", disks, near, runtime(0));
  addScalar(cases, "near.disk_wrap", "", disks, near, runtime(0.3f));
  addBatch(cases, "near.batch", "near.sphere", spheres, 0);
  addBatch(cases, "near.batch.wrap", "near.wrap", spheres, 0.3f);
  addBatch(cases, "near.batch.spot", "near.spot", spots, 0);
  addBatch(cases, "near.batch.disk", "near.disk", disks, 0);
  addBatch(cases, "near.batch.disk_wrap", "near.disk_wrap", disks, 0.3f);
}

}  // namespace rigel::tools
