#include "gpu/rig_cases.h"

#include "rigs/rig_fixture.h"

namespace rigel::test {

const std::vector<RigBody>& rigBodies() {
  static const std::vector<RigBody> bodies = [] {
    std::vector<RigBody> all;
    const auto add = [&](const std::string& name, Vec3 centre, Vec3 half) {
      const auto surface = ellipsoid(centre, half, 300);
      all.push_back({name, surface, boxOf(surface)});
    };
    add("body", {0.5f, 1, -2}, {2, 0.4f, 0.8f});
    add("ball", {}, {1, 1, 1});
    add("plate", {-3, 0.25f, 1}, {1, 0, 0.7f});
    add("thread", {0.1f, 0, 0}, {4, 1e-3f, 1e-3f});
    add("point", {1, 2, 3}, {});
    return all;
  }();
  return bodies;
}

RigFrame randomFrame(Random& random, double distance) {
  const auto unit = [](Vec3 v) { return v * (1 / length(v)); };
  RigFrame frame;
  frame.x = random.direction();
  frame.y = unit(cross(frame.x, random.direction()));
  frame.z = cross(frame.x, frame.y);
  frame.origin = random.direction() * static_cast<float>(distance);
  return frame;
}

Rig rigOn(const std::string& spec, const RigBody& body, Random& random) {
  auto rig = Rig::create(specOf(spec), {body.box, body.surface});
  EXPECT_TRUE(rig) << (rig ? "" : rig.error().line());
  const Vec3 light = (body.box.lo + body.box.hi) * 0.5f + random.direction() * random.uniformf(2, 5);
  std::vector<float> functionals;
  for (const RigSample& sample : rig->samples()) {
    const Vec3 d = sample.position - light;
    for (int i = 0; i < 3; ++i) functionals.push_back(1 / dot(d, d));
  }
  if (rig->spec().falloff) rig->adapt(functionals, 3);
  return *std::move(rig);
}

std::vector<Vec3> rigPoints(const RigBox& box, const RigFrame& frame, int count, Random& random) {
  const Vec3 centre = box.lo * 0.5f + box.hi * 0.5f;
  const Vec3 half = box.hi * 0.5f - box.lo * 0.5f;
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 u = random.pointInCube(1);
    if (i % 10 == 7)
      for (int a = 0; a < 3; ++a) u[a] = static_cast<float>(random.index(3) - 1);
    if (i % 10 == 8)
      for (int a = 0; a < 3; ++a) u[a] = static_cast<float>(random.index(15) - 7) / 7;
    if (i % 10 > 8) u = u * 3;
    Vec3 p = frame.point(centre + Vec3{half.x * u.x, half.y * u.y, half.z * u.z});
    if (i % 50 == 3) p[random.index(3)] = std::nanf("");
    if (i % 50 == 23) p = p + random.pointInCube(1);  // off the plane of a flat body
    points.push_back(p);
  }
  return points;
}

}  // namespace rigel::test
