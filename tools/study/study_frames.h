// The inputs of the studies: every object of a scene, frame by frame, with what each light gives each surface point.
#pragma once

#include "report/measure/surface_set.h"
#include "report/run/timeline.h"
#include "scene/transplant.h"

#include <functional>
#include <string>

namespace rigel::tools {

struct StudyInput {
  std::string scene;
  std::string donor;  // of the lights, or "": the scene's own

  std::string label() const;  // "Fox.glb by dragon"
};

/// Built-in scenes by their own lights; with a `data` folder of real assets (characters/, vehicles/, scenes/), those by
/// the lights of street and dragon, too.
std::vector<StudyInput> studyInputs(const std::string& data);

struct StudyFrame {
  const SceneObject* object = nullptr;
  const PosedObject* posed = nullptr;
  const SurfaceSet* surface = nullptr;
  const PosedLights* lights = nullptr;
  RigBox box;
  RigFrame frame;
  std::vector<PointAndNormal> points;  // the measured points in this pose
  std::vector<float> exact;            // lights x points x 3, irradiance
  std::vector<float> sh;               // the same from three bands, unclamped
  double mean = 0;                     // exact irradiance over points and channels, all lights

  std::size_t row() const { return 3 * points.size(); }
  Vec3 anchor(int candidate) const {
    return frame.inversePoint(surfacePosition(*object, *posed, surface->candidates[candidate]));
  }
};

/// One object of one clip: `begin` once with its rest pose, then `frame` for each frame, in order.
class StudyVisitor {
 public:
  virtual ~StudyVisitor() = default;
  virtual void begin(const StudyInput& input, const std::string& name, const RigShape& rest, double runMean) = 0;
  virtual void frame(const StudyFrame& frame) = 0;
  virtual void end() = 0;
};

/// Every `step`-th frame of all clips. The wrap is the first triangle's.
std::optional<Error> visitFrames(const StudyInput& input, int step, int points, StudyVisitor& visitor);

}  // namespace rigel::tools
