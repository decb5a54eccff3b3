#include <rigel/rig.h>

#include "model.h"
#include "poly_model.h"
#include "tensor_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel {
namespace {

bool isFinite(Vec3 v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Sample points of a least-squares rig: two a vector; as many as vectors would fit the points and nothing between.
constexpr int kPointsPerVector = 2;
constexpr int kMostPointsPerVector = 4;
constexpr double kWellDetermined = 100;  // condition up to which the anchors determine the coefficients well
constexpr double kWorthwhile = 0.5;      // of the condition, for one projection more per light and vector

}  // namespace

Result<Rig> Rig::create(const RigSpec& spec, const RigShape& rest) {
  if (auto error = checkRigSpec(spec)) return *std::move(error);
  const RigBox& box = rest.box;
  const std::string place = "rig '" + spec.text + "'";
  if (!isFinite(box.lo) || !isFinite(box.hi) || box.lo.x > box.hi.x || box.lo.y > box.hi.y || box.lo.z > box.hi.z)
    return Error{"the rest box is not a box", place};
  if (rest.surface.empty()) return Error{"no surface points", place};
  if (!std::ranges::all_of(rest.surface, isFinite)) return Error{"a surface point is not finite", place};

  std::unique_ptr<Model> model = Model::create(spec, rest, kPointsPerVector);
  // Anchors that do not tell the basis functions apart leave the fit at the mercy of single points: more of them help,
  // unless the surface itself cannot.
  for (int points = kPointsPerVector + 1; points <= kMostPointsPerVector && model->condition > kWellDetermined;
       ++points) {
    std::unique_ptr<Model> more = Model::create(spec, rest, points);
    if (more->condition > kWorthwhile * model->condition) break;
    model = std::move(more);
  }
  model->probes = probeSurface(rest, model->anchors);
  return Rig(std::move(model));
}

/// In its rest pose.
std::unique_ptr<Rig::Model> Rig::Model::create(const RigSpec& spec, const RigShape& rest, int pointsPerVector) {
  std::unique_ptr<Model> model;
  if (spec.family == RigSpec::Family::poly) {
    model = std::make_unique<PolyModel>(spec, rest, pointsPerVector);
  } else {
    model = std::make_unique<TensorModel>(spec, rest, pointsPerVector);
  }
  std::vector<Vec3> posed;
  for (int i : model->anchors) posed.push_back(rest.surface[i]);
  model->box = rest.box;
  model->setPose({rest.box, posed});
  return model;
}

Rig::Rig(std::unique_ptr<Model> model) noexcept : model_(std::move(model)) {}
Rig::Rig(Rig&&) noexcept = default;
Rig& Rig::operator=(Rig&&) noexcept = default;
Rig::~Rig() = default;

const RigSpec& Rig::spec() const noexcept { return model_->spec; }
int Rig::shVectors() const noexcept { return model_->op.rows(); }
int Rig::projections() const noexcept { return model_->functionals; }
std::span<const int> Rig::anchors() const noexcept { return model_->anchors; }
std::span<const RigSample> Rig::samples() const noexcept { return model_->samples; }
const RigBox& Rig::box() const noexcept { return model_->box; }
const std::array<AxisModel, 3>& Rig::axes() const noexcept { return model_->axes; }
double Rig::condition() const noexcept { return model_->condition; }
void Rig::basis(Vec3 p, RigBasis& out) const noexcept { model_->basis(p, out); }

void Rig::setPose(const RigPose& pose) noexcept {
  assert(pose.anchors.size() == model_->anchors.size());
  model_->box = pose.box;
  model_->setPose(pose);
}

void Rig::adapt(std::span<const float> functionals, int width) noexcept {
  assert(functionals.size() == static_cast<std::size_t>(projections()) * width);
  model_->adapt(functionals, width);
}

void Rig::fit(std::span<const float> functionals, int width, std::span<float> coefficients) const noexcept {
  const SparseOperator& op = model_->op;
  assert(functionals.size() == static_cast<std::size_t>(projections()) * width);
  assert(coefficients.size() == static_cast<std::size_t>(shVectors()) * width);
  for (int k = 0; k < op.rows(); ++k) {
    float* c = &coefficients[static_cast<std::size_t>(k) * width];
    std::fill_n(c, width, 0.0f);
    for (int e = op.rowStart[k]; e < op.rowStart[k + 1]; ++e) {
      const float weight = op.weight[e];
      const float* f = &functionals[static_cast<std::size_t>(op.column[e]) * width];
      for (int i = 0; i < width; ++i) c[i] += weight * f[i];
    }
  }
}

}  // namespace rigel
