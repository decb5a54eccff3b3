#include "bench/baselines.h"
#include "bench/bench_case.h"
#include "bench/machine_limits.h"

#include <rigel/project_batch.h>

#include <memory>
#include <random>

namespace rigel::tools {
namespace {

using Sh = RadianceSH<3>;

/// Sample points of four characters of twelve: what a crowd's vectors are filled with.
constexpr std::size_t kPoints = 48;

/// Floating-point operations a light and point take, as counted once for spheres and 3 bands of RGB: 54 and 162 of them
/// into the sums. The same numbers for all kinds, so that fractions compare times.
constexpr double kValueFlops = 94, kGradientFlops = 351;

enum class Lights { sphere, largeSphere, point, windowedPoint, spot, strewnSpot, directional };

/// Two to seventeen metres off the body. Spots shine at it or half past it; strewn ones at any place among them.
LightSet lightsAround(Lights kind, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  LightSet lights;
  while (lights.size() < count) {
    const Vec3 p{10 * unit(random), 10 * unit(random), 10 * unit(random)};
    if (length(p) < 2) continue;
    const float size = unit(random);
    const Rgb colour{3, 2, 1};
    switch (kind) {
      case Lights::sphere:
        lights.add(SphereLight{p, 0.1f + 0.05f * size, colour});
        break;
      case Lights::largeSphere:
        lights.add(SphereLight{p, 0.6f + 0.2f * size, colour});
        break;
      case Lights::point:
        lights.add(PointLight{p, colour});
        break;
      case Lights::windowedPoint:
        lights.add(PointLight{p, colour, kDefaultPointRadius, 20});
        break;
      case Lights::spot:
        lights.add(SpotLight{p, Vec3{2 * size, size, -size} - p, colour, 0.3f, 0.6f});
        break;
      case Lights::strewnSpot:
        lights.add(SpotLight{p, Vec3{10 * unit(random), 10 * unit(random), 10 * unit(random)} - p, colour, 0.3f, 0.6f});
        break;
      case Lights::directional:
        lights.add(DirectionalLight{-p, colour});
        break;
    }
  }
  return lights;
}

/// Lights at the body's points, and room for their sums.
struct Batch {
  LightSet lights;
  PreparedLights prepared;
  std::vector<Vec3> points;
  std::vector<float> x, y, z, sums;

