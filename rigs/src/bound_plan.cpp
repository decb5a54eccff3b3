#include "bound_plan.h"

#include "interpolation_bound.h"
#include "sample_plan.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace rigel {
namespace {

using detail::BoundPlan;

// Of the interpolation error on a lattice axis of spacing D: per D times the slope, and per D^2 times the curvature
// (Peano's constants), and the largest sum of |weights|. Smoothstep weights differ from linear ones by at most .0963.
struct KernelConstants {
  double first, second, lebesgue;
  double kink = 0.25;  // per D times a jump of the slope
};
constexpr KernelConstants constantsOf(LatticeKernel kernel, int nodes) noexcept {
  if (kernel == LatticeKernel::smooth) return {0.0963, 0.125, 1};
  if (kernel == LatticeKernel::cubic && nodes > 2)
    return nodes == 3 ? KernelConstants{0, 0.1321, 1.1482, 0.27} : KernelConstants{0, 0.1407, 1.25, 0.27};
  return {0, 0.125, 1};
}

double normOf(const AxisModel& model, LatticeKernel kernel) noexcept {
  return model.kind == AxisModel::Kind::lattice ? constantsOf(kernel, model.nodes).lebesgue : 1;
}

void planAxis(BoundPlan::Axis& axis, const AxisModel& model, const RigSpec& spec, double& lebesgue) noexcept {
  switch (model.kind) {
    case AxisModel::Kind::constant:
      axis.first = axis.half;
      return;
    case AxisModel::Kind::gradient:
      axis.gradient = axis.reach = axis.half;
      axis.node = spec.fit == FitMethod::numeric ? kSecant * axis.half : 0;
      return;
    case AxisModel::Kind::lattice:
      const KernelConstants k = constantsOf(spec.kernel, model.nodes);
      const double spacing = 2 * axis.half / (model.nodes - 1);
      axis.node = axis.half;
      axis.first = lebesgue * k.first * spacing;
      axis.second = lebesgue * k.second * spacing * spacing;
      axis.kink = lebesgue * k.kink * spacing;
      lebesgue *= k.lebesgue;
  }
}

// latticegrad, with E the blend's mean over nodes and delta = p - x_k: sum_k b_k |delta H delta|/2, and E delta_a^2 is
// at most D^2/4, of smoothstep weights too.
void planExpansions(BoundPlan& plan, const std::array<AxisModel, 3>& models) noexcept {
  for (int a = 0; a < 3; ++a) {
    BoundPlan::Axis& axis = plan.axis[a];
    const bool lattice = models[a].kind == AxisModel::Kind::lattice;
    axis.node = lattice ? axis.half : 0;
    axis.spacing = lattice ? 2 * axis.half / (models[a].nodes - 1) : 0;
    axis.gradient = axis.reach = axis.kink = lattice ? axis.spacing / 2 : axis.half;
  }
}

// hermite, with E = I - L and h = I - H of an axis: I - P = sum_a h_a L_b L_c + E_x E_y + E_x L_y E_z + L_x E_y E_z.
// |h| <= D^2/16 of the curvature (Peano), |E_a E_b| <= (D_a/2)(D_b/2) of the mixed derivative, which is at most the
// mean of the curvatures along a and b. Along an axis of one node L is its value and H its expansion.
void planHermite(BoundPlan& plan, const std::array<AxisModel, 3>& models) noexcept {
  constexpr double kKink = 0.148;       // of h, per D times a jump of the slope; of E it is 1/4
  constexpr double kLebesgue = 1.0222;  // of the values' weights
  std::array<double, 3> first{};        // E per slope
  for (int a = 0; a < 3; ++a) {
    const bool lattice = models[a].kind == AxisModel::Kind::lattice;
    first[a] = lattice ? plan.axis[a].half / (models[a].nodes - 1) : plan.axis[a].half;
  }
  for (int a = 0; a < 3; ++a) {
    BoundPlan::Axis& axis = plan.axis[a];
    const bool lattice = models[a].kind == AxisModel::Kind::lattice;
    const double others = first[0] + first[1] + first[2] - first[a];
    axis.node = lattice ? axis.half : 0;
    axis.spacing = lattice ? 2 * first[a] : 0;
    axis.gradient = lattice ? first[a] / 2 : first[a];
    axis.second = first[a] * (first[a] / (lattice ? 4 : 2) + others / 2);
    // Each of the three products counts with its first axis, and with the norm 2 of the other.
    axis.kink = first[a] * (lattice ? 2 * kKink + 1 : 3);
  }
  plan.lebesgue = kLebesgue;
}

bool all(const std::array<AxisModel, 3>& models, AxisModel::Kind kind) noexcept {
  return std::ranges::all_of(models, [&](const AxisModel& m) { return m.kind == kind; });
}

void planTensor(BoundPlan& plan, const std::array<AxisModel, 3>& models, const RigSpec& spec) noexcept {
  // The operators of the axes are applied one after another, and each error counts with the norms of those before it:
  // the smallest norms first.
  std::array<int, 3> order{0, 1, 2};
  // Not stable_sort, which allocates.
  std::ranges::sort(order, {}, [&](int a) { return std::pair(normOf(models[a], spec.kernel), a); });
  for (const AxisModel::Kind kind : {AxisModel::Kind::lattice, AxisModel::Kind::constant, AxisModel::Kind::gradient})
    for (const int a : order)
      if (models[a].kind == kind) planAxis(plan.axis[a], models[a], spec, plan.lebesgue);
  for (BoundPlan::Axis& axis : plan.axis) {
    axis.gradient *= plan.lebesgue;
    if (axis.gradient > 0) axis.kink = axis.gradient;
    if (axis.node == 0) axis.first *= plan.lebesgue;
  }
}

}  // namespace

