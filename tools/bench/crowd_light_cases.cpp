// A crowd in cities of 1000 and 100,000 lamps: what the light tree makes of the cost of an object.
#include "bench/bench_case.h"

#include <rigel/crowd.h>
#include <rigel/light_tree.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

namespace rigel::tools {
namespace {

constexpr int kPacks = 16;
constexpr int kPackSize = 64;      // characters that stand together
constexpr float kPackRadius = 12;  // m
constexpr float kCell = 8;         // m
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

/// Where people stand: packs in a square of 400 m about the origin, each within kPackRadius of its middle.
std::vector<Vec3> places() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Vec3> out;
  for (int i = 0; i < kPacks; ++i) {
    const float x = 100 * (static_cast<float>(i % 4) - 1.5f) + 40 * unit(random);
    const float z = 100 * (static_cast<float>(i / 4) - 1.5f) + 40 * unit(random);
    for (int person = 0; person < kPackSize; ++person) {
      const float turn = 6.2832f * unit(random), away = (kPackRadius - 1) * std::sqrt(unit(random));
      out.push_back({x + away * std::cos(turn), 0.9f, z + away * std::sin(turn)});
    }
  }
  return out;
}

/// The same people, each by himself, over all of the large city.
std::vector<Vec3> placesApart() {
  constexpr int kSide = 32;
  static_assert(kSide * kSide == kPacks * kPackSize);
  constexpr float kApart = 290;  // m
  std::vector<Vec3> out;
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto along = [](int n) { return kApart * (static_cast<float>(n) - 0.5f * (kSide - 1)); };
    out.push_back({along(i % kSide), 0.9f, along(i / kSide)});
  }
  return out;
}

/// People who walk, 1.4 m/s at 60 frames a second, to and fro over eight metres.
class CrowdInCity {
 public:
  explicit CrowdInCity(int lamps, std::vector<Vec3> at = places()) : lights_(lampCity(lamps)), places_(std::move(at)) {
    tree_.build(lights_);
    prepare(lights_, tree_, prepared_);
    const std::vector<Vec3> surface = bodySurface();
    const RigBox box{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}};
    const int kind = crowd_.addKind(*CrowdKind::create(*parseRigSpec("poly:6"), {{box, surface}, {}}));
    for (std::size_t i = 0; i < places_.size(); ++i) ids_.push_back(crowd_.add(kind));
    const CrowdOutputBound bound = crowd_.outputBound();
    rigs_.resize(bound.rigs);
    coefficients_.resize(bound.coefficients);
    near_.resize(bound.nearLights);
  }

  static void prepare(const LightSet& lights, const LightTree& tree, PreparedLights& prepared) {
    prepared.set(lights);
    for (const SphereLight& cluster : tree.clusters()) prepared.add(cluster);
  }

  /// `anew`: as if lamps had moved, nothing that the last frame knew is good.
  void light(bool anew) {
    if (anew) tree_.refit(lights_, {});
    ++frame_;
    const float t = static_cast<float>(frame_ % 360) / 360, along = 8 * std::abs(2 * t - 1);
    for (std::size_t i = 0; i < ids_.size(); ++i)
      crowd_.input(ids_[i]).worldFromRig.origin = places_[i] + (i % 2 == 0 ? Vec3{along, 0, 0} : Vec3{0, 0, along});
    const CrowdStats stats = crowd_.frame({&lights_, &prepared_, {}, {&tree_, kTarget, kCell}}, 1.0f / 60,
                                          {rigs_, coefficients_, {}, near_});
    benchmark::DoNotOptimize(stats);
  }

 private:
  LightSet lights_;
  LightTree tree_;
  PreparedLights prepared_;
  std::vector<Vec3> places_;
  Crowd<3> crowd_;
  std::vector<CrowdId> ids_;
  std::vector<GpuRig> rigs_;
  std::vector<GpuVec4> coefficients_;
  std::vector<GpuNearLight> near_;
  int frame_ = 0;
};

using Cities = std::array<std::unique_ptr<CrowdInCity>, 2>;

/// The first city has 1000 lamps, the second 100,000.
void addCity(std::vector<BenchCase>& cases, const std::string& name, const std::string& baseline,
             const std::shared_ptr<Cities>& cities, std::size_t city, bool anew) {
  cases.push_back({name, "us/object", kPacks * kPackSize, 1e3, baseline, [=](benchmark::State& state) {
                     std::unique_ptr<CrowdInCity>& one = (*cities)[city];
                     if (!one) one = std::make_unique<CrowdInCity>(city == 0 ? 1000 : 100000);
                     for (auto _ : state) one->light(anew);
                   }});
}

/// Nobody shares an answer.
void addApart(std::vector<BenchCase>& cases) {
  cases.push_back({"crowd.lights_anew_apart", "us/object", kPacks * kPackSize, 1e3, "crowd.lights_anew_scaling",
                   [](benchmark::State& state) {
                     CrowdInCity city(100000, placesApart());
                     for (auto _ : state) city.light(true);
                   }});
}

void addPreparation(std::vector<BenchCase>& cases) {
  constexpr int kLamps = 100000;
  cases.push_back({"crowd.lights_prepare", "ns/light", kLamps, 1, "crowd.lights_build", [=](benchmark::State& state) {
                     const LightSet lights = lampCity(kLamps);
                     LightTree tree;
                     tree.build(lights);
                     PreparedLights prepared;
                     for (auto _ : state) CrowdInCity::prepare(lights, tree, prepared);
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
  // Ratios are those of the cost of an object in the small city to that in the large one.
  const auto cities = std::make_shared<Cities>();
  addCity(cases, "crowd.lights_1000", "", cities, 0, false);
  addCity(cases, "crowd.lights_scaling", "crowd.lights_1000", cities, 1, false);
  addCity(cases, "crowd.lights_anew_1000", "", cities, 0, true);
  addCity(cases, "crowd.lights_anew_scaling", "crowd.lights_anew_1000", cities, 1, true);
  addApart(cases);
  addStructure(cases, "crowd.lights_build", 0);
  addPreparation(cases);
  addStructure(cases, "crowd.lights_refit", 1);
  addStructure(cases, "crowd.lights_refit_some", 20);
}

}  // namespace rigel::tools
