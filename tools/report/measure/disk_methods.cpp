#include "report/measure/disk_methods.h"

#include "bench/baselines.h"
#include "report/measure/truth.h"

#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/exact.h>
#include <rigel/near_light.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

using Pair = DiskPairs::Pair;

/// What is true of a pair, of the first colour that shines.
struct PairTruth {
  std::array<double, shCount(kMaxBands)> sh{};
  double norm = 0;        // of sh
  double peak = 0;        // irradiance over all normals: the vector irradiance
  double irradiance = 0;  // Lambert
  int channel = 0;
};

int brightest(Rgb c) { return c.r >= c.g && c.r >= c.b ? 0 : c.g >= c.b ? 1 : 2; }

template <int B>
PairTruth truthOf(const Pair& pair) {
  PairTruth truth;
  truth.channel = brightest(pair.light.radiance);
  std::array<double, 3 * shCount(B)> numbers{};
  projectDiskExact(pair.light, pair.position, B, numbers);
  for (int i = 0; i < shCount(B); ++i) {
    truth.sh[i] = numbers[3 * i + truth.channel];
    truth.norm += truth.sh[i] * truth.sh[i];
  }
  truth.norm = std::sqrt(truth.norm);
  // Y1 = sqrt(3/4pi) w, so that band 1 holds the vector irradiance times that.
  truth.peak = std::sqrt(4 * kPi / 3) * std::hypot(truth.sh[1], std::hypot(truth.sh[2], truth.sh[3]));
  truth.irradiance = exactIrradiance(pair.light, pair.position, pair.normal)[truth.channel];
  return truth;
}

/// Pools relative errors.
class Errors {
 public:
  void add(double error) {
    squares_ += error * error;
    max_ = std::max(max_, std::abs(error));
    ++count_;
  }
  ErrorFigures figures() const { return {count_ > 0 ? std::sqrt(squares_ / count_) : 0, max_}; }

 private:
  double squares_ = 0, max_ = 0;
  int count_ = 0;
};

/// Time of `f(pair)`, the least of several rounds over all pairs: what else runs on the machine only adds.
template <class F>
double nanoseconds(std::span<const Pair> pairs, const F& f) {
  using Clock = std::chrono::steady_clock;
  constexpr int kRounds = 7;
  double least = std::numeric_limits<double>::infinity();
  float sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = Clock::now();
    for (const Pair& pair : pairs) sum += f(pair);
    least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  // Read by nobody, but the compiler does not know.
  [[maybe_unused]] volatile float kept = sum;
  return least / static_cast<double>(pairs.size());
}

template <int B>
class Measurement {
 public:
  explicit Measurement(std::span<const Pair> pairs) {
    for (const Pair& pair : pairs) {
      const PairTruth truth = truthOf<B>(pair);
      if (!(truth.peak > 0)) continue;  // so dim that it is none
      pairs_.push_back(pair);
      truth_.push_back(truth);
    }
  }

  /// A method that gives coefficients; light of negative sum is shaded as none.
  template <class F>
  DiskMethodRow coefficients(std::string method, std::string meaning, const F& project) const {
    Errors sh, irradiance;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const PairTruth& truth = truth_[i];
      const RadianceSH<B> found = project(pairs_[i]);
      double squares = 0;
      for (int k = 0; k < shCount(B); ++k) {
        const double off = static_cast<double>(found[k][truth.channel]) - truth.sh[k];
        squares += off * off;
      }
      sh.add(std::sqrt(squares) / truth.norm);
      const Rgb seen = evaluate(irradianceFromRadiance(found, 0), pairs_[i].normal);
      irradiance.add((std::max(0.0, static_cast<double>(seen[truth.channel])) - truth.irradiance) / truth.peak);
    }
    const double time = nanoseconds(pairs_, [&](const Pair& pair) { return project(pair)[0].r; });
    return {std::move(method), std::move(meaning), sh.figures(), irradiance.figures(), time};
  }

  /// A method that gives irradiance alone.
  template <class F>
  DiskMethodRow light(std::string method, std::string meaning, const F& irradianceOf) const {
    Errors irradiance;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const PairTruth& truth = truth_[i];
      const double found = static_cast<double>(irradianceOf(pairs_[i])[truth.channel]);
      irradiance.add((found - truth.irradiance) / truth.peak);
    }
    const double time = nanoseconds(pairs_, [&](const Pair& pair) { return irradianceOf(pair).r; });
    return {std::move(method), std::move(meaning), std::nullopt, irradiance.figures(), time};
  }

 private:
  std::vector<Pair> pairs_;
  std::vector<PairTruth> truth_;
};

template <int B>
std::vector<DiskMethodRow> measure(std::span<const Pair> pairs) {
  const Measurement<B> at(pairs);
  const auto quadrature = [](DiskNodes nodes) {
    return [nodes](const Pair& pair) { return projectDisk<B>(pair.light, pair.position, nodes); };
  };
  std::vector<DiskMethodRow> rows;
  rows.push_back(at.coefficients("table", "two textures of 32 x 32, float",
                                 [](const Pair& pair) { return DiskTable::project<B>(pair.light, pair.position); }));
  rows.push_back(at.coefficients("quadrature-4", "4 nodes, float", quadrature(DiskNodes::four)));
  rows.push_back(at.coefficients("quadrature-6", "6 nodes, float: what rigs use", quadrature(DiskNodes::six)));
  rows.push_back(at.coefficients("quadrature-8", "8 nodes, float", quadrature(DiskNodes::eight)));
  rows.push_back(at.coefficients("exact", "257 nodes, double: the reference", [](const Pair& pair) {
    std::array<double, 3 * shCount(B)> numbers{};
    projectDiskExact(pair.light, pair.position, B, numbers);
    RadianceSH<B> sh;
    for (int i = 0; i < 3 * shCount(B); ++i) sh[i / 3][i % 3] = static_cast<float>(numbers[i]);
    return sh;
  }));
  const NearWrap lambert = nearWrap();
  rows.push_back(at.light("near", "closed form, float: what near lights use", [&](const Pair& pair) {
    return nearIrradiance(nearLight(pair.light), pair.position, pair.normal, lambert);
  }));
  rows.push_back(at.light("wallace", "Wallace, Elmquist, Haines 1989, as published", [](const Pair& pair) {
    return pair.light.radiance * wallaceIrradiance(pair.light, pair.position, pair.normal);
  }));
  return rows;
}

}  // namespace

void DiskPairs::add(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface,
                    const LightSet& lights) {
  const std::size_t count = surface.measured.size();
  const double each = static_cast<double>(kMost) / static_cast<double>(looks_ * std::max(1, lights.diskCount()));
  for (int i = 0; i < lights.diskCount(); ++i) {
    const DiskLight light = lights.disk(i);
    for (owed_ += each; owed_ >= 1 && pairs_.size() < kMost; --owed_) {
      random_ = random_ * 6364136223846793005ull + 1442695040888963407ull;  // Knuth's constants
      const auto [p, n] = evaluateSurface(object, posed, surface.measured[(random_ >> 33) % count]);
      // Where a disk gives nothing every method is right and quick.
      if (light.radiance[brightest(light.radiance)] > 0 && rigel::detail::localDisk(light, p).lit)
        pairs_.push_back({light, p, n});
    }
  }
}

std::vector<DiskMethodRow> measureDiskMethods(std::span<const Pair> pairs, int bands) {
  if (pairs.empty()) return {};
  return withBands(bands, [&]<int B>() { return measure<B>(pairs); });
}

}  // namespace rigel::tools
