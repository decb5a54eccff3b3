#include "bound_plan.h"

#include "interpolation_bound.h"
#include "sample_plan.h"

#include <algorithm>
#include <array>
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
      axis.gradient = axis.half;
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
  // The operators of the axes are applied one after another, and each error counts with the norms of those before it:
  // the smallest norms first.
  std::array<int, 3> order{0, 1, 2};
  // Not stable_sort, which allocates.
  std::ranges::sort(order, {}, [&](int a) { return std::pair(normOf(models[a], spec.kernel), a); });
  for (const AxisModel::Kind kind : {AxisModel::Kind::lattice, AxisModel::Kind::constant, AxisModel::Kind::gradient})
    for (const int a : order)
      if (models[a].kind == kind) planAxis(plan.axis[a], models[a], spec, plan.lebesgue);
  for (BoundPlan::Axis& axis : plan.axis) {
    plan.gradients += axis.gradient > 0;
    axis.gradient *= plan.lebesgue;
    if (axis.gradient > 0) axis.kink = axis.gradient;
    if (axis.node == 0) axis.first *= plan.lebesgue;
  }
  plan.numeric = spec.fit == FitMethod::numeric;
  const bool nodal = spec.family == RigSpec::Family::tensor && (spec.fit == FitMethod::corners || plan.numeric);
  if (!nodal) {
    plan.kind = BoundPlan::Kind::samples;
    plan.lebesgue = 1;
    SamplePlanner(rig).plan(plan, samples);
    return plan;
  }
  const auto all = [&](AxisModel::Kind kind) {
    return std::ranges::all_of(models, [&](const AxisModel& m) { return m.kind == kind; });
  };
  plan.constant = all(AxisModel::Kind::constant);
  if (plan.constant || all(AxisModel::Kind::gradient)) plan.kind = BoundPlan::Kind::ball;
  // Secants along the axes reach no corner.
  if (plan.numeric && plan.kind == BoundPlan::Kind::ball)
    plan.nodeRadius = std::max({plan.axis[0].node, plan.axis[1].node, plan.axis[2].node});
  return plan;
}

}  // namespace rigel
