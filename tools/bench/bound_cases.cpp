#include "bench/bench_case.h"

#include <rigel/light_bound.h>
#include <rigel/probed_bounds.h>

#include <memory>
#include <random>
#include <type_traits>

namespace rigel::tools {
namespace {

struct BoundedRig {
  std::vector<Vec3> surface = bodySurface();
  RigBox box{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}};
  Rig rig;
  LightBounds bounds;
  ProbedBounds probed{rig, {}};

  explicit BoundedRig(const std::string& spec)
      : rig(*Rig::create(*parseRigSpec(spec), {box, surface, true})), bounds(posed()) {}

 private:
  LightBounds posed() {
    std::vector<Vec3> anchors;
    for (int i : rig.anchors()) anchors.push_back(surface[i]);
    rig.setPose({box, anchors});
    if (rig.spec().falloff) {
      LightSet lights;
      lights.add(SphereLight{{0.8f, 0.5f, 0.3f}, 0.1f, {3, 2, 1}});  // half a metre off
      std::vector<RadianceSH<3>> functionals(rig.projections());
      projectSamples<3>(rig, {}, lights, functionals);
      adaptRig<3>(rig, functionals);
    }
    return LightBounds(rig, {});
  }
};

enum class LightKind { sphere, litSpot, rimSpot, disk };

/// One to ten metres off; spots light all of the body, or have the middle of their blend on its centre; disks face it
/// 45 degrees off.
template <class Light>
std::vector<Light> lightsAround(LightKind kind) {
  constexpr int kCount = 64;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<Light> lights;
  while (lights.size() < kCount) {
    const Vec3 p{10 * unit(random), 10 * unit(random), 10 * unit(random)};
    if (length(p) < 2) continue;
    if constexpr (std::is_same_v<Light, SphereLight>) {
      lights.push_back({p, 0.1f, {3, 2, 1}});
    } else if constexpr (std::is_same_v<Light, DiskLight>) {
      const Vec3 across = cross(p, {0.3f, 0.5f, 0.8f});
      lights.push_back({p, across * (length(p) / length(across)) - p, 0.3f, {3, 2, 1}});
    } else {
      const Vec3 across = cross(p, {0.3f, 0.5f, 0.8f});
      const Vec3 aside = across * (length(p) / length(across));
      if (kind == LightKind::litSpot)
        lights.push_back({p, -p, {3, 2, 1}, 0.8f, 1});
      else
        lights.push_back({p, aside - p, {3, 2, 1}, 0.7f, 0.9f});  // 45 degrees off the centre
    }
  }
  return lights;
}

template <class Light>
void addLightCase(std::vector<BenchCase>& cases, const std::string& spec, const std::shared_ptr<BoundedRig>& rig,
                  const std::string& name, LightKind kind) {
  const auto lights = std::make_shared<std::vector<Light>>(lightsAround<Light>(kind));
  cases.push_back({"bound." + name + "." + spec, "ns/light", static_cast<double>(lights->size()), 1,
                   "project.sphere.n64", [=](benchmark::State& state) {
                     for (auto _ : state)
                       for (const Light& light : *lights) {
                         LightBound bound = rig->bounds(light);
                         benchmark::DoNotOptimize(bound);
                       }
                   }});
  if (kind == LightKind::litSpot || !rig->probed.tight()) return;
  cases.push_back({"bound.probed." + name + "." + spec, "ns/light", static_cast<double>(lights->size()), 1,
                   "bound." + name + "." + spec, [=](benchmark::State& state) {
                     for (auto _ : state)
                       for (const Light& light : *lights) {
                         LightBound bound = rig->probed(light);
                         benchmark::DoNotOptimize(bound);
                       }
                   }});
}

}  // namespace

void addBoundCases(std::vector<BenchCase>& cases) {
  for (const std::string spec : {"gradient", "lattice:3x2x2", "mixed:l3,g,c", "poly:6", "poly:12", "invquad:6"}) {
    const auto rig = std::make_shared<BoundedRig>(spec);
    cases.push_back({"bound.prepare." + spec, "us/character", 1, 1e3,
                     spec == "gradient" ? "" : "bound.prepare.gradient", [rig](benchmark::State& state) {
                       for (auto _ : state) {
                         LightBounds bounds(rig->rig, {});
                         benchmark::DoNotOptimize(bounds);
                       }
                     }});
    if (rig->probed.tight())
      cases.push_back({"bound.probed.prepare." + spec, "us/character", 1, 1e3, "bound.prepare." + spec,
                       [rig](benchmark::State& state) {
                         for (auto _ : state) {
                           ProbedBounds bounds(rig->rig, {});
                           benchmark::DoNotOptimize(bounds);
                         }
                       }});
    addLightCase<SphereLight>(cases, spec, rig, "sphere", LightKind::sphere);
    addLightCase<DiskLight>(cases, spec, rig, "disk", LightKind::disk);
    addLightCase<SpotLight>(cases, spec, rig, "spot", LightKind::litSpot);
    addLightCase<SpotLight>(cases, spec, rig, "spot_rim", LightKind::rimSpot);
  }
}

}  // namespace rigel::tools
