#include "poly_model.h"

#include "basis_rows.h"
#include "monomials.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

/// The function 1 is the first monomial.
std::vector<double> constantTerm(int terms) {
  std::vector<double> constant(terms, 0);
  constant[0] = 1;
  return constant;
}

}  // namespace

Rig::PolyModel::PolyModel(RigSpec s, const RigShape& rest, const Anchors& chosen)
    : Model(std::move(s)), surfaceFit_(*this, chosen, constantTerm(spec.terms)) {
  const std::vector<Exponents> order = monomialOrder(spreadOf(rest.surface), spec.terms);
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

void Rig::PolyModel::basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept {
  const std::size_t n = points.size();
  BoxCoordinates::Rows u;
  box_.rows(points, u);
  const auto row = [&](int k) { return values.data() + static_cast<std::size_t>(k) * n; };
  if (count > 0) {
    std::fill_n(row(0), n, 1.0f);
    if (spec.falloff)
      for (std::size_t i = 0; i < n; ++i) row(0)[i] = 1 / falloff_({u[0][i], u[1][i], u[2][i]});
  }
  for (int k = 1; k < count; ++k) basisrows::multiply(row(terms_[k].from), u[terms_[k].axis].data(), n, row(k));
}

}  // namespace rigel
