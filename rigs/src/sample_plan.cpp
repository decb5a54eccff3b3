#include "sample_plan.h"

#include "falloff_weights.h"
#include "poly_model.h"
#include "row_kernels.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

using detail::BoundPlan;
using detail::SamplePlan;

// Between the points probed, weights can be a little larger.
constexpr double kBetweenProbes = 1.2;

// Degrees beyond the span whose error is measured; of the rest only the sum of the weights is known.
constexpr int kLayers = 2;

/// How much stronger a mixed term can be than the product of its axes' strengths: square root of (i+j+k)!/(i! j! k!).
float mixing(const std::array<std::uint8_t, 3>& m) noexcept {
  float product = 1;
  int total = 0;
  for (const int degree : m)
    for (int i = 1; i <= degree; ++i) product *= static_cast<float>(++total) / static_cast<float>(i);
  return std::sqrt(product);
}

}  // namespace

SamplePlanner::SamplePlanner(const Rig& rig) noexcept : rig_(rig) {
  for (int a = 0; a < 3; ++a) {
    const double lo = rig.box().lo[a];
    const double hi = rig.box().hi[a];
    centre_[a] = (lo + hi) / 2;
    inverseHalf_[a] = hi > lo ? 2 / (hi - lo) : 0;
  }
}

bool SamplePlanner::watches(int i, int j, int k) const noexcept {
  if (std::min({i, j, k}) < 0 || std::max({i, j, k}) >= SamplePlan::kMaxDegree) return false;
  return known_[(i * SamplePlan::kMaxDegree + j) * SamplePlan::kMaxDegree + k];
}

void SamplePlanner::watch(int i, int j, int k) noexcept {
  if (watched_ == kMaxWatched || std::max({i, j, k}) >= SamplePlan::kMaxDegree || watches(i, j, k)) return;
  known_[(i * SamplePlan::kMaxDegree + j) * SamplePlan::kMaxDegree + k] = true;
  watch_[watched_++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(k)};
}

void SamplePlanner::watchBeyond() noexcept {
  // Complete layers only: what is watched must hold every divisor of its members.
  for (int layer = 0; layer < kLayers; ++layer) {
    const int before = watched_;
    for (int t = 0; t < before; ++t) {
      const Degrees m = watch_[t];
      for (int a = 0; a < 3; ++a) {
        Degrees next = m;
        ++next[a];
        bool complete = true;
        for (int b = 0; b < 3; ++b)
          complete = complete && (next[b] == 0 || watches(next[0] - (b == 0), next[1] - (b == 1), next[2] - (b == 2)));
        if (complete) watch(next[0], next[1], next[2]);
      }
    }
  }
}

void SamplePlanner::readSpan(BoundPlan& plan) noexcept {
  const RigSpec& spec = rig_.spec();
  if (spec.family == RigSpec::Family::poly) {
    plan.polynomial = true;
    if (spec.falloff) {
      // It spans 1/q times these; what it makes of linear light tells how far it is from that.
      const auto& model = static_cast<const Rig::PolyModel&>(*rig_.model_);
      for (int k = 0; k < rig_.shVectors(); ++k) span_[k] = model.exponents(k);
      for (const int axis : {-1, 0, 1, 2}) watch(axis == 0, axis == 1, axis == 2);
      return;
    }
    // Monomials of box coordinates: at (1/2, 1, 1) they are 2^-(degree of x).
    const RigBox& box = rig_.box();
    std::array<RigBasis, 3> at;
    for (int a = 0; a < 3; ++a) {
      Vec3 p = box.hi;
      p[a] = static_cast<float>(centre_[a] + 0.25 * (static_cast<double>(box.hi[a]) - static_cast<double>(box.lo[a])));
      rig_.basis(p, at[a]);
    }
    const auto degree = [](float value) {
      return value > 0 ? std::clamp(static_cast<int>(std::lround(-std::log2(value))), 0, SamplePlan::kMaxDegree - 1)
                       : 0;
    };
    const auto ratio = [&](int a, int k) { return degree(at[a].value[k] / at[a].value[0]); };
    for (int k = 0; k < at[0].count; ++k) watch(ratio(0, k), ratio(1, k), ratio(2, k));
    return;
  }
  if (spec.family == RigSpec::Family::rbf) {
    // As smooth as polynomials, and what it makes of these tells how far it is from them.
    plan.polynomial = true;
    for (const int axis : {-1, 0, 1, 2}) watch(axis == 0, axis == 1, axis == 2);
    return;
  }
  const auto& axes = rig_.axes();
  const auto nodes = [&](int a) { return axes[a].kind == AxisModel::Kind::lattice ? axes[a].nodes : 1; };
  // Two nodes span the same as a slope, times everything else.
  const bool smooth = spec.kernel != LatticeKernel::smooth && std::max({nodes(0), nodes(1), nodes(2)}) <= 2;
  plan.polynomial = spec.fit == FitMethod::gauss || smooth || nodes(0) * nodes(1) * nodes(2) == 1;
  if (plan.polynomial) {
    for (int x = 0; x < nodes(0); ++x)
      for (int y = 0; y < nodes(1); ++y)
        for (int z = 0; z < nodes(2); ++z) {
          watch(x, y, z);
          for (int a = 0; a < 3; ++a)
            if (axes[a].kind == AxisModel::Kind::gradient) watch(x + (a == 0), y + (a == 1), z + (a == 2));
        }
    return;
  }
  // Piecewise functions: what they reproduce of linear light is enough to see the pull of least squares.
  watch(0, 0, 0);
  for (int a = 0; a < 3; ++a)
    if (axes[a].kind != AxisModel::Kind::constant && spec.kernel != LatticeKernel::smooth)
      watch(a == 0, a == 1, a == 2);
}

