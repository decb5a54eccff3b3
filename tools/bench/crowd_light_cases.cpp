// A crowd in cities of 1000 and 100,000 lamps: what the light tree makes of the cost of an object.
#include "bench/bench_case.h"

#include <rigel/far_lights.h>
#include <rigel/light_tree.h>
#include <rigel/project_batch.h>
#include <rigel/rig_light.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>

namespace rigel::tools {
namespace {

constexpr int kPacks = 16;
constexpr int kPackSize = 64;  // characters that stand together and share a selection
constexpr int kSamples = 12;
constexpr int kPoints = kPackSize * kSamples;
constexpr float kPackRadius = 12;  // m
constexpr float kTarget = 0.2f;    // bound of the errors of clusters and slopes; rigs/README.md has the true errors
constexpr float kSpacing = 30;     // m, of the lamps

/// Lamps 5 to 8 m over a plane, in a square about the origin, without range: half points, half spheres.
LightSet lampCity(int count, float shift = 0) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  const auto place = [&](int cell) {
    return (static_cast<float>(cell) + 0.6f * unit(random) - 0.5f * static_cast<float>(side)) * kSpacing;
  };
  LightSet lights;
  for (int i = 0; i < count; ++i) {
    const float x = place(i % side), z = place(i / side), y = 5 + 3 * unit(random);
    const Rgb intensity{400 + 200 * unit(random), 400 + 100 * unit(random), 300 + 100 * unit(random)};
    const float radius = 0.2f;
    if (i % 2 == 0)
      lights.add(PointLight{{x + shift, y, z}, intensity});
    else
      lights.add(SphereLight{{x + shift, y, z}, radius, intensity * (1 / (3.14159265f * radius * radius))});
  }
  return lights;
}

/// One pack's points, sample by sample, and what becomes of its light.
struct Pack {
  Vec3 centre;
  std::vector<float> x, y, z;
};

/// Packs in a square of 400 m about the origin, people within kPackRadius of their pack's middle.
std::vector<Pack> packs() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Pack> out(kPacks);
  for (int i = 0; i < kPacks; ++i) {
    Pack& pack = out[i];
    pack.centre = {100 * (static_cast<float>(i % 4) - 1.5f) + 40 * unit(random), 1,
                   100 * (static_cast<float>(i / 4) - 1.5f) + 40 * unit(random)};
    for (int person = 0; person < kPackSize; ++person) {
      const float turn = 6.2832f * unit(random), away = (kPackRadius - 1) * std::sqrt(unit(random));
      for (int sample = 0; sample < kSamples; ++sample) {
        pack.x.push_back(pack.centre.x + away * std::cos(turn) + 0.5f * (unit(random) - 0.5f));
        pack.y.push_back(pack.centre.y + 1.8f * (unit(random) - 0.5f));
        pack.z.push_back(pack.centre.z + away * std::sin(turn) + 0.5f * (unit(random) - 0.5f));
      }
    }
  }
  return out;
}

struct CrowdInCity {
  LightSet lights;
  LightTree tree;
  PreparedLights prepared;
  std::vector<Pack> crowd = packs();
  LightSelection selection;
  std::vector<float> sums = std::vector<float>(27 * kPoints);
  Rig rig;
  std::vector<RadianceSH<3>> functionals, coefficients;

  explicit CrowdInCity(int count) : lights(lampCity(count)), rig(makeRig()) {
    tree.build(lights);
    prepared.set(lights);
    for (const SphereLight& cluster : tree.clusters()) prepared.add(cluster);
    functionals.resize(rig.projections());
    coefficients.resize(rig.shVectors());
  }

  /// Everything that depends on the lights: selection, projection, fit.
  void light() {
    for (const Pack& pack : crowd) {
      tree.select({.centre = pack.centre, .radius = kPackRadius, .target = kTarget, .everywhere = true}, selection);
      projectBatch<3>(prepared, selection.near, {pack.x, pack.y, pack.z}, {}, sums);
      const auto far = projectFar<3>(prepared, selection.distant, pack.centre);
      for (int person = 0; person < kPackSize; ++person) {
        for (int sample = 0; sample < kSamples; ++sample) functionals[sample] = sampleOf(pack, far, person, sample);
        fitRig<3>(rig, functionals, coefficients);
        benchmark::DoNotOptimize(coefficients.data());
      }
    }
  }

 private:
  static Rig makeRig() {
    const std::vector<Vec3> surface = bodySurface();
    Rig rig = *Rig::create(*parseRigSpec("poly:6"), {{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}}, surface});
    std::vector<Vec3> anchors;
    for (int i : rig.anchors()) anchors.push_back(surface[i]);
    rig.setPose({{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}}, anchors});
    return rig;
  }

  RadianceSH<3> sampleOf(const Pack& pack, const ProjectionWithGradient<3>& far, int person, int sample) const {
    const int at = person * kSamples + sample;
    const Vec3 off = Vec3{pack.x[at], pack.y[at], pack.z[at]} - pack.centre;
    RadianceSH<3> sh = far.value;
    for (int axis = 0; axis < 3; ++axis) sh += far.gradient.d[axis] * off[axis];
    float* numbers = sh.data();
    for (int row = 0; row < 27; ++row) numbers[row] += sums[static_cast<std::size_t>(row) * kPoints + at];
    return sh;
  }
};

void addCity(std::vector<BenchCase>& cases, const std::string& name, const std::string& baseline, int count) {
  const auto city = std::make_shared<std::unique_ptr<CrowdInCity>>();
  cases.push_back({name, "us/object", kPacks * kPackSize, 1e3, baseline, [=](benchmark::State& state) {
                     if (!*city) *city = std::make_unique<CrowdInCity>(count);
                     for (auto _ : state) (*city)->light();
                   }});
}

/// Of 100,000 lamps; `moved`: one in so many is refitted, 0 builds the tree.
void addStructure(std::vector<BenchCase>& cases, const std::string& name, int moved) {
  constexpr int kLamps = 100000;
  const double items = moved > 0 ? kLamps / moved : kLamps;
  cases.push_back({name, "ns/light", items, 1, moved == 0 ? "" : "crowd.lights_build", [=](benchmark::State& state) {
                     const std::array<LightSet, 2> lights{lampCity(kLamps), lampCity(kLamps, 0.1f)};
                     std::vector<std::uint32_t> indices;
                     for (std::uint32_t i = 0; moved > 0 && i < kLamps; i += static_cast<std::uint32_t>(moved))
                       indices.push_back(i);
                     LightTree tree;
                     tree.build(lights[0]);
                     std::size_t frame = 0;
                     for (auto _ : state) {
                       const LightSet& now = lights[++frame % 2];
                       if (moved == 0)
                         tree.build(now);
                       else if (moved == 1)
                         benchmark::DoNotOptimize(tree.refit(now));
                       else
                         benchmark::DoNotOptimize(tree.refit(now, indices));
                     }
                   }});
}

}  // namespace

void addCrowdLightCases(std::vector<BenchCase>& cases) {
  // Its ratio is that of the cost of an object in the small city to that in the large one.
  addCity(cases, "crowd.lights_1000", "", 1000);
  addCity(cases, "crowd.lights_scaling", "crowd.lights_1000", 100000);
  addStructure(cases, "crowd.lights_build", 0);
  addStructure(cases, "crowd.lights_refit", 1);
  addStructure(cases, "crowd.lights_refit_some", 20);
}

}  // namespace rigel::tools
