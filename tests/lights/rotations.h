// Random rotations and their algebra.
#pragma once

#include <rigel/sh_rotation.h>

#include "lights/random.h"

namespace rigel::test {

/// Uniform over all rotations: a random unit quaternion.
inline Rotation randomRotation(Random& random) {
  double q[4];
  double norm = 0;
  do {
    norm = 0;
    for (double& v : q) {
      v = random.uniform(-1, 1);
      norm += v * v;
    }
  } while (norm > 1 || norm < 0.01);
  for (double& v : q) v /= std::sqrt(norm);
  const auto [w, x, y, z] = q;
  const double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  Rotation r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.m[i][j] = static_cast<float>(m[i][j]);
  }
  return r;
}

inline Vec3 rotate(const Rotation& r, Vec3 v) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = r.m[i][0] * v.x + r.m[i][1] * v.y + r.m[i][2] * v.z;
  return out;
}

inline Rotation transpose(const Rotation& r) {
  Rotation out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.m[i][j] = r.m[j][i];
  }
  return out;
}

inline Rotation compose(const Rotation& a, const Rotation& b) {
  Rotation out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
  }
  return out;
}

}  // namespace rigel::test
