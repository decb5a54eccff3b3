// What the GPU gives back of a frame.
#pragma once

#include "picture/image.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace rigel::tools {

/// One entry a pixel, rows from the top, taken at the pixel's centre.
struct RenderedFrame {
  static constexpr std::uint32_t kNothing = 0;

  int width = 0, height = 0;
  std::vector<Rgb> irradiance;          // [W/m2], clamped; of lights and where nothing is, 0
  std::vector<Rgb> radiance;            // towards the camera; scenery dimmed, lights as bright as they are shown
  std::vector<std::uint32_t> part;      // 1 + the number of the object drawn (lights last), or kNothing
  std::vector<std::uint32_t> triangle;  // of that object
  double milliseconds = 0;              // the device's time for the draws
};

/// The points behind a RenderedFrame's pixels, as its shaders had them.
struct RenderedPoints {
  std::vector<glm::vec3> position;  // world
  std::vector<glm::vec3> normal;    // world, unit
};

}  // namespace rigel::tools
