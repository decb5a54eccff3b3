// A scene of a run: loaded, checked, ready to be posed at any frame of a timeline, under its own lights or borrowed
// ones.
#pragma once

#include "report/run/timeline.h"
#include "scene/pose.h"
#include "scene/transplant.h"

#include <memory>
#include <optional>

namespace rigel::tools {

/// The lights of --lights, or nothing.
Result<std::optional<LightDonor>> loadDonor(const RunOptions& options);

class LoadedScene {
 public:
  /// Errors: what loadScene gives, a scene without lights or without anything that moves, unknown clips. `donor` may be
  /// null and must outlive the scene.
  static Result<LoadedScene> load(const std::string& source, const RunOptions& options, const LightDonor* donor);

  const std::string& source() const { return source_; }
  const Scene& scene() const { return *scene_; }
  const std::vector<SceneObject>& objects() const { return objects_; }  // static ones included
  const std::vector<Timeline>& timelines() const { return timelines_; }
  /// Of the file, and of what the options leave out.
  const std::vector<std::string>& notes() const { return notes_; }
  const LightDonor* donor() const { return donor_; }

 private:
  std::string source_;
  std::unique_ptr<Scene> scene_;
  std::vector<SceneObject> objects_;
  const LightDonor* donor_ = nullptr;
  std::vector<Timeline> timelines_;
  std::vector<std::string> notes_;
};

/// Nodes and lights of the scene in one frame. Scene and timeline must outlive it.
class Stage {
 public:
  static Result<Stage> create(const LoadedScene& scene, const Timeline& timeline);

  void pose(int frame);
  const ScenePose& nodes() const { return pose_; }
  const PosedLights& lights() const { return lights_; }

 private:
  Stage(const Scene& scene, const Timeline& timeline, std::optional<LightTransplant> donor)
      : scene_(&scene), timeline_(&timeline), donor_(donor) {}

  const Scene* scene_;
  const Timeline* timeline_;
  std::optional<LightTransplant> donor_;  // the scene's own lights without one
  ScenePose pose_;
  PosedLights lights_;
};

}  // namespace rigel::tools
