#include "bench/figures.h"

#include "bench/baselines.h"
#include "bench/bench_case.h"

#include <rigel/rig_light.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <regex>
#include <set>

namespace rigel::tools {
namespace {

using Sh = RadianceSH<3>;

// Lights one to ten metres off the body.
LightSet sphereLights(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  LightSet lights;
  while (lights.size() < count) {
    const Vec3 p{10 * unit(random), 10 * unit(random), 10 * unit(random)};
    if (length(p) > 2) lights.add(SphereLight{p, 0.1f + 0.05f * unit(random), {3, 2, 1}});
  }
  return lights;
}

/// A rig of the body under 64 lights.
struct FittedRig {
  std::vector<Vec3> surface = bodySurface();
  RigBox box{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}};
  LightSet lights = sphereLights(64);
  Rig rig;
  std::vector<Vec3> anchors;
  std::vector<Sh> functionals, coefficients;
  std::vector<float> rows[3], up, zero, irradiance;  // of the surface

  explicit FittedRig(const std::string& spec) : rig(*Rig::create(*parseRigSpec(spec), {box, surface})) {
    for (int i : rig.anchors()) anchors.push_back(surface[i]);
    functionals.resize(rig.projections());
    coefficients.resize(rig.shVectors());
    for (const Vec3 p : surface)
      for (int axis = 0; axis < 3; ++axis) rows[axis].push_back(p[axis]);
    up.assign(surface.size(), 1);
    zero.assign(surface.size(), 0);
    irradiance.resize(3 * surface.size());
    fit();
  }
  void fit() {
    rig.setPose({box, anchors});
    projectSamples<3>(rig, {}, lights, functionals);
    fitRig<3>(rig, functionals, coefficients);
  }
};

/// A whole character: refresh, project and fit; and shading it at a point.
void addRigCases(std::vector<BenchCase>& cases) {
  for (const std::string text : {"constant", "gradient", "mixed:l3,g,c", "lattice:3x2x2", "lattice:8x4x2", "poly:6",
                                 "poly:12", "rbf:12", "latticegrad:3x1x1", "hermite:3x1x1"}) {
    const bool isBaseline = text == "constant";
    const auto fitted = std::make_shared<FittedRig>(text);
    cases.push_back(
        {"fit." + text, "us/character", 1, 1e3, isBaseline ? "" : "fit.constant", [fitted](benchmark::State& state) {
           for (auto _ : state) {
             fitted->fit();
             benchmark::DoNotOptimize(fitted->coefficients.data());
           }
         }});
    cases.push_back({"shade." + text, "ns/point", static_cast<double>(fitted->surface.size()), 1,
                     isBaseline ? "" : "shade.constant", [fitted](benchmark::State& state) {
                       const auto f = wrapCoefficients<3>(0);
                       for (auto _ : state)
                         for (Vec3 p : fitted->surface) {
                           Rgb e = irradiance<3>(evaluateRig<3>(fitted->rig, fitted->coefficients, p), f, {0, 1, 0});
                           benchmark::DoNotOptimize(e);
                         }
                     }});
    cases.push_back({"shade.batch." + text, "ns/point", static_cast<double>(fitted->surface.size()), 1, "shade." + text,
                     [fitted](benchmark::State& state) {
                       const auto f = wrapCoefficients<3>(0);
                       const auto& r = fitted->rows;
                       for (auto _ : state) {
                         irradianceBatch<3>(fitted->rig, {}, fitted->coefficients, f, {r[0], r[1], r[2]},
                                            {fitted->zero, fitted->up, fitted->zero}, fitted->irradiance);
                         benchmark::DoNotOptimize(fitted->irradiance.data());
                       }
                     }});
  }
}

std::vector<BenchCase> allCases() {
  std::vector<BenchCase> cases;
  addLimitCases(cases);
  addProjectionCases(cases);
  addRigCases(cases);
  addNearCases(cases);
  addBoundCases(cases);
  addDiskCases(cases);
  addCrowdCases(cases);
  addCrowdLightCases(cases);
  return cases;
}

/// Keeps the CPU times an iteration [ns] of every benchmark, or what it says itself; prints nothing.
class TimesReporter final : public benchmark::BenchmarkReporter {
 public:
  explicit TimesReporter(const std::vector<BenchCase>& cases) {
    for (const BenchCase& c : cases)
      if (c.manualTime) manual_.insert(c.name);
  }
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const std::string& name = run.run_name.function_name;
      const double time = manual_.contains(name) ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime();
      nanoseconds_[name].push_back(time * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit));
    }
  }
  /// The least, which other load disturbs least.
  double least(const std::string& name) const { return *std::ranges::min_element(nanoseconds_.at(name)); }
  double median(const std::string& name) const {
    std::vector<double> times = nanoseconds_.at(name);
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    return times[times.size() / 2];
  }

 private:
  std::set<std::string> manual_;
  std::map<std::string, std::vector<double>> nanoseconds_;
};

}  // namespace

