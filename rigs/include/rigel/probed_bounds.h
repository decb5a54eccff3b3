// How wrong a rig can be about one light, tightly: what it makes of the light at some hundred points.
//
// LightBounds sums the sizes of all that a rig of samples anywhere (poly, invquad, rbf, @lsq, @gauss) can be wrong by,
// and of a real light most of that cancels: it is 3 to 130 times the true error, which is good enough to tell which
// lights are to be near, and says little about how wrong the far ones are. ProbedBounds projects the light at the rig's
// samples, fits the rig, compares it with the light at 256 to 1024 points of the surface (512 of the box, for @gauss),
// and adds what both can do between the points: a share of what is seen, what the light does within their spacing, the
// bend at a disk's plane. Median of bound/true for disks 1.3 to 2.0, of invquad 1.9 to 2.6. Checked rather than proven,
// as LightBounds of such rigs; figures: rigs/README.md.
//
// It is the promise to report, and nothing to choose near lights by: the worst of a surface's points tells less about
// the whole surface than the sum of all terms. No frame of the runtime asks it.
#pragma once

#include <rigel/light_bound.h>

#include <memory>

namespace rigel {

/// LightBounds with an error that is the less of both. Rigs that sample at the nodes of a box have the same, and so
/// have those on a surface that were created without RigShape::tightBounds.
///
/// Made once a frame and object (allocates). Reads the rig, which must stay where it is, and in this pose, while it is
/// asked. A light costs 14 to 25 us at 256 points, 25 to 80 times LightBounds (`rigel bench --filter bound.probed`),
/// and allocates nothing; one thread at a time. Results are finite and continuous in light and pose, as those of
/// LightBounds.
class ProbedBounds {
 public:
  ProbedBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap = 0, float radius = kNoRange);
  ProbedBounds(ProbedBounds&&) noexcept;
  ProbedBounds& operator=(ProbedBounds&&) noexcept;
  ~ProbedBounds();

  /// False where all is as LightBounds has it.
  bool tight() const noexcept { return probes_ != nullptr; }

  /// The rig, in the same pose, is elsewhere.
  void place(const RigFrame& worldFromRig) noexcept;

  LightBound operator()(const DirectionalLight& light) noexcept { return bounds_(light); }
  LightBound operator()(const PointLight& light) noexcept;
  LightBound operator()(const SpotLight& light) noexcept;
  LightBound operator()(const SphereLight& light) noexcept;
  LightBound operator()(const DiskLight& light) noexcept;

 private:
  class Probes;
  template <class Light>
  LightBound of(const Light& light) noexcept;

  LightBounds bounds_;
  std::unique_ptr<Probes> probes_;  // where tight
};

}  // namespace rigel
