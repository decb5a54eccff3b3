// Everything is compiled while a scene loads: nothing during its frames, whatever they call for.
#include "gpu/run_self.h"
#include "gpu/scene_case.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <chrono>
#include <set>
#include <thread>

namespace rigel::test {
namespace {

using namespace tools;

/// Six hundred frames of cars and street lamps, in which rigs, near lights and the high band come and go.
RenderOptions longRun() {
  RenderOptions options = renderOptions({.scene = "sample:street",
                                         .rig = "auto",
                                         .frames = {0, 599, 1},
                                         .target = LightingTarget{LightingTarget::Kind::totalError, 0.06f}});
  options.run.rate = 150;
  options.width = 64;
  options.height = 48;
  return options;
}

/// What frames called for.
struct Seen {
  std::set<std::vector<int>> near;
  std::set<int> vectors;
  std::set<std::uint64_t> effects;

  void add(const RenderResult& result) {
    for (const RigState& rig : result.rigs) {
      near.insert(rig.near);
      vectors.insert(rig.shVectors);
    }
    effects.insert(result.effects.bits());
  }
};

TEST(GpuLoad, NoShaderOrPipelineIsCreatedAfterIt) {
  SceneRender render = sceneRender(longRun());
  ASSERT_EQ(render.frames().size(), 600u);
  const int pipelines = gpu().pipelinesCreated(), modules = gpu().shaderModulesCreated();
  EXPECT_GT(pipelines, render.pipelines());
  Seen seen;
  for (const int frame : render.frames()) {
    seen.add(must(render.render(frame)));
    ASSERT_EQ(gpu().pipelinesCreated(), pipelines) << "frame " << frame;
    ASSERT_EQ(gpu().shaderModulesCreated(), modules) << "frame " << frame;
  }
  std::cout << seen.near.size() << " sets of near lights, " << seen.vectors.size() << " numbers of SH vectors, "
            << seen.effects.size() << " sets of effects\n";
  EXPECT_GE(seen.near.size(), 10u);
  EXPECT_GE(seen.vectors.size(), 5u);
  EXPECT_GE(seen.effects.size(), 2u);
}

std::size_t filesIn(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) count += entry.is_regular_file();
  return count;
}

/// Once the driver's own thread has written what it had to.
std::size_t settledFilesIn(const std::filesystem::path& folder) {
  std::size_t last = 0;
  for (int quiet = 0; quiet < 5;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::size_t now = filesIn(folder);
    quiet = now == last ? quiet + 1 : 0;
    last = now;
  }
  return last;
}

TEST(GpuLoad, TheDriverCompilesNothingAfterItEither) {
  // lavapipe compiles a shader at its first draw, and keeps it in a file each.
  const TemporaryFolder folder;
  if (!isChild()) {
    const ChildOutcome child = runSelf("MESA_SHADER_CACHE_DIR='" + folder.path().string() + "'");
    std::cout << child.output;
    EXPECT_EQ(child.exitCode, 0);
    return;
  }
  const std::filesystem::path cache = std::getenv("MESA_SHADER_CACHE_DIR");
  RenderOptions options = longRun();
  options.run.frames.step = 15;
  SceneRender render = sceneRender(options);
  const std::size_t compiled = settledFilesIn(cache);
  EXPECT_GT(compiled, 0u) << "a driver that keeps no shaders, or keeps them elsewhere";
  Seen seen;
  for (const int frame : render.frames()) seen.add(must(render.render(frame)));
  EXPECT_GE(seen.effects.size(), 2u);
  EXPECT_EQ(settledFilesIn(cache), compiled);
  std::cout << compiled << " files of compiled shaders\n";
}

}  // namespace
}  // namespace rigel::test
