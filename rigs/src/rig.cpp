#include <rigel/light_bound.h>
#include <rigel/rig.h>

#include "fekete.h"
#include "model.h"
#include "poly_model.h"
#include "rbf_model.h"
#include "simulated_lights.h"
#include "slope_grid_model.h"
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
// Of the error, for Fekete points in place of clusters, which are as good in most poses: simulated lights know the rest
// pose alone.
constexpr double kClearlyBetter = 0.97;

void poseAtRest(Rig::Model& model, const RigShape& rest) {
  std::vector<Vec3> posed;
  for (int i : model.anchors) posed.push_back(rest.surface[i]);
  model.box = rest.box;
  model.setPose({rest.box, posed});
}

int anchorCount(const RigSpec& spec, int pointsPerVector) {
  const int least = spec.falloff ? kFalloffPoints : 0;
  return std::clamp(pointsPerVector * spec.shVectors(), least, LeastSquares::kMaxPoints);
}

/// With anchors where simulated lights say, at the medoids of clusters or at Fekete points. Neither is better for all
/// shapes and models.
std::unique_ptr<Rig::Model> anchoredModel(const RigSpec& spec, const RigShape& rest, const SimulatedLights& lights,
                                          int points) {
  const SurfaceEnds ends = spec.adaptive ? SurfaceEnds::anchored : SurfaceEnds::represented;
  const Anchors clustered = chooseAnchors(rest.surface, points, ends);
  std::unique_ptr<Rig::Model> model = Rig::Model::create(spec, rest, clustered);
  if (static_cast<int>(rest.surface.size()) <= points) return model;
  const Anchors fekete = feketeAnchors(rest.surface, points, ends);
  if (fekete.index.size() < clustered.index.size()) return model;
  std::unique_ptr<Rig::Model> other = Rig::Model::create(spec, rest, fekete);
  if (lights.error(*other) < kClearlyBetter * lights.error(*model)) model = std::move(other);
  poseAtRest(*model, rest);
  return model;
}

std::unique_ptr<Rig::Model> anchoredModel(const RigSpec& spec, const RigShape& rest) {
  const SimulatedLights lights(rest);
  std::unique_ptr<Rig::Model> model = anchoredModel(spec, rest, lights, anchorCount(spec, kPointsPerVector));
  // Anchors that do not tell the basis functions apart leave the fit at the mercy of single points: more of them help,
  // unless the surface itself cannot.
  for (int points = kPointsPerVector + 1; points <= kMostPointsPerVector && model->condition > kWellDetermined;
       ++points) {
    const int anchors = anchorCount(spec, points);
    if (anchors > detail::SamplePlan::kMaxSamples) break;  // bounds would know nothing of it
    std::unique_ptr<Rig::Model> more = anchoredModel(spec, rest, lights, anchors);
    if (more->condition > kWorthwhile * model->condition) break;
    model = std::move(more);
  }
  return model;
}

}  // namespace

Result<Rig> Rig::create(const RigSpec& spec, const RigShape& rest) {
  if (auto error = checkRigSpec(spec)) return *std::move(error);
  const RigBox& box = rest.box;
  const std::string place = "rig '" + spec.text + "'";
  if (!isFinite(box.lo) || !isFinite(box.hi) || box.lo.x > box.hi.x || box.lo.y > box.hi.y || box.lo.z > box.hi.z)
    return Error{"the rest box is not a box", place};
  if (rest.surface.empty()) return Error{"no surface points", place};
  if (!std::ranges::all_of(rest.surface, isFinite)) return Error{"a surface point is not finite", place};

  const bool anchored =
      spec.family == RigSpec::Family::poly || spec.family == RigSpec::Family::rbf || spec.fit == FitMethod::lsq;
  std::unique_ptr<Model> model = anchored ? anchoredModel(spec, rest) : Model::create(spec, rest, {});
  model->probes = probeSurface(rest, model->anchors);
  return Rig(std::move(model));
}

std::unique_ptr<Rig::Model> Rig::Model::create(const RigSpec& spec, const RigShape& rest, const Anchors& anchors) {
  std::unique_ptr<Model> model;
  switch (spec.family) {
    case RigSpec::Family::tensor:
      model = std::make_unique<TensorModel>(spec, rest, anchors);
      break;
    case RigSpec::Family::poly:
      model = std::make_unique<PolyModel>(spec, rest, anchors);
      break;
    case RigSpec::Family::rbf:
      model = std::make_unique<RbfModel>(spec, rest, anchors);
      break;
    case RigSpec::Family::latticegrad:
    case RigSpec::Family::hermite:
      model = std::make_unique<SlopeGridModel>(spec, rest);
      break;
  }
  poseAtRest(*model, rest);
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

void Rig::basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept {
  assert(points.size() <= kMaxBasisBatch && count <= static_cast<int>(kMaxBasisBatch) && count <= shVectors());
  assert(values.size() == static_cast<std::size_t>(count) * points.size());
  model_->basisBatch(points, count, values);
}

void Rig::Model::basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept {
  std::ranges::fill(values, 0.0f);
  RigBasis at;
  for (std::size_t i = 0; i < points.size(); ++i) {
    basis({points.x[i], points.y[i], points.z[i]}, at);
    for (int j = 0; j < at.count; ++j)
      if (at.index[j] < count) values[static_cast<std::size_t>(at.index[j]) * points.size() + i] = at.value[j];
  }
}

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
  assert(functionals.size() == static_cast<std::size_t>(projections()) * width);
  assert(coefficients.size() == static_cast<std::size_t>(shVectors()) * width);
  model_->op.apply(functionals, width, coefficients);
}

void SparseOperator::apply(std::span<const float> functionals, int width,
                           std::span<float> coefficients) const noexcept {
  for (int k = 0; k < rows(); ++k) {
    float* c = &coefficients[static_cast<std::size_t>(k) * width];
    std::fill_n(c, width, 0.0f);
    for (int e = rowStart[k]; e < rowStart[k + 1]; ++e) {
      const float* f = &functionals[static_cast<std::size_t>(column[e]) * width];
      for (int i = 0; i < width; ++i) c[i] += weight[e] * f[i];
    }
  }
}

}  // namespace rigel
