// An object with normals, lit by ObjectLighting, and what is wrong with its lighting: against SH of the same bands at
// every point, and against exact irradiance.
#pragma once

#include <rigel/exact.h>
#include <rigel/object_lighting.h>

#include <algorithm>

#include "rig_fixture.h"

namespace rigel::test {

struct Body {
  std::vector<Vec3> points, normals;
  RigBox box;

  RigShape shape() const { return {box, points}; }
};

inline Body ellipsoidBody(Vec3 half, int count, Vec3 centre = {}) {
  Body body{ellipsoid(centre, half, count), {}, {}};
  const std::vector<Vec3> unit = ellipsoid({}, {1, 1, 1}, count);
  for (Vec3 u : unit) {
    // (x/a^2, y/b^2, z/c^2) without dividing by a flat axis.
    const Vec3 n{u.x * half.y * half.z, u.y * half.z * half.x, u.z * half.x * half.y};
    const float size = length(n);
    body.normals.push_back(size > 0 ? n * (1 / size) : u);
  }
  body.box = boxOf(body.points);
  return body;
}

/// RMS over points and channels [W/m2].
struct LightingErrors {
  double spatial = 0, total = 0;
  double mean = 0;  // irradiance over points and all normals: the reference of errors by default
  bool finite = true;
};

template <int B>
class LitBody {
 public:
  LitBody(const std::string& spec, const Body& body, const LightingOptions& options)
      : body_(body), wrap_(options.wrap), material_(options.wrap), lighting(make(spec, body, options)) {
    place({});
  }

  void place(Vec3 origin) {
    frame_.origin = origin;
    anchors_.clear();
    for (int i : lighting.anchors()) anchors_.push_back(body_.points[i]);
    lighting.setPose({body_.box, anchors_}, frame_);
  }

  const RigFrame& frame() const { return frame_; }
  Vec3 world(std::size_t point) const { return frame_.point(body_.points[point]); }
  typename ObjectLighting<B>::Parts shade(std::size_t point) const {
    return lighting.shade(world(point), body_.normals[point], material_);
  }

  /// At every `every`-th point.
  LightingErrors errors(const LightSet& lights, int every = 1) const {
    LightingErrors out;
    const auto verdicts = lighting.verdicts();
    const auto f = wrapCoefficients<B>(wrap_);
    double count = 0;
    for (std::size_t p = 0; p < body_.points.size(); p += static_cast<std::size_t>(every)) {
      const auto parts = shade(p);
      std::array<double, 3> sh{}, exact{};
      for (int i = 0; i < lights.size(); ++i) {
        const double weight = verdicts.empty() ? 0 : static_cast<double>(verdicts[i].weight);
        lights.visit(i, [&](const auto& light) {
          const Rgb inRig = irradiance<B>(project<B>(light, world(p)), f, body_.normals[p]);
          const RgbD truth = exactIrradiance(light, world(p), body_.normals[p], wrap_);
          const Rgb l00 = project<B>(light, world(p))[0];
          for (int c = 0; c < 3; ++c) {
            out.mean += kPi * 0.28209479177387814 * static_cast<double>(f[0] * l00[c]);
            sh[c] += (1 - weight) * static_cast<double>(inRig[c]);
            exact[c] += truth[c];
          }
        });
      }
      for (int c = 0; c < 3; ++c) {
        const auto rig = static_cast<double>(parts.rig[c]), near = static_cast<double>(parts.nearLights[c]);
        out.finite = out.finite && std::isfinite(rig) && std::isfinite(near);
        out.spatial += std::pow(rig - sh[c], 2);
        out.total += std::pow(std::max(0.0, rig) + near - exact[c], 2);
        ++count;
      }
    }
    out.spatial = std::sqrt(out.spatial / count);
    out.total = std::sqrt(out.total / count);
    out.mean /= count;
    return out;
  }

 private:
  static ObjectLighting<B> make(const std::string& spec, const Body& body, const LightingOptions& options) {
    auto lighting = ObjectLighting<B>::create(specOf(spec), body.shape(), options);
    EXPECT_TRUE(lighting) << (lighting ? "" : lighting.error().line());
    return *std::move(lighting);
  }

  Body body_;
  float wrap_;
  MaterialWrap<B> material_;
  RigFrame frame_;
  std::vector<Vec3> anchors_;

 public:
  ObjectLighting<B> lighting;
};

/// `count` sphere, point and spot lights around an object of size 1, from 0.2 to 8 away; log-uniform power.
inline LightSet lightsAround(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> normal;
  LightSet lights;
  for (int i = 0; i < count; ++i) {
    Vec3 d{normal(random), normal(random), normal(random)};
    d = d * (1 / length(d));
    const float away = 0.2f * std::exp2(5.3f * unit(random));
    const Vec3 p = Vec3{1.5f * d.x, 0.7f * d.y, 0.7f * d.z} + d * away;
    const float power = std::exp2(5 * unit(random));
    const Rgb colour{power, power * (0.5f + 0.5f * unit(random)), power * (0.4f + 0.6f * unit(random))};
    if (i % 4 == 0) {
      lights.add(SpotLight{p, -d, colour, 0.3f, 0.7f});
    } else if (i % 4 == 1) {
      lights.add(PointLight{p, colour});
    } else {
      lights.add(SphereLight{p, 0.1f, colour * 30.0f});
    }
  }
  return lights;
}

}  // namespace rigel::test
