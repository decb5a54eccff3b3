// The car of `street` and `figure1`: lofted body, glass, lamps and four wheels; 4.5 x 1.5 x 1.8 m, front towards +z.
#pragma once

#include "scene/scene.h"

#include <array>

namespace rigel::tools {

inline constexpr float kCarLength = 4.5f, kCarHeight = 1.5f, kCarWidth = 1.8f;
inline constexpr float kWheelRadius = 0.33f;

struct Car {
  int node = -1;                // marked isObject; on the ground below the middle of the car
  std::array<int, 4> wheels{};  // nodes at the wheels' centres; rolling forward turns them about +x
};

/// Adds car and materials to `scene`.
Car addCar(Scene& scene, glm::vec3 paint);

}  // namespace rigel::tools
