// A row of lamps on both sides of a way along x, for tests of what drives past them.
#pragma once

#include <rigel/light.h>

#include <random>

namespace rigel::test {

inline LightSet lampRow() {
  LightSet lamps;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 24; ++i) {
    const float side = i % 2 == 0 ? -1.0f : 1.0f;
    const Vec3 p{-8 + 1.1f * static_cast<float>(i), 0.5f + 2 * unit(random), side * (1.2f + 1.5f * unit(random))};
    const float bright = 5 + 20 * unit(random);
    lamps.add(SphereLight{p, 0.1f, {bright, bright, bright}});
  }
  return lamps;
}

}  // namespace rigel::test