std::vector<Vec3> bodySurface() {
  std::vector<Vec3> points;
  for (int i = 0; i < 600; ++i) {
    const float z = 1 - (2 * static_cast<float>(i) + 1) / 600;
    const float phi = static_cast<float>(i) * 2.3999632f;
    const float s = std::sqrt(1 - z * z);
    points.push_back({0.3f * s * std::cos(phi), 0.9f * z, 0.2f * s * std::sin(phi)});
  }
  return points;
}

Result<std::vector<Figure>> measureFigures(const std::string& filter, int repetitions) {
  std::regex wanted;
  try {
    wanted = std::regex(filter);
  } catch (const std::regex_error&) {
    return Error{"not a regular expression", "--filter " + filter};
  }
  const std::vector<BenchCase> cases = allCases();
  std::map<std::string, bool> selected;
  bool any = false;
  for (const BenchCase& c : cases) {
    if (!std::regex_search(c.name, wanted)) continue;
    any = true;
    selected[c.name] = true;
    if (!c.baseline.empty()) selected.emplace(c.baseline, false);
    if (c.flops > 0) selected.emplace(kPeakFigure, false);
    for (const std::string& name : c.from) selected.emplace(name, false);
  }
  if (!any) return Error{"matches no figure", "--filter " + filter};

  benchmark::ClearRegisteredBenchmarks();
  for (const BenchCase& c : cases) {
    if (!selected.contains(c.name) || c.derive) continue;
    auto* registered = benchmark::RegisterBenchmark(c.name.c_str(), c.body)->Repetitions(repetitions);
    c.manualTime ? registered->UseManualTime()->Iterations(kManualIterations) : registered->MinTime(0.05);
  }
  // Interleaved repetitions: a burst of other load hits figure and baseline alike.
  std::string arguments[] = {"rigel", "--benchmark_enable_random_interleaving=true"};
  char* argv[] = {arguments[0].data(), arguments[1].data()};
  int argc = 2;
  benchmark::Initialize(&argc, argv);
  TimesReporter reporter(cases);
  benchmark::RunSpecifiedBenchmarks(&reporter, ".*");

  std::map<std::string, double> perItem;
  for (const BenchCase& c : cases)
    if (selected.contains(c.name) && !c.derive) perItem[c.name] = reporter.least(c.name) / c.perIteration;
  std::vector<Figure> figures;
  for (const BenchCase& c : cases) {
    if (const auto found = selected.find(c.name); found == selected.end() || !found->second) continue;
    if (c.derive) {
      std::vector<double> times;
      for (const std::string& name : c.from) times.push_back(perItem[name]);
      figures.push_back({c.name, c.derive(times), c.unit, ""});
      continue;
    }
    Figure figure{c.name, perItem[c.name] / c.nanosecondsPerUnit, c.unit, c.baseline};
    figure.median = reporter.median(c.name) / c.perIteration / c.nanosecondsPerUnit;
    if (!c.baseline.empty()) figure.ratio = perItem[c.baseline] / perItem[c.name];
    if (c.flops > 0) figure.limitFraction = c.flops / 1000 * perItem[kPeakFigure] / perItem[c.name];
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace rigel::tools