  Batch(Lights kind, int count) : lights(lightsAround(kind, count)) {
    prepared.set(lights);
    points = bodySurface();
    std::shuffle(points.begin(), points.end(), std::mt19937(7));
    points.resize(kPoints);
    for (const Vec3 p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    sums.resize(4 * 27 * kPoints);
  }
  Vec3Rows rows() const { return {x, y, z}; }
  double items() const { return static_cast<double>(prepared.all().size() * points.size()); }
};

void addTextbook(std::vector<BenchCase>& cases, const std::shared_ptr<Batch>& batch, const std::string& suffix) {
  cases.push_back({"project.textbook" + suffix, "ns/light/point", batch->items(), 1, "", [batch](auto& state) {
                     for (auto _ : state)
                       for (const Vec3 p : batch->points) {
                         Sh sum;
                         for (int i = 0; i < batch->lights.sphereCount(); ++i)
                           projectSphereTextbook(batch->lights.sphere(i), p, sum);
                         benchmark::DoNotOptimize(sum);
                       }
                   }});
  cases.push_back({"project.textbook_gradient" + suffix, "ns/light/point", batch->items(), 1, "", [batch](auto& state) {
                     constexpr float kStep = 1e-3f;
                     for (auto _ : state)
                       for (const Vec3 p : batch->points) {
                         Sh value;
                         RadianceShGradient<3> gradient;
                         for (int i = 0; i < batch->lights.sphereCount(); ++i)
                           projectSphereTextbookGradient(batch->lights.sphere(i), p, kStep, value, gradient);
                         benchmark::DoNotOptimize(value);
                         benchmark::DoNotOptimize(gradient);
                       }
                   }});
}

/// One light and one point at a time.
void addScalar(std::vector<BenchCase>& cases, const std::shared_ptr<Batch>& batch, const std::string& suffix) {
  cases.push_back({"project.scalar" + suffix, "ns/light/point", batch->items(), 1, "project.textbook" + suffix,
                   [batch](auto& state) {
                     for (auto _ : state)
                       for (const Vec3 p : batch->points) {
                         Sh sum = project<3>(batch->lights, p);
                         benchmark::DoNotOptimize(sum);
                       }
                   }});
}

void addBatch(std::vector<BenchCase>& cases, const std::shared_ptr<Batch>& batch, const std::string& name,
              const std::string& baseline) {
  BenchCase value{name, "ns/light/point", batch->items(), 1, baseline, [batch](auto& state) {
                    const auto sums = std::span(batch->sums).first(27 * kPoints);
                    for (auto _ : state) {
                      projectBatch<3>(batch->prepared, batch->prepared.all(), batch->rows(), {}, sums);
                      benchmark::DoNotOptimize(batch->sums.data());
                      benchmark::ClobberMemory();
                    }
                  }};
  value.flops = kValueFlops;
  cases.push_back(std::move(value));
}

void addGradient(std::vector<BenchCase>& cases, const std::shared_ptr<Batch>& batch, const std::string& name,
                 const std::string& baseline) {
  BenchCase both{name, "ns/light/point", batch->items(), 1, baseline, [batch](auto& state) {
                   for (auto _ : state) {
                     projectBatchWithGradient<3>(batch->prepared, batch->prepared.all(), batch->rows(), batch->sums);
                     benchmark::DoNotOptimize(batch->sums.data());
                     benchmark::ClobberMemory();
                   }
                 }};
  both.flops = kGradientFlops;
  cases.push_back(std::move(both));
}

}  // namespace

void addLimitCases(std::vector<BenchCase>& cases) {
  constexpr double kFlops = 1e6;
  cases.push_back({kPeakFigure, "ns/kflop", kFlops / 1000, 1, "", [](auto& state) {
                     for (auto _ : state) {
                       auto done = multiplyAdds(kFlops);
                       benchmark::DoNotOptimize(done);
                     }
                   }});
  constexpr std::size_t kNumbers = 16 << 20;
  const auto numbers = std::make_shared<std::vector<float>>();  // made when they are first needed
  cases.push_back({"limit.memory", "ns/kB", 12 * static_cast<double>(kNumbers) / 1000, 1, "", [numbers](auto& state) {
                     numbers->resize(2 * kNumbers);
                     const std::span all(*numbers);
                     for (auto _ : state) {
                       addScaled(all.first(kNumbers), 0.5f, all.last(kNumbers));
                       benchmark::ClobberMemory();
                     }
                   }});
}

void addProjectionCases(std::vector<BenchCase>& cases) {
  for (const int n : {8, 64, 1024}) {
    const std::string suffix = ".n" + std::to_string(n);
    const auto spheres = std::make_shared<Batch>(Lights::sphere, n);
    addTextbook(cases, spheres, suffix);
    addScalar(cases, spheres, suffix);
    addBatch(cases, spheres, "project.sphere" + suffix, "project.textbook" + suffix);
    addGradient(cases, spheres, "project.sphere_gradient" + suffix, "project.textbook_gradient" + suffix);
  }
  const std::pair<const char*, Lights> kinds[] = {
      {"large_sphere", Lights::largeSphere},     {"point", Lights::point},
      {"windowed_point", Lights::windowedPoint}, {"spot", Lights::spot},
      {"strewn_spot", Lights::strewnSpot},       {"directional", Lights::directional}};
  for (const auto& [name, kind] : kinds) {
    const auto batch = std::make_shared<Batch>(kind, 64);
    addBatch(cases, batch, "project." + std::string(name) + ".n64", "project.sphere.n64");
    addGradient(cases, batch, "project." + std::string(name) + "_gradient.n64", "project.sphere_gradient.n64");
  }
}

}  // namespace rigel::tools
