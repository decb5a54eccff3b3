#include "gauss_grid.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

// A sample stands for the surface of its cell, as an anchor for its patch, but its neighbours share in it: half the
// radius of a disc with the cell's spread. Over the inputs of tools/study/rig_ratios.py, error against corners: 0.55
// so, 0.57 for points, 0.56 for the whole radius; without footprints a light beside a sample doubles the error of mixed
// rigs.
constexpr float kFootprint = 0.5f;

std::vector<double> marginal(std::span<const Vec3> surface, const BoxCoordinates& box, int axis) {
  std::vector<double> coordinates;
  for (Vec3 p : surface) coordinates.push_back(static_cast<double>(box(p)[axis]));
  return coordinates;
}

}  // namespace

GaussGrid::GaussGrid(Rig::Model& model, std::array<int, 3> nodes, std::vector<int> slopeAxes, const RigShape& rest)
    : slopeAxes_(std::move(slopeAxes)) {
  const BoxCoordinates box(rest.box);
  for (int a = 0; a < 3; ++a) {
    axes_.emplace_back(marginal(rest.surface, box, a), nodes[a]);
    nodes_ *= nodes[a];
  }
  for (int a : slopeAxes_) secants_.emplace_back(marginal(rest.surface, box, a), 2);
  model.samples.resize(static_cast<std::size_t>(nodes_) * std::max<std::size_t>(1, 2 * slopeAxes_.size()));
  model.functionals = static_cast<int>(model.samples.size());
  buildOperator(model);
}

void GaussGrid::buildOperator(Rig::Model& model) const {
  const int slopes = static_cast<int>(slopeAxes_.size());
  for (int n = 0; n < nodes_; ++n) {
    if (slopes == 0) {
      model.op.addEntry(n, 1);
      model.op.endRow();
      continue;
    }
    const int first = n * 2 * slopes;
    const auto rise = [&](int j) { return 1 / (secants_[j].node[1] - secants_[j].node[0]); };
    // The value at u = 0 along the slopes: the mean over all secants, less the slopes' part at the surface's mean.
    for (int j = 0; j < slopes; ++j) {
      const double slopePart = axes_[slopeAxes_[j]].node[0] * rise(j);
      model.op.addEntry(first + 2 * j, static_cast<float>(secants_[j].weight[0] / slopes + slopePart));
      model.op.addEntry(first + 2 * j + 1, static_cast<float>(secants_[j].weight[1] / slopes - slopePart));
    }
    model.op.endRow();
    for (int j = 0; j < slopes; ++j) {
      model.op.addEntry(first + 2 * j, static_cast<float>(-rise(j)));
      model.op.addEntry(first + 2 * j + 1, static_cast<float>(rise(j)));
      model.op.endRow();
    }
  }
}

void GaussGrid::setPose(Rig::Model& model, const BoxCoordinates& box) noexcept {
  auto sample = model.samples.begin();
  for (int n = 0; n < nodes_; ++n) {
    Vec3 u;
    Vec3 spread;
    int rest = n;
    for (int a = 0; a < 3; ++a) {
      const auto i = static_cast<std::size_t>(rest) % axes_[a].node.size();
      rest /= static_cast<int>(axes_[a].node.size());
      u[a] = static_cast<float>(axes_[a].node[i]);
      spread[a] = static_cast<float>(axes_[a].spread[i]);
    }
    const auto place = [&](Vec3 v, Vec3 s) {
      sample->position = box.centre + Vec3{box.half.x * v.x, box.half.y * v.y, box.half.z * v.z};
      float square = 0;
      for (int a = 0; a < 3; ++a) square += box.half[a] * box.half[a] * s[a];
      sample->footprint = kFootprint * std::sqrt(2 * square);
      ++sample;
    };
    if (slopeAxes_.empty()) place(u, spread);
    for (std::size_t j = 0; j < slopeAxes_.size(); ++j) {
      for (int end = 0; end < 2; ++end) {
        Vec3 v = u;
        Vec3 s = spread;
        v[slopeAxes_[j]] = static_cast<float>(secants_[j].node[end]);
        s[slopeAxes_[j]] = static_cast<float>(secants_[j].spread[end]);
        place(v, s);
      }
    }
  }
}

}  // namespace rigel
