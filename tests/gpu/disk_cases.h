// Disk lights where they are hard to see: on the axis, all but on the face, at the rim, grazing, far, of any size.
#pragma once

#include <rigel/disk_table.h>
#include <rigel/near_light.h>

#include <cmath>
#include <string>
#include <vector>

#include "gpu/near_rows.h"
#include "gpu/shader_function.h"
#include "lights/describe.h"
#include "lights/random.h"

namespace rigel::test {

/// A disk and a receiver. The light's direction is unit to within rounding, and is the near light's axis to the last
/// bit: what rounding of a direction costs is no matter of shaders.
struct DiskCase {
  DiskLight light;
  Vec3 p;
  Vec3 n{0, 1, 0};

  NearLight near() const {
    NearLight out = nearLight(light);
    out.axis = light.direction;
    return out;
  }
};

enum class DiskFamily { anywhere, onAxis, nearFace, nearRim, grazing, far, anyScale };
inline constexpr DiskFamily kDiskFamilies[] = {DiskFamily::anywhere, DiskFamily::onAxis,  DiskFamily::nearFace,
                                               DiskFamily::nearRim,  DiskFamily::grazing, DiskFamily::far,
                                               DiskFamily::anyScale};
inline const char* nameOf(DiskFamily family) {
  constexpr const char* kNames[] = {"anywhere", "on the axis", "near the face",       "near the rim",
                                    "grazing",  "far",         "from 1e-15 to 1e15 m"};
  return kNames[static_cast<int>(family)];
}

/// Distance from the axis and height, in radii.
struct DiskPlaceOf {
  double rho, z;
};

inline DiskPlaceOf placeAmong(Random& random, DiskFamily family) {
  const double angle = random.uniform(0, M_PI / 2);
  const auto at = [&](double distance) { return DiskPlaceOf{distance * std::cos(angle), distance * std::sin(angle)}; };
  switch (family) {
    case DiskFamily::onAxis:
      return {0, random.logUniform(1e-3, 1e4)};
    case DiskFamily::nearFace:
      return {random.uniform(0, 0.9), random.logUniform(1e-6, 0.1)};
    case DiskFamily::nearRim: {
      const double gap = random.logUniform(1e-3, 0.1), around = random.uniform(0, M_PI);
      return {1 + gap * std::cos(around), gap * std::sin(around)};
    }
    case DiskFamily::grazing: {
      const double rho = random.logUniform(1.1, 1e3);
      return {rho, rho * random.logUniform(1e-5, 0.1)};
    }
    case DiskFamily::far:
      return at(random.logUniform(1e4, 1e9));
    case DiskFamily::anywhere:
    case DiskFamily::anyScale:
      break;
  }
  return at(random.logUniform(1e-2, 1e4));
}

inline Vec3 unitOf(Vec3 v) { return v * (1 / length(v)); }

/// Radiance 1; one in four emits both ways, and of those half are seen from behind.
inline DiskCase diskCase(Random& random, DiskFamily family) {
  const auto [rho, z] = placeAmong(random, family);
  const double radius = family == DiskFamily::anyScale ? random.logUniform(1e-15, 1e15) : random.logUniform(0.01, 100);
  const Vec3 centre = random.pointInCube(2 * radius);
  const bool alongAnAxis = family == DiskFamily::onAxis || random.index(8) == 0;
  constexpr Vec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  DiskCase out;
  out.light = {
      centre, alongAnAxis ? kAxes[random.index(6)] : random.direction(), static_cast<float>(radius), {1, 1, 1}};
  out.light.twoSided = random.index(4) == 0;
  const bool behind = out.light.twoSided && random.index(2) == 0;
  const Vec3 side = unitOf(cross(out.light.direction, random.direction()));
  out.p = centre + side * static_cast<float>(rho * radius) +
          out.light.direction * static_cast<float>((behind ? -z : z) * radius);
  return out;
}

inline std::string describe(const DiskCase& c) {
  return describe(c.light) + ", p " + describe(c.p) + ", n " + describe(c.n);
}

/// Rows of kNearInputs.
inline std::vector<float> rowsOf(const std::vector<DiskCase>& cases, const NearWrap& wrap) {
  std::vector<float> rows;
  for (const DiskCase& c : cases) {
    append(rows, gpuNearLight(c.near()));
    append(rows, wrap);
    append(rows, c.p);
    append(rows, c.n);
  }
  return rows;
}

/// Both textures of the table, one after the other, as texels.
inline void setDiskTable(tools::ShaderFunction& function) {
  std::vector<float> both(DiskTable::data(0).begin(), DiskTable::data(0).end());
  both.insert(both.end(), DiskTable::data(1).begin(), DiskTable::data(1).end());
  function.setTexels(both);
}

}  // namespace rigel::test