/// The weights of the samples in the rig's value at each point.
void SamplePlanner::weightsAt(std::span<const Vec3> points, int samples, float* out) const noexcept {
  const SparseOperator& op = rig_.model_->op;
  const auto vectors = static_cast<std::size_t>(op.rows());
  const auto row = static_cast<std::size_t>(samples);
  RigBasis basis;
  if (vectors <= RigBasis::kCapacity && op.weight.size() == vectors * row) {  // full rows, in order of their columns
    std::array<float, kAtOnce * RigBasis::kCapacity> values{};
    for (std::size_t p = 0; p < points.size(); ++p) {
      rig_.basis(points[p], basis);
      for (int j = 0; j < basis.count; ++j)
        values[p * vectors + static_cast<std::size_t>(basis.index[j])] = basis.value[j];
    }
    rowkernels::multiply(values.data(), points.size(), vectors, op.weight.data(), row, out);
    return;
  }
  std::fill_n(out, points.size() * row, 0.0f);
  for (std::size_t p = 0; p < points.size(); ++p) {
    rig_.basis(points[p], basis);
    for (int j = 0; j < basis.count; ++j) {
      const int k = basis.index[j];
      for (int e = op.rowStart[k]; e < op.rowStart[k + 1]; ++e)
        out[p * row + static_cast<std::size_t>(op.column[e])] += basis.value[j] * op.weight[e];
    }
  }
}

void SamplePlanner::probe(std::span<const Vec3> points, SamplePlan& samples) noexcept {
  for (; !points.empty(); points = points.subspan(std::min(kAtOnce, points.size())))
    probeSome(points.first(std::min(kAtOnce, points.size())), samples);
}

void SamplePlanner::probeSome(std::span<const Vec3> points, SamplePlan& samples) noexcept {
  const auto count = static_cast<std::size_t>(samples.samples);
  std::array<float, kAtOnce * kMax> weights;
  weightsAt(points, samples.samples, weights.data());
  std::array<float, kAtOnce * kMaxWatched> wanted, wrong;
  for (std::size_t p = 0; p < points.size(); ++p) {
    double sum = 0;
    for (std::size_t s = 0; s < count; ++s) {
      const float size = std::abs(weights[p * count + s]);
      sum += static_cast<double>(size);
      samples.sample[s].weight = std::max(samples.sample[s].weight, size);
    }
    lebesgue_ = std::max(lebesgue_, sum);
    valuesAt({points[p].x, points[p].y, points[p].z}, &wanted[p * stride_]);
  }
  rowkernels::subtractProduct(wanted.data(), weights.data(), points.size(), count, atSample_.data(), stride_,
                              wrong.data());
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int t = 0; t < watched_; ++t)
      defect_[t] = std::max(defect_[t], std::abs(wrong[p * stride_ + static_cast<std::size_t>(t)]));
}

/// Of every product that is watched, and zeros up to the stride.
void SamplePlanner::valuesAt(const std::array<float, 3>& p, float* out) const noexcept {
  std::array<std::array<float, SamplePlan::kMaxDegree + 1>, 3> chebyshev;
  for (int a = 0; a < 3; ++a) {
    const auto u = static_cast<float>((static_cast<double>(p[a]) - centre_[a]) * inverseHalf_[a]);
    chebyshev[a][0] = 1;
    chebyshev[a][1] = u;
    for (int m = 2; m <= degree_; ++m) chebyshev[a][m] = 2 * u * chebyshev[a][m - 1] - chebyshev[a][m - 2];
  }
  for (int t = 0; t < watched_; ++t) {
    const Degrees& m = watch_[t];
    out[t] = chebyshev[0][m[0]] * chebyshev[1][m[1]] * chebyshev[2][m[2]];
  }
  std::fill(out + watched_, out + stride_, 0.0f);
}

