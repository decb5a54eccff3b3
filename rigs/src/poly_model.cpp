#include "poly_model.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

using Exponents = std::array<int, 3>;
constexpr int kMaxDegree = 16;

/// Standard deviation of the surface along each axis.
std::array<double, 3> spread(std::span<const Vec3> surface) {
  std::array<double, 3> sigma{};
  for (int a = 0; a < 3; ++a) {
    double mean = 0;
    double square = 0;
    for (Vec3 p : surface) mean += static_cast<double>(p[a]);
    mean /= static_cast<double>(surface.size());
    for (Vec3 p : surface) square += (static_cast<double>(p[a]) - mean) * (static_cast<double>(p[a]) - mean);
    sigma[a] = std::sqrt(square / static_cast<double>(surface.size()));
  }
  return sigma;
}

/// The first K exponents by decreasing prod_a (sigma_a / (3 sigma_max))^e_a; ties by degree, then x before y before z.
std::vector<Exponents> monomialOrder(std::span<const Vec3> surface, int terms) {
  const std::array<double, 3> sigma = spread(surface);
  const double largest = std::max({sigma[0], sigma[1], sigma[2]});
  std::array<double, 3> logScale{};
  // An axis hundreds of times thinner than the longest carries nothing; the floor keeps logarithms finite.
  for (int a = 0; a < 3; ++a) logScale[a] = std::log(std::max(largest > 0 ? sigma[a] / largest : 1.0, 1e-9) / 3);

  std::vector<Exponents> all;
  for (int x = 0; x <= kMaxDegree; ++x)
    for (int y = 0; x + y <= kMaxDegree; ++y)
      for (int z = 0; x + y + z <= kMaxDegree; ++z) all.push_back({x, y, z});
  const auto rank = [&](const Exponents& e) {
    const double score = e[0] * logScale[0] + e[1] * logScale[1] + e[2] * logScale[2];
    return std::tuple(-score, e[0] + e[1] + e[2], -e[0], -e[1]);
  };
  std::ranges::stable_sort(all, {}, rank);
  all.resize(terms);
  return all;
}

// A falloff has ten coefficients of its own; fewer points than this do not tell them from the polynomial's.
constexpr int kFalloffPoints = 24;

/// The function 1 is the first monomial.
std::vector<double> constantTerm(int terms) {
  std::vector<double> constant(terms, 0);
  constant[0] = 1;
  return constant;
}

}  // namespace

Rig::PolyModel::PolyModel(RigSpec s, const RigShape& rest, int pointsPerVector)
    : Model(std::move(s)),
      surfaceFit_(*this, rest.surface, constantTerm(spec.polyTerms),
                  std::max(pointsPerVector * spec.polyTerms, spec.falloff ? kFalloffPoints : 0)) {
  const std::vector<Exponents> order = monomialOrder(rest.surface, spec.polyTerms);
  terms_.push_back({0, 0});
  for (std::size_t k = 1; k < order.size(); ++k) {
    Exponents divisor = order[k];
    int axis = 0;
    while (divisor[axis] == 0) ++axis;
    --divisor[axis];
    const auto from = std::ranges::find(order, divisor) - order.begin();
    terms_.push_back({static_cast<std::int8_t>(from), static_cast<std::int8_t>(axis)});
  }
  u_.resize(samples.size());
  strength_.resize(samples.size());
  q_.resize(samples.size());
}

void Rig::PolyModel::setPose(const RigPose& pose) noexcept {
  box_ = BoxCoordinates(pose.box);
  falloff_.reset();
  surfaceFit_.setPose(*this, pose);
}

void Rig::PolyModel::adapt(std::span<const float> light, int width) noexcept {
  if (!spec.falloff) return;
  const std::size_t colours = static_cast<std::size_t>(std::min(width, 3));
  for (std::size_t s = 0; s < samples.size(); ++s) {
    u_[s] = box_(samples[s].position);
    strength_[s] = 0;
    for (float l : light.subspan(s * static_cast<std::size_t>(width), colours))
      strength_[s] += std::abs(static_cast<double>(l));
  }
  falloff_.fit(u_, surfaceFit_.shares(), strength_);
  for (std::size_t s = 0; s < samples.size(); ++s) q_[s] = falloff_(u_[s]);
  surfaceFit_.rescale(*this, q_);
}

void Rig::PolyModel::basis(Vec3 p, RigBasis& out) const noexcept {
  const Vec3 u = box_(p);
  out.count = static_cast<int>(terms_.size());
  out.index[0] = 0;
  out.value[0] = spec.falloff ? 1 / falloff_(u) : 1;
  for (int k = 1; k < out.count; ++k) {
    out.index[k] = k;
    out.value[k] = out.value[terms_[k].from] * u[terms_[k].axis];
  }
}

}  // namespace rigel
