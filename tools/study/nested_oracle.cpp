#include "study/nested_oracle.h"

#include "nested_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rigel::tools {
namespace {

constexpr int kWidth = 27;
constexpr int kRankVectors = 6;

float nanoseconds(const CostModel& cost, int vectors, int near, bool high) {
  return (vectors > 0 ? cost.base : 0) + cost.vector * static_cast<float>(vectors) + (near > 0 ? cost.anyNear : 0) +
         cost.nearLight * static_cast<float>(near) + (high ? cost.highBand : 0);
}

}  // namespace

NestedOracle::NestedOracle(const StudyFrame& frame, const Rig& rig, float wrap)
    : frame_(frame), vectors_(rig.shVectors()), lights_(frame.lights->set.size()), row_(frame.row()) {
  const auto samples = rig.samples();
  const int points = static_cast<int>(samples.size());
  NestedFit fit(points, vectors_);
  std::vector<float> shares;
  RigBasis phi;
  for (int s = 0; s < points; ++s) {
    rig.basis(samples[s].position, phi);
    std::ranges::fill(fit.row(s), 0.0);
    for (int j = 0; j < phi.count; ++j) fit.row(s)[phi.index[j]] = static_cast<double>(phi.value[j]);
    shares.push_back(samples[s].share);
  }
  fit.factor(shares);

  rig_.assign((vectors_ + 1) * lights_ * row_, 0);
  high_.assign(lights_ * row_, 0);
  corrector_.assign(lights_ * row_, 0);
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  const float f4 = wrapCoefficients<5>(wrap)[4];
  std::vector<float> values(points * kWidth), coefficients(vectors_ * kWidth), rest(points * kWidth);
  std::vector<RadianceSH<3>> given(vectors_);
  for (int i = 0; i < lights_; ++i) {
    std::array<Rgb, 9> band4{};
    for (int s = 0; s < points; ++s) {
      const Vec3 p = frame.frame.point(samples[s].position);
      frame.lights->set.visit(i, [&](const auto& light) {
        const RadianceSH<5> sh = project<5>(light, p, samples[s].footprint);
        for (int j = 0; j < kWidth; ++j) values[s * kWidth + j] = std::sqrt(shares[s]) * sh.data()[j];
        for (int m = 0; m < 9; ++m) band4[m] += sh[16 + m] * shares[s];
      });
    }
    const NearLight near = frame.lights->set.visit(i, [](const auto& light) { return nearLight(light); });
    for (std::size_t p = 0; p < frame.points.size(); ++p) {
      const Rgb e = correctorIrradiance(near, frame.points[p].position, frame.points[p].normal, nearWrap(wrap));
      for (int c = 0; c < 3; ++c) corrector_[i * row_ + 3 * p + c] = e[c];
    }
    fit.analyse(values.data(), kWidth, coefficients.data(), rest.data());
    for (int j = 1; j <= vectors_; ++j) {
      std::vector<float> only(j, 0);
      only[j - 1] = 1;
      fit.synthesise(coefficients.data(), kWidth, kWidth, only, given[0].data());
      const float* before = &rig_[((j - 1) * lights_ + i) * row_];
      float* now = &rig_[(j * lights_ + i) * row_];
      for (std::size_t p = 0; p < frame.points.size(); ++p) {
        rig.basis(frame.frame.inversePoint(frame.points[p].position), phi);
        RadianceSH<3> sum;
        for (int k = 0; k < j; ++k) sum += given[k] * phi.value[k];
        const Rgb e = irradiance<3>(sum, f, frame.points[p].normal);
        for (int c = 0; c < 3; ++c) now[3 * p + c] = before[3 * p + c] + e[c];
      }
    }
    for (std::size_t p = 0; p < frame.points.size(); ++p) {
      float y[25];
      shBasis<5>(frame.points[p].normal, y);
      for (int m = 0; m < 9; ++m)
        for (int c = 0; c < 3; ++c)
          high_[i * row_ + 3 * p + c] += static_cast<float>(kPi) * f4 * y[16 + m] * band4[m][c];
    }
  }

  exact_.assign(row_, 0);
  std::vector<double> spatial(lights_, 0), total(lights_, 0);
  const int rank = std::min(kRankVectors, vectors_);
  for (int i = 0; i < lights_; ++i)
    for (std::size_t p = 0; p < row_; ++p) {
      const double e = static_cast<double>(rigRow(rank, i)[p]);
      const double exact = static_cast<double>(frame.exact[i * row_ + p]);
      spatial[i] += std::pow(e - static_cast<double>(frame.sh[i * row_ + p]), 2);
      total[i] += std::pow(e - exact, 2);
      exact_[p] += exact;
    }
  spatialOrder_.resize(lights_);
  std::iota(spatialOrder_.begin(), spatialOrder_.end(), 0);
  totalOrder_ = spatialOrder_;
  std::ranges::sort(spatialOrder_, [&](int a, int b) { return spatial[a] > spatial[b]; });
  std::ranges::sort(totalOrder_, [&](int a, int b) { return total[a] > total[b]; });
}

