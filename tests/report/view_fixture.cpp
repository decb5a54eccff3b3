#include "view_fixture.h"

#include "report/view3d/view3d_json.h"
#include "report/view3d/view3d_plan.h"

#include <cmath>
#include <numbers>

namespace rigel::tests {
namespace {

using tools::ObjectView;
using tools::ObjectViewFrame;

constexpr int kColumns = 32, kRows = 16;
constexpr float kPi = std::numbers::pi_v<float>;

Vec3 onSphere(int column, int row) {
  const float azimuth = 2 * kPi * static_cast<float>(column) / kColumns, polar = kPi * static_cast<float>(row) / kRows;
  return {std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)};
}

/// Larger for rigs of more vectors is the wrong way round: errors fall with `rig`.
Rgb errorAt(Vec3 n, float time, std::size_t rig) {
  const float size = 0.4f / static_cast<float>(rig + 1);
  return {size * n.x * std::cos(time), 0.8f * size * n.x * std::cos(time), size * n.y * n.z};
}

ObjectViewFrame frameAt(float time, std::size_t rigs, std::size_t lights) {
  ObjectViewFrame frame;
  frame.worldFromLocal.origin = {0, 0.7f, time};
  const Vec3 half{0.8f, 0.6f + 0.1f * std::sin(time), 1.6f};
  std::vector<Vec3> normals;
  for (int row = 0; row <= kRows; ++row)
    for (int column = 0; column < kColumns; ++column) normals.push_back(onSphere(column, row));
  for (const Vec3& n : normals) {
    frame.positions.push_back({half.x * n.x, half.y * n.y, half.z * n.z});
    frame.truth.push_back(Rgb{4, 3.6f, 3} * (1.1f + n.y));
  }
  for (std::size_t r = 0; r < rigs; ++r) {
    ObjectViewFrame::OfRig& rig = frame.rigs.emplace_back();
    rig.box = {-half, half};
    for (std::size_t s = 0; s <= r; ++s)
      rig.samples.push_back(0.5f * frame.positions[(67 * s) % frame.positions.size()]);
    for (const Vec3& n : normals) rig.error.push_back(errorAt(n, time, r));
    for (std::size_t l = 0; l < lights; ++l) {
      const bool near = r + 1 == rigs && l < 3;
      rig.lights.push_back(near         ? static_cast<std::uint8_t>(255 - 100 * l)
                           : l % 5 == 4 ? tools::kViewCulled
                                        : tools::kViewFar);
    }
  }
  return frame;
}

}  // namespace

ObjectView madeUpView(std::size_t frames, std::size_t rigs, std::size_t lights) {
  ObjectView view;
  const auto vertex = [](int column, int row) {
    return static_cast<std::uint16_t>(row * kColumns + column % kColumns);
  };
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      view.triangles.push_back({vertex(column, row), vertex(column + 1, row + 1), vertex(column, row + 1)});
      view.triangles.push_back({vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1)});
    }
  for (std::size_t f = 0; f < frames; ++f) view.frames.push_back(frameAt(0.5f * static_cast<float>(f), rigs, lights));
  return view;
}

void addMadeUpView(tools::SceneReport& scene) {
  constexpr std::size_t kFrames = 5, kLights = 8;
  tools::SceneView view;
  view.frames = tools::spread(scene.objects.front().truth.size(), kFrames);
  for (std::size_t f = 0; f < kFrames; ++f) view.places.emplace_back();
  for (std::size_t i = 0; i < kLights; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kLights;
    view.lights.push_back({static_cast<int>(i), {40, 36, 12 + 8 * static_cast<float>(i)}});
    if (scene.lights[i].type == "spot") view.lights.back().outerAngle = 0.6f;
    for (auto& places : view.places)
      places.push_back(
          {{2.5f * std::cos(angle), 2, 2.5f * std::sin(angle)}, {0, -1, 0}, 0.05f + 0.02f * static_cast<float>(i)});
  }
  scene.view3d = tools::packedScene(view);
  scene.objects.front().view3d =
      tools::packedView(madeUpView(kFrames, scene.objects.front().rigs.size(), kLights), 200'000);
}

}  // namespace rigel::tests
