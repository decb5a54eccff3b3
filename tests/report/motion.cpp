#include "motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rigel::tests {

using namespace rigel::tools;

Motion::Motion(const std::string& sample, int samples) {
  auto scene = loadScene("sample:" + sample);
  if (!scene) throw std::runtime_error(scene.error().line());
  scene_ = *std::move(scene);
  objects_ = findObjects(scene_);
  while (objects_.at(moving_).isStatic) ++moving_;
  poseScene(scene_, kRestPose, 0, pose_);
  poseObject(scene_, object(), pose_, rest_);
  auto surface = chooseSurface(object(), rest_, samples, {});
  if (!surface) throw std::runtime_error(surface.error().line());
  surface_ = *std::move(surface);
}

void Motion::show(double seconds) {
  poseScene(scene_, 0, seconds, pose_);
  poseObject(scene_, object(), pose_, posed_);
  poseLights(scene_, pose_, lights_);
  truth_.update(object(), posed_, surface_, lights_.set, kDefaultBands);
}

void LeapMeter::add(std::span<const RigRunner::Shaded> shaded, const Truth& truth) {
  std::vector<std::array<double, 3>> error(shaded.size()), rig(shaded.size());
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      rig[i][c] = std::max(0.0, static_cast<double>(shaded[i].rig[static_cast<int>(c)]));
      error[i][c] =
          rig[i][c] + static_cast<double>(shaded[i].near[static_cast<int>(c)]) - truth.exact[i][static_cast<int>(c)];
      if (error_.empty()) continue;
      largest_.error = std::max(largest_.error, std::abs(error[i][c] - error_[i][c]));
      largest_.rig = std::max(largest_.rig, std::abs(rig[i][c] - rig_[i][c]));
    }
  }
  error_ = std::move(error);
  rig_ = std::move(rig);
}

void shadeWithHardSwitch(const RigRunner& rig, int slots, const Motion& motion, std::span<RigRunner::Shaded> out) {
  const auto verdicts = rig.verdicts();
  std::vector<std::size_t> order(verdicts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return verdicts[a].bound > verdicts[b].bound; });
  std::vector<float> weights(verdicts.size(), 0);
  for (std::size_t rank = 0; rank < std::min<std::size_t>(order.size(), static_cast<std::size_t>(slots)); ++rank)
    weights[order[rank]] = 1;

  LightSet far;
  std::vector<NearLight> near;
  splitLights(motion.lights(), weights, far, near);
  const RigFrame frame = rigidFrame(motion.posed().worldFromRig);
  std::vector<RadianceSH<3>> functionals(rig.rig().projections()), coefficients(rig.rig().shVectors());
  projectSamples<3>(rig.rig(), frame, far, functionals);
  fitRig<3>(rig.rig(), functionals, coefficients);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto [p, n] = motion.truth().points[i];
    const float wrap = motion.surface().wrap[i];
    out[i] = {
        irradiance<3>(evaluateRig<3>(rig.rig(), coefficients, frame.inversePoint(p)), wrapCoefficients<3>(wrap), n),
        {}};
    for (const NearLight& light : near) out[i].near += nearIrradiance(light, p, n, wrap);
  }
}

}  // namespace rigel::tests
