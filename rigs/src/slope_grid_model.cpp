#include "slope_grid_model.h"

#include "box_axes.h"
#include "lattice_kernel.h"

namespace rigel {
namespace {

constexpr int kPerNode = 4;  // value and three slopes

}  // namespace

Rig::SlopeGridModel::SlopeGridModel(RigSpec s, const RigShape& rest) : Model(std::move(s)) {
  const std::array<int, 3> order = spec.pinnedAxes ? std::array{0, 1, 2} : axesByExtent(rest.box);
  for (int i = 0; i < 3; ++i) axes[order[i]] = spec.axes[i];
  int count = 1;
  for (int a = 0; a < 3; ++a) {
    nodes_[a] = axes[a].nodes;
    if (nodes_[a] == 1) axes[a].kind = AxisModel::Kind::gradient;
    stride_[a] = count;
    count *= nodes_[a];
  }
  samples.assign(count, RigSample{{}, 3, {}});
  functionals = kPerNode * count;
  for (int k = 0; k < functionals; ++k) {
    op.addEntry(k, 1);
    op.endRow();
  }
}

void Rig::SlopeGridModel::setPose(const RigPose& pose) noexcept {
  box_ = BoxCoordinates(pose.box);
  // Slopes are per spacing (per half extent along an axis of one node): coefficients have the units of the value.
  std::array<Vec3, 3> step;
  for (int a = 0; a < 3; ++a)
    step[a] = unit(a) * (box_.half[a] * (nodes_[a] > 1 ? 2 / static_cast<float>(nodes_[a] - 1) : 1));
  for (std::size_t n = 0; n < samples.size(); ++n) {
    RigSample& sample = samples[n];
    sample.position = box_.centre;
    for (int a = 0; a < 3; ++a) {
      const int i = static_cast<int>(n) / stride_[a] % nodes_[a];
      if (nodes_[a] > 1)
        sample.position[a] += box_.half[a] * (2 * static_cast<float>(i) / static_cast<float>(nodes_[a] - 1) - 1);
      sample.directions[a] = step[a];
    }
  }
}

auto Rig::SlopeGridModel::termsOf(int a, float u) const noexcept -> AxisTerms {
  AxisTerms out;
  if (nodes_[a] == 1) {
    out.slope[0] = u;
    return out;
  }
  const AxisWeights linear = axisWeights(LatticeKernel::linear, nodes_[a], u);
  const float t = linear.weight[1];
  const float back = linear.weight[0];
  out.first = linear.first;
  out.count = 2;
  if (spec.family == RigSpec::Family::latticegrad) {
    const AxisWeights b = axisWeights(spec.kernel, nodes_[a], u);
    out.blend = {b.weight[0], b.weight[1]};
    out.slope = {b.weight[0] * t, -b.weight[1] * back};
  } else {
    const float bend = t * back * (back - t);  // (1-t)^2 (1+2t) - (1-t)
    out.blend = {back, t};
    out.bend = {bend, -bend};
    out.slope = {t * back * back, -t * t * back};
  }
  return out;
}

void Rig::SlopeGridModel::basis(Vec3 p, RigBasis& out) const noexcept {
  const Vec3 u = box_(p);
  const AxisTerms x = termsOf(0, u.x), y = termsOf(1, u.y), z = termsOf(2, u.z);
  out.count = 0;
  for (int k = 0; k < z.count; ++k)
    for (int j = 0; j < y.count; ++j)
      for (int i = 0; i < x.count; ++i) {
        const float yz = y.blend[j] * z.blend[k];
        const float xz = x.blend[i] * z.blend[k];
        const float xy = x.blend[i] * y.blend[j];
        const std::array<float, kPerNode> value = {x.blend[i] * yz + x.bend[i] * yz + y.bend[j] * xz + z.bend[k] * xy,
                                                   x.slope[i] * yz, y.slope[j] * xz, z.slope[k] * xy};
        const int node = x.first + i + (y.first + j) * stride_[1] + (z.first + k) * stride_[2];
        for (int c = 0; c < kPerNode; ++c) {
          out.index[out.count] = kPerNode * node + c;
          out.value[out.count++] = value[c];
        }
      }
}

}  // namespace rigel
