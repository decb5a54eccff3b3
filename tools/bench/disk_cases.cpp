#include "bench/baselines.h"
#include "bench/bench_case.h"
#include "bench/wallace_batch.h"

#include <rigel/disk.h>
#include <rigel/disk_batch.h>
#include <rigel/disk_table.h>
#include <rigel/near_light.h>
#include <rigel/project.h>

#include <memory>

namespace rigel::tools {
namespace {

/// A panel as wide as the body, half a metre above its head and a little to the side: all of the body is lit, from near
/// and at grazing angles.
const DiskLight kPanel{{0.4f, 1.4f, 0.3f}, {-0.1f, -1, 0}, 0.3f, {3, 2, 1}};

/// The body's surface, structure of arrays.
struct BodyRows {
  std::vector<float> x, y, z, nx, ny, nz, irradiance, sh;

  /// Normals of the surface, or such that each point's horizon passes through the middle of the panel.
  explicit BodyRows(bool crossed = false) {
    for (const Vec3 p : bodySurface()) {
      const Vec3 n = crossed ? cross(kPanel.position - p, {0.3f, 0.5f, 0.8f}) : p;
      add(p, n * (1 / length(n)));
    }
    irradiance.resize(x.size());
    sh.resize(25 * x.size());
  }
  Vec3Rows points() const { return {x, y, z}; }
  Vec3Rows normals() const { return {nx, ny, nz}; }

 private:
  void add(Vec3 p, Vec3 n) {
    x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    nx.push_back(n.x), ny.push_back(n.y), nz.push_back(n.z);
  }
};

template <int B>
void addQuadrature(std::vector<BenchCase>& cases, const std::shared_ptr<BodyRows>& body, const std::string& name,
                   DiskNodes nodes) {
  cases.push_back(
      {name, "ns/point", static_cast<double>(body->x.size()), 1, "disk.wallace", [=](benchmark::State& state) {
         const std::span sh(body->sh.data(), B * B * body->x.size());
         for (auto _ : state) {
           projectDiskBatch<B>(kPanel, body->points(), nodes, sh);
           benchmark::DoNotOptimize(body->sh.data());
           benchmark::ClobberMemory();
         }
       }});
}

/// `evaluate(p, n)` at one point after another.
void addScalar(std::vector<BenchCase>& cases, const std::string& name, const std::string& baseline, auto evaluate) {
  const auto points = std::make_shared<std::vector<Vec3>>(bodySurface());
  auto normals = std::make_shared<std::vector<Vec3>>();
  for (const Vec3 p : *points) normals->push_back(p * (1 / length(p)));
  cases.push_back({name, "ns/point", static_cast<double>(points->size()), 1, baseline, [=](benchmark::State& state) {
                     for (auto _ : state)
                       for (std::size_t i = 0; i < points->size(); ++i) {
                         auto result = evaluate((*points)[i], (*normals)[i]);
                         benchmark::DoNotOptimize(result);
                       }
                   }});
}

}  // namespace

void addDiskCases(std::vector<BenchCase>& cases) {
  const auto body = std::make_shared<BodyRows>();
  const double count = static_cast<double>(body->x.size());
  cases.push_back({"disk.wallace", "ns/point", count, 1, "disk.wallace_scalar", [body](benchmark::State& state) {
                     for (auto _ : state) {
                       wallaceBatch(kPanel, body->x, body->y, body->z, body->nx, body->ny, body->nz, body->irradiance);
                       benchmark::DoNotOptimize(body->irradiance.data());
                       benchmark::ClobberMemory();
                     }
                   }});
  for (const bool crossed : {false, true}) {
    const auto rows = crossed ? std::make_shared<BodyRows>(true) : body;
    cases.push_back({crossed ? "disk.exact.horizon" : "disk.exact", "ns/point", count, 1, "disk.wallace",
                     [rows](benchmark::State& state) {
                       for (auto _ : state) {
                         diskIrradianceBatch(kPanel, rows->points(), rows->normals(), rows->irradiance);
                         benchmark::DoNotOptimize(rows->irradiance.data());
                         benchmark::ClobberMemory();
                       }
                     }});
  }
  addQuadrature<3>(cases, body, "disk.quadrature4", DiskNodes::four);
  addQuadrature<3>(cases, body, "disk.quadrature6", DiskNodes::six);
  addQuadrature<3>(cases, body, "disk.quadrature8", DiskNodes::eight);
  addQuadrature<5>(cases, body, "disk.quadrature6.bands5", DiskNodes::six);

  addScalar(cases, "disk.wallace_scalar", "", [](Vec3 p, Vec3 n) { return wallaceIrradiance(kPanel, p, n); });
  addScalar(cases, "disk.project", "disk.wallace_scalar", [](Vec3 p, Vec3) { return project<3>(kPanel, p); });
  addScalar(cases, "disk.table", "disk.wallace_scalar", [](Vec3 p, Vec3) { return DiskTable::project<3>(kPanel, p); });
  addScalar(cases, "disk.near", "disk.wallace_scalar", [light = nearLight(kPanel), wrap = nearWrap()](Vec3 p, Vec3 n) {
    return nearIrradiance(light, p, n, wrap);
  });
}

}  // namespace rigel::tools
