// Uses the libraries through the installed package: a light projected, a rig fitted, its value beside the truth; a disk
// looked up.
#include <rigel/disk_table.h>
#include <rigel/exact.h>
#include <rigel/rig_light.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  // A light far away compared with the object: there what separates a gradient rig from the truth is the band limit.
  constexpr float kTolerance = 0.1f;  // three bands overshoot a lamp straight above by 1/16
  rigel::LightSet lights;
  lights.add(rigel::SphereLight{.position = {3, 10, 1}, .radius = 0.5f, .radiance = {800, 700, 500}});

  const rigel::Vec3 corners[] = {{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1},
                                 {-1, 1, -1}, {1, 1, -1}, {-1, 1, 1}, {1, 1, 1}};
  const auto spec = rigel::parseRigSpec("gradient");
  if (!spec) return std::fprintf(stderr, "%s\n", spec.error().line().c_str()), 1;
  const auto rig = rigel::Rig::create(*spec, {.box = {{-1, 0, -1}, {1, 1, 1}}, .surface = corners});
  if (!rig) return std::fprintf(stderr, "%s\n", rig.error().line().c_str()), 1;

  std::vector<rigel::RadianceSH<3>> projected(rig->projections()), fitted(rig->shVectors());
  rigel::projectSamples<3>(*rig, {}, lights, projected);
  rigel::fitRig<3>(*rig, projected, fitted);

  const rigel::Vec3 p{0.5f, 0.75f, -0.25f}, up{0, 1, 0};
  const float fromRig =
      rigel::irradiance<3>(rigel::evaluateRig<3>(*rig, fitted, p), rigel::wrapCoefficients<3>(0), up).r;
  const float exact = static_cast<float>(rigel::exactIrradiance(lights, p, up).r);
  std::printf("rig %g, exact %g\n", fromRig, exact);
  // On the face of a disk half of all directions see it: 2 pi Y_00.
  const rigel::DiskLight panel{.position = {0, 2, 0}, .radius = 1, .radiance = {1, 1, 1}};
  const float onFace = rigel::DiskTable::project<3>(panel, {0, 1.999999f, 0})[0].r;
  if (!(std::fabs(onFace - 1.772454f) < 1e-4f)) return std::fprintf(stderr, "disk %g\n", onFace), 1;
  return exact > 0 && std::fabs(fromRig - exact) <= kTolerance * exact ? 0 : 1;
}
