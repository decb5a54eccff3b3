#include "tensor_model.h"

#include "basis_rows.h"
#include "box_axes.h"
#include "lattice_kernel.h"

#include <algorithm>
#include <cassert>

namespace rigel {
namespace {

// @numeric takes the slope from the secant between -h and h of the half extent. For light that varies as u^3 the error
// over the box, int (u^3 - h^2 u)^2 du, is least at h^2 = 3/5; for u^2 every h gives the same.
constexpr float kSecant = 0.77459667f;

}  // namespace

Rig::TensorModel::TensorModel(RigSpec s, const RigShape& rest, const Anchors& chosen) : Model(std::move(s)) {
  const std::array<int, 3> order = spec.pinnedAxes ? std::array{0, 1, 2} : axesByExtent(rest.box);
  for (int i = 0; i < 3; ++i) axis_[order[i]] = spec.axes[i];
  axes = axis_;
  for (int a = 0; a < 3; ++a) {
    stride_[a] = nodes_;
    nodes_ *= axis_[a].nodes;
    if (axis_[a].kind == AxisModel::Kind::gradient) slopeAxes_.push_back(a);
  }
  if (spec.fit == FitMethod::lsq) {
    std::vector<double> constant(spec.shVectors(), 0);
    for (int n = 0; n < nodes_; ++n) constant[n * (1 + slopeAxes_.size())] = 1;
    surfaceFit_.emplace(*this, chosen, std::move(constant));
  } else if (spec.fit == FitMethod::gauss) {
    gaussGrid_.emplace(*this, std::array{axis_[0].nodes, axis_[1].nodes, axis_[2].nodes}, slopeAxes_, rest);
  } else {
    buildSamples();
    buildOperator();
  }
}

void Rig::TensorModel::buildSamples() {
  const int slopes = static_cast<int>(slopeAxes_.size());
  if (spec.fit == FitMethod::numeric) {
    samples.resize(nodes_ * (1 + 2 * slopes));
    functionals = static_cast<int>(samples.size());
  } else {
    samples.assign(nodes_, RigSample{{}, slopes, {}});
    functionals = nodes_ * (1 + slopes);
  }
}

void Rig::TensorModel::buildOperator() {
  const int perNode = 1 + static_cast<int>(slopeAxes_.size());
  for (int n = 0; n < nodes_; ++n) {
    for (int j = 0; j < perNode; ++j) {
      if (spec.fit == FitMethod::corners || j == 0) {
        op.addEntry(spec.fit == FitMethod::corners ? n * perNode + j : n * (2 * perNode - 1), 1);
      } else {
        const int secant = n * (2 * perNode - 1) + 2 * j - 1;
        op.addEntry(secant, -0.5f / kSecant);
        op.addEntry(secant + 1, 0.5f / kSecant);
      }
      op.endRow();
    }
  }
}

void Rig::TensorModel::placeSamples() noexcept {
  auto sample = samples.begin();
  for (int n = 0; n < nodes_; ++n) {
    Vec3 p = box_.centre;
    for (int a = 0; a < 3; ++a) {
      const int count = axis_[a].nodes;
      if (count == 1) continue;
      const int i = n / stride_[a] % count;
      p[a] += box_.half[a] * (2 * static_cast<float>(i) / static_cast<float>(count - 1) - 1);
    }
    sample->position = p;
    if (spec.fit == FitMethod::corners) {
      // Slopes are per half extent, so that coefficients have the units of the value.
      for (std::size_t j = 0; j < slopeAxes_.size(); ++j)
        sample->directions[j] = unit(slopeAxes_[j]) * box_.half[slopeAxes_[j]];
    } else {
      for (int a : slopeAxes_) {
        const Vec3 step = unit(a) * (kSecant * box_.half[a]);
        (++sample)->position = p - step;
        (++sample)->position = p + step;
      }
    }
    ++sample;
  }
}

void Rig::TensorModel::setPose(const RigPose& pose) noexcept {
  box_ = BoxCoordinates(pose.box);
  if (surfaceFit_) {
    surfaceFit_->setPose(*this, pose);
  } else if (gaussGrid_) {
    gaussGrid_->setPose(*this, box_);
  } else {
    placeSamples();
  }
}

void Rig::TensorModel::basis(Vec3 p, RigBasis& out) const noexcept {
  const Vec3 u = box_(p);
  std::array<AxisWeights, 3> kernel;
  std::array<std::array<float, kMaxGaussVectors>, 3> lagrange;  // not initialised: only @gauss fills it
  std::array<std::span<const float>, 3> w;
  for (int a = 0; a < 3; ++a) {
    const auto nodes = static_cast<std::size_t>(axis_[a].nodes);
    if (gaussGrid_) {
      gaussGrid_->axis(a).lagrange(std::clamp(u[a], -1.0f, 1.0f), lagrange[a]);
      w[a] = std::span<const float>(lagrange[a]).first(nodes);
    } else {
      kernel[a] = axisWeights(spec.kernel, axis_[a].nodes, u[a]);
      w[a] = std::span<const float>(kernel[a].weight).first(static_cast<std::size_t>(kernel[a].count));
    }
  }
  const int perNode = 1 + static_cast<int>(slopeAxes_.size());
  out.count = 0;
  for (std::size_t k = 0; k < w[2].size(); ++k) {
    for (std::size_t j = 0; j < w[1].size(); ++j) {
      const float outer = w[2][k] * w[1][j];
      const int row =
          (kernel[2].first + static_cast<int>(k)) * stride_[2] + (kernel[1].first + static_cast<int>(j)) * stride_[1];
      for (std::size_t i = 0; i < w[0].size(); ++i) {
        const float b = outer * w[0][i];
        const int first = (row + (kernel[0].first + static_cast<int>(i)) * stride_[0]) * perNode;
        out.index[out.count] = first;
        out.value[out.count++] = b;
        for (int s = 1; s < perNode; ++s) {
          out.index[out.count] = first + s;
          out.value[out.count++] = b * u[slopeAxes_[s - 1]];
        }
      }
    }
  }
}

void Rig::TensorModel::axisRows(int axis, std::span<const float> u, std::span<float> rows) const noexcept {
  const int nodes = axis_[axis].nodes;
  if (nodes > 1 && !gaussGrid_ && spec.kernel != LatticeKernel::cubic)
    return basisrows::hats(nodes, spec.kernel == LatticeKernel::smooth, u.data(), u.size(), rows.data());
  std::ranges::fill(rows, nodes == 1 ? 1.0f : 0.0f);
  if (nodes == 1) return;
  std::array<float, kMaxGaussVectors> lagrange;
  for (std::size_t i = 0; i < u.size(); ++i) {
    int first = 0;
    std::span<const float> weights;
    AxisWeights kernel;
    if (gaussGrid_) {
      gaussGrid_->axis(axis).lagrange(std::clamp(u[i], -1.0f, 1.0f), lagrange);
      weights = std::span(lagrange).first(static_cast<std::size_t>(nodes));
    } else {
      kernel = axisWeights(spec.kernel, nodes, u[i]);
      first = kernel.first;
      weights = std::span(kernel.weight).first(static_cast<std::size_t>(kernel.count));
    }
    float* to = rows.data() + static_cast<std::size_t>(first) * u.size() + i;
    for (float w : weights) {
      *to = w;
      to += u.size();
    }
  }
}

void Rig::TensorModel::basisBatch(const Vec3Rows& points, [[maybe_unused]] int count,
                                  std::span<float> values) const noexcept {
  const std::size_t n = points.size();
  const int perNode = 1 + static_cast<int>(slopeAxes_.size());
  assert(count == perNode * nodes_);
  BoxCoordinates::Rows u;
  box_.rows(points, u);
  // Nodes multiply to kCapacity at most, so that of three axes they sum to no more than two beyond it.
  std::array<float, (RigBasis::kCapacity + 2) * kMaxBasisBatch> axisValues;
  std::array<const float*, 3> of;
  std::size_t end = 0;
  for (int a = 0; a < 3; ++a) {
    const std::span<float> rows = std::span(axisValues).subspan(end, static_cast<std::size_t>(axis_[a].nodes) * n);
    axisRows(a, std::span(u[a]).first(n), rows);
    of[a] = rows.data();
    end += rows.size();
  }
  for (int node = 0; node < nodes_; ++node) {
    const auto weights = [&](int a) {
      return of[a] + static_cast<std::size_t>(node / stride_[a] % axis_[a].nodes) * n;
    };
    float* value = values.data() + static_cast<std::size_t>(node * perNode) * n;
    basisrows::multiply(weights(2), weights(1), n, value);
    basisrows::multiply(value, weights(0), n, value);
    for (int s = 1; s < perNode; ++s)
      basisrows::multiply(value, u[slopeAxes_[s - 1]].data(), n, value + static_cast<std::size_t>(s) * n);
  }
}

}  // namespace rigel