BoundPlan boundPlan(const Rig& rig, float radius, detail::SamplePlan& samples) noexcept {
  BoundPlan plan;
  const RigSpec& spec = rig.spec();
  const RigBox& box = rig.box();
  double diagonal = 0;
  for (int a = 0; a < 3; ++a) {
    const double lo = box.lo[a];
    const double hi = box.hi[a];
    plan.centre[a] = (lo + hi) / 2;
    plan.axis[a].half = (hi - lo) / 2;
    diagonal += plan.axis[a].half * plan.axis[a].half;
  }
  plan.radius = std::min<double>(std::sqrt(diagonal), radius >= 0 ? radius : kNoRange);

  const auto& models = rig.axes();
  const bool expansions = all(models, AxisModel::Kind::gradient);  // of one node, hermite is that too
  if (spec.family == RigSpec::Family::hermite && !expansions) {
    planHermite(plan, models);
  } else if (spec.family == RigSpec::Family::hermite || spec.family == RigSpec::Family::latticegrad) {
    planExpansions(plan, models);
  } else {
    planTensor(plan, models, spec);
  }
  for (const BoundPlan::Axis& axis : plan.axis) plan.gradients += axis.gradient > 0;
  plan.numeric = spec.fit == FitMethod::numeric;
  const bool anchored = spec.family == RigSpec::Family::poly || spec.family == RigSpec::Family::rbf;
  const bool nodal = !anchored && (spec.fit == FitMethod::corners || plan.numeric);
  if (!nodal) {
    plan.kind = BoundPlan::Kind::samples;
    plan.lebesgue = 1;
    [[maybe_unused]] const bool held = SamplePlanner(rig).plan(plan, samples);
    assert(held);  // Rig::create takes no more samples
    return plan;
  }
  plan.constant = all(models, AxisModel::Kind::constant);
  if (plan.constant || expansions) plan.kind = BoundPlan::Kind::ball;
  // Secants along the axes reach no corner.
  if (plan.numeric && plan.kind == BoundPlan::Kind::ball)
    plan.nodeRadius = std::max({plan.axis[0].node, plan.axis[1].node, plan.axis[2].node});
  return plan;
}

}  // namespace rigel
