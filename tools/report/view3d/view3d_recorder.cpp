#include "report/view3d/view3d_recorder.h"

#include "report/view3d/view3d_plan.h"

#include <cmath>

namespace rigel::tools {
namespace {

/// What became of a light, in a byte.
std::uint8_t nearness(const LightVerdict& verdict) {
  if (verdict.role == LightRole::culled) return kViewCulled;
  if (verdict.weight <= 0) return kViewFar;
  const float steps = kViewNear - kViewLeastNear;
  return static_cast<std::uint8_t>(kViewLeastNear + std::lround(steps * std::min(1.0f, verdict.weight)));
}

/// The positions at which a rig projects light; every so many where there are too many to draw.
std::vector<Vec3> samplePositions(const Rig& rig) {
  const std::size_t count = rig.samples().size(), drawn = std::min(count, kViewSamples);
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < drawn; ++i) positions.push_back(rig.samples()[i * count / drawn].position);
  return positions;
}

}  // namespace

ViewRecorder::ViewRecorder(const SceneObject& object, const PosedObject& rest, std::size_t vertices,
                           std::optional<float> wrap) {
  ViewMesh mesh = viewMesh(object, rest, vertices);
  vertices_ = std::move(mesh.vertices);
  view_.triangles = std::move(mesh.triangles);
  for (const SurfacePoint& vertex : vertices_) wrap_.push_back(wrap.value_or(object.triangleWrap[vertex.triangle]));
  points_.resize(vertices_.size());
  shaded_.resize(vertices_.size());
}

void ViewRecorder::record(const ObjectRun& run, std::size_t frame, const PosedObject& posed, const LightSet& lights,
                          std::span<const ViewLight> shown) {
  ObjectViewFrame& view = view_.frames.emplace_back();
  view.worldFromLocal = rigidFrame(posed.worldFromRig);
  view.positions.resize(vertices_.size());
  view.truth.resize(vertices_.size());
  forSamples(vertices_.size(), [&](std::size_t i) {
    points_[i] = evaluateSurface(run.object(), posed, vertices_[i]);
    view.positions[i] = view.worldFromLocal.inversePoint(points_[i].position);
    const RgbD exact = exactIrradiance(lights, points_[i].position, points_[i].normal, wrap_[i]);
    view.truth[i] = {static_cast<float>(exact.r), static_cast<float>(exact.g), static_cast<float>(exact.b)};
  });
  for (std::size_t r = 0; r < run.rigCount(); ++r) {
    run.relight(r, frame, posed, lights);
    view.rigs.push_back(lit(run.rig(r), run.meanIrradiance(), shown));
  }
}

ObjectViewFrame::OfRig ViewRecorder::lit(RigRunner& rig, double meanIrradiance, std::span<const ViewLight> shown) {
  ObjectViewFrame::OfRig out{rig.rig().box(), samplePositions(rig.rig()), {}, {}};
  rig.shade(points_, wrap_, shaded_);
  const float scale = meanIrradiance > 0 ? static_cast<float>(1 / meanIrradiance) : 0;
  const std::vector<Rgb>& truth = view_.frames.back().truth;
  for (std::size_t i = 0; i < shaded_.size(); ++i) out.error.push_back((shaded_[i].clamped() - truth[i]) * scale);
  const std::span<const LightVerdict> verdicts = rig.verdicts();
  for (const ViewLight& light : shown) out.lights.push_back(nearness(verdicts[static_cast<std::size_t>(light.index)]));
  return out;
}

}  // namespace rigel::tools