void SamplePlanner::probeAll(SamplePlan& samples) noexcept {
  const RigBox& box = rig_.box();
  if (rig_.anchors().empty()) {
    // Serves the box.
    std::array<Vec3, 27> grid;
    for (int i = 0; i < 27; ++i) {
      const Vec3 t{static_cast<float>(i % 3) / 2, static_cast<float>(i / 3 % 3) / 2, static_cast<float>(i / 9) / 2};
      grid[i] = {box.lo.x + t.x * (box.hi.x - box.lo.x), box.lo.y + t.y * (box.hi.y - box.lo.y),
                 box.lo.z + t.z * (box.hi.z - box.lo.z)};
    }
    probe(grid, samples);
    return;
  }
  std::array<Vec3, kMax> points;
  for (int i = 0; i < samples.samples; ++i) points[i] = rig_.samples()[i].position;
  probe(std::span(points).first(samples.samples), samples);
  // The first probes are the farthest of each patch; few anchors can afford all.
  constexpr int kAffordable = 24;
  const int affordable = std::min({std::max(samples.samples, kAffordable), samples.probes, kMax});
  for (int i = 0; i < affordable; ++i) points[i] = {samples.probe[i][0], samples.probe[i][1], samples.probe[i][2]};
  probe(std::span(points).first(affordable), samples);
  // The surface touches every face of the box, and along an axis that the rig knows nothing of the error is largest
  // there.
  for (int a = 0; a < 3; ++a) {
    if (spanned_[a]) continue;
    std::array<Vec3, 2> faces;
    faces.fill({static_cast<float>(centre_[0]), static_cast<float>(centre_[1]), static_cast<float>(centre_[2])});
    faces[0][a] = box.lo[a];
    faces[1][a] = box.hi[a];
    probe(faces, samples);
  }
}