std::span<const float> NestedOracle::rigRow(int vectors, int light) const {
  return {&rig_[(static_cast<std::size_t>(vectors) * lights_ + light) * row_], row_};
}

double NestedOracle::spatialSquare(int vectors, int nearLights) const {
  std::vector<double> error(row_, 0);
  for (int i = nearLights; i < lights_; ++i) {
    const int light = spatialOrder_[i];
    const auto rig = rigRow(vectors, light);
    for (std::size_t p = 0; p < row_; ++p)
      error[p] += static_cast<double>(rig[p]) - static_cast<double>(frame_.sh[light * row_ + p]);
  }
  return std::inner_product(error.begin(), error.end(), error.begin(), 0.0) / static_cast<double>(row_);
}

double NestedOracle::totalSquare(int vectors, int nearLights, bool highBand, int correctors) const {
  std::vector<double> far(row_, 0), near(row_, 0);
  for (int i = 0; i < lights_; ++i) {
    const int light = totalOrder_[i];
    for (std::size_t p = 0; p < row_; ++p) {
      if (i < nearLights) {
        near[p] += static_cast<double>(frame_.exact[light * row_ + p]);
        continue;
      }
      far[p] += static_cast<double>(rigRow(vectors, light)[p]);
      if (highBand) far[p] += static_cast<double>(high_[light * row_ + p]);
      if (i < nearLights + correctors) far[p] += static_cast<double>(corrector_[light * row_ + p]);
    }
  }
  double sum = 0;
  for (std::size_t p = 0; p < row_; ++p) sum += std::pow(std::max(0.0, far[p]) + near[p] - exact_[p], 2);
  return sum / static_cast<double>(row_);
}

OracleChoice NestedOracle::cheapestSpatial(double target, const CostModel& cost) const {
  OracleChoice best{0, lights_, false, 0, nanoseconds(cost, 0, lights_, false)};  // every light exact
  for (int near = 0; near < lights_; ++near)
    for (int vectors = 1; vectors <= vectors_; ++vectors) {
      const float ns = nanoseconds(cost, vectors, near, false);
      if (ns < best.nanoseconds && spatialSquare(vectors, near) <= target * target)
        best = {vectors, near, false, 0, ns};
    }
  return best;
}

OracleChoice NestedOracle::cheapestTotal(double target, const CostModel& cost, OracleTools tools) const {
  OracleChoice best{0, lights_, false, 0, nanoseconds(cost, 0, lights_, false)};
  for (int near = 0; near < lights_; ++near)
    for (int vectors = 1; vectors <= vectors_; ++vectors)
      for (int correctors = 0; correctors <= std::min(tools.correctors, lights_ - near); ++correctors)
        for (int high = 0; high <= (tools.highBand && correctors == 0 ? 1 : 0); ++high) {
          const float ns =
              nanoseconds(cost, vectors, near, high == 1) + kCorrectorNanoseconds * static_cast<float>(correctors);
          if (ns < best.nanoseconds && totalSquare(vectors, near, high == 1, correctors) <= target * target)
            best = {vectors, near, high == 1, correctors, ns};
        }
  return best;
}

int NestedOracle::mergeable(int nearLights, double spread) const {
  std::vector<Vec3> groups;
  int merged = 0;
  for (int i = 0; i < nearLights; ++i) {
    const bool directional = totalOrder_[i] < frame_.lights->set.directionalCount();
    if (directional) continue;
    const Vec3 at =
        frame_.lights->set.visit(totalOrder_[i], [](const auto& light) { return nearLight(light).position; });
    float distance = std::numeric_limits<float>::infinity();
    for (const PointAndNormal& point : frame_.points) distance = std::min(distance, length(point.position - at));
    const auto close = [&](Vec3 group) {
      return static_cast<double>(length(group - at)) <= 2 * spread * static_cast<double>(distance);
    };
    if (std::ranges::any_of(groups, close)) {
      ++merged;
    } else {
      groups.push_back(at);
    }
  }
  return merged;
}

}  // namespace rigel::tools
