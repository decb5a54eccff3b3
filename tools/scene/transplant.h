// The lights of one scene on the objects of another (`rigel report --lights SCENE`), for assets that bring none.
#pragma once

#include "scene/pose.h"

namespace rigel::tools {

/// A scene whose lights others may borrow: made once, shared by any number of transplants.
class LightDonor {
 public:
  /// Error when the scene has no lights or its objects have no extent.
  static Result<LightDonor> create(Scene scene);

  /// A file of lights alone has none.
  bool hasObjects() const noexcept { return !objects_.empty(); }

  /// Duration [s] of the scene's clip 0, which moves the lights; 0 for a still one.
  double duration() const noexcept;

 private:
  friend class LightTransplant;
  LightDonor() = default;

  Scene scene_;
  std::vector<SceneObject> objects_;
  float radius_ = 0;
};

/// Maps the donor's lights so that the target's objects see them as the donor's own objects do:
///     p' = targetCentre + (p - donorCentre(t)) * ratio,
/// ratio = target radius / donor radius. Radii and ranges grow by ratio, intensities by ratio^2 (irradiance on the
/// objects stays), radiances and directional irradiances not at all. Centres and radii are those of the bounding sphere
/// (about the box centre, which moves continuously) of the objects that are not static; of all objects where all are.
/// Both radii and the target's centre are taken at the first frame, the donor's centre at every time. Lights of a donor
/// without objects stay as they are.
class LightTransplant {
 public:
  /// For `target` as its animation `clip` (or kRestPose) begins. `donor` must outlive the transplant. Error when the
  /// target's objects have no extent.
  static Result<LightTransplant> create(const LightDonor& donor, const Scene& target, int clip);

  float ratio() const noexcept { return ratio_; }

  /// The lights at `time` [s] of the donor's clip, clamped to its ends. Poses the donor's objects: allocates.
  void lightsAt(double time, PosedLights& out) const;

 private:
  explicit LightTransplant(const LightDonor& donor) : donor_(&donor) {}

  const LightDonor* donor_;
  glm::vec3 targetCentre_{0};
  float ratio_ = 1;
};

}  // namespace rigel::tools
