#include <rigel/light.h>

namespace rigel {
namespace {

template <class... Arrays>
void clearAll(Arrays&... arrays) noexcept {
  (arrays.clear(), ...);
}

template <class... Arrays>
void reserveAll(std::size_t count, Arrays&... arrays) {
  (arrays.reserve(count), ...);
}

}  // namespace

void LightSet::clear() noexcept {
  clearAll(directional_.dx, directional_.dy, directional_.dz, directional_.r, directional_.g, directional_.b);
  for (Local* l : {&point_, &spot_, &sphere_, &disk_})
    clearAll(l->x, l->y, l->z, l->radius, l->range, l->r, l->g, l->b);
  clearAll(cone_.dx, cone_.dy, cone_.dz, cone_.inner, cone_.outer);
  clearAll(face_.dx, face_.dy, face_.dz, face_.twoSided);
  for (std::vector<std::uint32_t>& kind : groups_) kind.clear();
}

void LightSet::reserve(int perKind) {
  const auto n = static_cast<std::size_t>(perKind);
  reserveAll(n, directional_.dx, directional_.dy, directional_.dz, directional_.r, directional_.g, directional_.b);
  for (Local* l : {&point_, &spot_, &sphere_, &disk_})
    reserveAll(n, l->x, l->y, l->z, l->radius, l->range, l->r, l->g, l->b);
  reserveAll(n, cone_.dx, cone_.dy, cone_.dz, cone_.inner, cone_.outer);
  reserveAll(n, face_.dx, face_.dy, face_.dz, face_.twoSided);
  for (std::vector<std::uint32_t>& kind : groups_) kind.reserve(n);
}

void LightSet::Local::push(Vec3 position, float sphereRadius, float windowRange, Rgb colour) {
  x.push_back(position.x);
  y.push_back(position.y);
  z.push_back(position.z);
  radius.push_back(sphereRadius);
  range.push_back(windowRange);
  r.push_back(colour.r);
  g.push_back(colour.g);
  b.push_back(colour.b);
}

void LightSet::add(const DirectionalLight& light, std::uint32_t groups) {
  groups_[0].push_back(groups);
  directional_.dx.push_back(light.direction.x);
  directional_.dy.push_back(light.direction.y);
  directional_.dz.push_back(light.direction.z);
  directional_.r.push_back(light.irradiance.r);
  directional_.g.push_back(light.irradiance.g);
  directional_.b.push_back(light.irradiance.b);
}

void LightSet::add(const PointLight& light, std::uint32_t groups) {
  groups_[1].push_back(groups);
  point_.push(light.position, light.radius, light.range, light.intensity);
}

void LightSet::add(const SpotLight& light, std::uint32_t groups) {
  groups_[2].push_back(groups);
  spot_.push(light.position, light.radius, light.range, light.intensity);
  cone_.dx.push_back(light.direction.x);
  cone_.dy.push_back(light.direction.y);
  cone_.dz.push_back(light.direction.z);
  cone_.inner.push_back(light.innerAngle);
  cone_.outer.push_back(light.outerAngle);
}

void LightSet::add(const SphereLight& light, std::uint32_t groups) {
  groups_[3].push_back(groups);
  sphere_.push(light.position, light.radius, kNoRange, light.radiance);
}

void LightSet::add(const DiskLight& light, std::uint32_t groups) {
  groups_[4].push_back(groups);
  disk_.push(light.position, light.radius, kNoRange, light.radiance);
  face_.dx.push_back(light.direction.x);
  face_.dy.push_back(light.direction.y);
  face_.dz.push_back(light.direction.z);
  face_.twoSided.push_back(light.twoSided ? 1 : 0);
}

}  // namespace rigel
