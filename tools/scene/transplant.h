// The lights of one scene on the objects of another (`rigel report --lights SCENE`), for assets that bring none.
#pragma once

#include "scene/pose.h"

namespace rigel::tools {

/// Maps the donor's lights so that the target's objects see them as the donor's own objects do:
///     p' = targetCentre + (p - donorCentre(t)) * ratio,
/// ratio = target radius / donor radius. Radii and ranges grow by ratio, intensities by ratio^2 (irradiance on the
/// objects stays), radiances and directional irradiances not at all. Centres and radii are those of the bounding sphere
/// (about the box centre, which moves continuously) of the objects that are not static; of all objects where all are.
/// Both radii and the target's centre are taken at the first frame, the donor's centre at every time.
class LightTransplant {
 public:
  /// Error when the donor has no lights, or either scene's objects have no extent.
  static Result<LightTransplant> create(Scene donor, const Scene& target);

  /// Duration [s] of the donor's clip 0, which moves the lights; 0 for a still donor.
  double duration() const noexcept;
  float ratio() const noexcept { return ratio_; }

  /// The lights at `time` [s] of that clip, clamped to its ends. Poses the donor's objects: allocates.
  void lightsAt(double time, PosedLights& out) const;

 private:
  LightTransplant() = default;

  Scene donor_;
  std::vector<SceneObject> objects_;
  glm::vec3 targetCentre_{0};
  float ratio_ = 1;
};

}  // namespace rigel::tools
