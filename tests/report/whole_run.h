// Runs a scene as `rigel report` does, without pictures.
#pragma once

#include "report/run/scene_run.h"

#include "scene/gltf_load.h"
#include "scene/gltf_save.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

namespace rigel::tests {

inline tools::RunOptions quickRun(const std::string& scene, const std::string& frames,
                                  const std::string& rigs = "constant;lattice:2x2x2") {
  tools::RunOptions options;
  options.scenes = {scene};
  options.rigs = *parseRigSpecs(rigs);
  options.frames = *tools::parseFrameRange(frames);
  options.images = false;
  options.samples = 64;
  return options;
}

inline Result<tools::Report> run(const tools::RunOptions& options) {
  return tools::runReport(options, {}, [](double, const std::string&) {});
}

/// A scene as a file, gone with the guard.
struct SavedScene {
  test::TemporaryFolder folder;
  const std::string file = folder / "scene.glb";

  explicit SavedScene(const tools::Scene& scene) {
    const auto saved = tools::saveGltf(scene, file);
    EXPECT_TRUE(saved) << (saved ? "" : saved.error().line());
  }
};

}  // namespace rigel::tests
