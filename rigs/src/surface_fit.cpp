#include "surface_fit.h"

#include <algorithm>

namespace rigel {

SurfaceFit::SurfaceFit(Rig::Model& model, const Anchors& anchors, std::vector<double> constant)
    : shares_(anchors.share),
      weights_(shares_.size()),
      constant_(std::move(constant)),
      leastSquares_(static_cast<int>(shares_.size()), static_cast<int>(constant_.size())) {
  model.anchors = anchors.index;
  model.functionals = static_cast<int>(anchors.index.size());
  model.samples.resize(anchors.index.size());
  // Without footprints a light that touches the surface next to an anchor would pass for one that lights all of the
  // anchor's patch as brightly.
  for (std::size_t i = 0; i < model.samples.size(); ++i) {
    model.samples[i].footprint = anchors.radius[i];
    model.samples[i].share = anchors.share[i];
  }
  for (std::size_t k = 0; k < constant_.size(); ++k) {
    for (int s = 0; s < model.functionals; ++s) model.op.addEntry(s, 0);
    model.op.endRow();
  }
}

void SurfaceFit::setPose(Rig::Model& model, const RigPose& pose) noexcept {
  RigBasis phi;
  for (int s = 0; s < model.functionals; ++s) {
    model.samples[s].position = pose.anchors[s];
    const auto row = leastSquares_.row(s);
    std::ranges::fill(row, 0.0);
    model.basis(pose.anchors[s], phi);
    for (int j = 0; j < phi.count; ++j) row[phi.index[j]] = static_cast<double>(phi.value[j]);
  }
  model.condition = leastSquares_.solve(shares_, constant_, model.op.weight);
}

void SurfaceFit::rescale(Rig::Model& model, std::span<const float> q) noexcept {
  float sum = 0;
  for (std::size_t s = 0; s < q.size(); ++s) sum += weights_[s] = shares_[s] / (q[s] * q[s]);
  for (float& w : weights_) w /= sum;
  // The condition stays that of the pose: it is about the anchors, not about the light.
  leastSquares_.solve(weights_, constant_, model.op.weight);
  const auto rows = model.op.weight.size() / q.size();
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t s = 0; s < q.size(); ++s) model.op.weight[k * q.size() + s] *= q[s];
}

}  // namespace rigel