int SamplePlanner::errorsOfLinear(const Falloff& falloff, std::span<Degrees> monomials,
                                  std::span<double> coefficients) const noexcept {
  // q times the rig's error about T is q P T - q T: P T of the span, and a cubic.
  const std::span<const float> op = rig_.model_->op.weight;
  const int samples = static_cast<int>(rig_.samples().size());
  int count = 0;
  const auto row = [&](const Degrees& m) {
    int i = 0;
    while (i < count && monomials[i] != m) ++i;
    if (i == count) {
      monomials[count++] = m;
      std::fill_n(&coefficients[i * kLinear], kLinear, 0.0);
    }
    return coefficients.subspan(i * kLinear, kLinear);
  };
  for (int k = 0; k < rig_.shVectors(); ++k) {
    const std::span<double> to = row(span_[k]);
    for (int s = 0; s < samples; ++s)
      for (int t = 0; t < watched_; ++t)
        to[t] += static_cast<double>(op[k * samples + s]) *
                 static_cast<double>(atSample_[static_cast<std::size_t>(s) * stride_ + static_cast<std::size_t>(t)]);
  }
  constexpr std::array<Degrees, 10> kOfFalloff{
      {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
  for (int i = 0; i < 10; ++i) {
    for (int t = 0; t < watched_; ++t) {
      Degrees m = kOfFalloff[i];
      for (int a = 0; a < 3; ++a) m[a] = static_cast<std::uint8_t>(m[a] + watch_[t][a]);
      row(m)[t] -= static_cast<double>(falloff.coefficients()[i]);
    }
  }
  return count;
}

void SamplePlanner::coverFalloff(SamplePlan& samples) noexcept {
  const Falloff& falloff = static_cast<const Rig::PolyModel&>(*rig_.model_).falloff();
  const FalloffWeights bounds(falloff);
  const FalloffWeights::Polynomials<float> weights{std::span(span_).first(rig_.shVectors()), rig_.model_->op.weight,
                                                   samples.samples};
  std::array<Degrees, RigBasis::kCapacity + 20> monomials;
  std::array<double, kLinear * monomials.size()> coefficients;
  const auto count = static_cast<std::size_t>(errorsOfLinear(falloff, monomials, coefficients));
  const FalloffWeights::Polynomials<double> errors{std::span(monomials).first(count), coefficients, kLinear};

  std::array<float, kMax> most{};
  std::array<double, kLinear> defect{};
  const auto cover = [&](const std::array<float, 3>& p) {
    WeightCell cell;
    for (int a = 0; a < 3; ++a) {
      const double u = (static_cast<double>(p[a]) - centre_[a]) * inverseHalf_[a];
      const double reach = static_cast<double>(samples.cover) * inverseHalf_[a];
      const double lo = std::clamp(u - reach, -1.0, 1.0);
      const double hi = std::clamp(u + reach, -1.0, 1.0);
      cell.centre[a] = (lo + hi) / 2;
      cell.half[a] = (hi - lo) / 2;
    }
    const auto matters = [&](const WeightCell& part) {
      std::array<float, kMax> raised = most;
      if (bounds.raise<float>(part, weights, raised) > lebesgue_ || raised != most) return true;
      std::array<double, kLinear> wrong = defect;
      bounds.raise<double>(part, errors, wrong);
      return wrong != defect;
    };
    bounds.divide(cell, matters, [&](const WeightCell& part) {
      lebesgue_ = std::max(lebesgue_, bounds.raise<float>(part, weights, most));
      bounds.raise<double>(part, errors, defect);
    });
  };
  for (int i = 0; i < samples.samples; ++i) cover({samples.sample[i].x, samples.sample[i].y, samples.sample[i].z});
  for (int i = 0; i < samples.probes; ++i) cover(samples.probe[i]);
  for (int i = 0; i < samples.samples; ++i) samples.sample[i].weight = most[i];
  for (int t = 0; t < watched_; ++t) defect_[t] = static_cast<float>(defect[t]);
}

void SamplePlanner::placeProbes(SamplePlan& samples) const noexcept {
  const SurfaceProbes& from = rig_.model_->probes;
  samples.cover = from.cover * from.stretch(rig_.box());
  for (const SurfaceProbes::Probe& probe : std::span(from.probes).first(from.few)) {
    if (samples.probes == SamplePlan::kMaxProbes) break;
    const SamplePlan::Sample& at = samples.sample[probe.anchor];
    const Vec3 p = from.posed(probe, {at.x, at.y, at.z}, rig_.box());
    samples.probe[samples.probes++] = {p.x, p.y, p.z};
  }
}

void SamplePlanner::listBoundary(SamplePlan& samples) const noexcept {
  // A staircase that covers every product not watched: all of higher degree in z than column (i, j) holds, and so on.
  const auto add = [&](int i, int j, int k) {
    if (samples.terms == SamplePlan::kMaxTerms) return;
    const Degrees m{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(k)};
    samples.term[samples.terms++] = {m, static_cast<float>(1 + lebesgue_) * mixing(m), false};
  };
  int i = 0;
  for (; watches(i, 0, 0); ++i) {
    int j = 0;
    for (; watches(i, j, 0); ++j) {
      int k = 0;
      while (watches(i, j, k)) ++k;
      add(i, j, k);
    }
    add(i, j, 0);
  }
  add(i, 0, 0);
}

bool SamplePlanner::plan(BoundPlan& plan, SamplePlan& samples) noexcept {
  const std::span<const RigSample> from = rig_.samples();
  if (from.size() > kMax) return false;
  samples.samples = static_cast<int>(from.size());
  for (std::size_t s = 0; s < from.size(); ++s) {
    const Vec3 p = from[s].position;
    samples.sample[s] = {p.x, p.y, p.z, from[s].footprint, 0};
    samples.footprint = std::max(samples.footprint, from[s].footprint);
  }
  if (!rig_.anchors().empty()) placeProbes(samples);
  readSpan(plan);
  if (rig_.spec().family != RigSpec::Family::rbf) spanned_ = {watches(1, 0, 0), watches(0, 1, 0), watches(0, 0, 1)};
  plan.linear = spanned_[0] && spanned_[1] && spanned_[2] && !rig_.spec().falloff;
  if (plan.polynomial && !rig_.spec().falloff) watchBeyond();
  for (int t = 0; t < watched_; ++t) degree_ = std::max<int>(degree_, std::ranges::max(watch_[t]));
  samples.degree = std::min(degree_ + 1, SamplePlan::kMaxDegree);
  stride_ = rowkernels::padded(static_cast<std::size_t>(watched_));
  for (int i = 0; i < samples.samples; ++i) {
    const SamplePlan::Sample& at = samples.sample[i];
    valuesAt({at.x, at.y, at.z}, &atSample_[static_cast<std::size_t>(i) * stride_]);
  }
  const auto between = rig_.spec().falloff ? 1.0f : static_cast<float>(kBetweenProbes);
  if (rig_.spec().falloff) {
    coverFalloff(samples);
  } else {
    probeAll(samples);
    lebesgue_ *= static_cast<double>(between);
  }
  plan.lebesgue = lebesgue_;
  plan.offset = defect_[0] > 1e-4f ? static_cast<double>(defect_[0]) : 0.0;
  if (plan.polynomial) listBoundary(samples);
  for (int t = 0; t < watched_ && samples.terms < SamplePlan::kMaxTerms; ++t)
    samples.term[samples.terms++] = {watch_[t], between * defect_[t] * mixing(watch_[t]), true};
  return true;
}

}  // namespace rigel
