// The effects that a scene may call for: one line each, for the runtime (effects.h), the shaders' specialisation
// constants and the names in reports. Parsed by C++ and GLSL.
//
// X(name, id): `id` is the specialisation constant. In reports "_" reads "." and capitals are set apart:
// rig_highBand is "rig.high_band". No shader knows rig_rbf, rig_latticegrad and rig_hermite: those rigs are the CPU's
// alone (gpu_rig.h).
#ifndef RIGEL_SHADER_EFFECTS_H
#define RIGEL_SHADER_EFFECTS_H

#define RIGEL_EFFECTS(X)           \
  X(light_directional, 0)          \
  X(light_point, 1)                \
  X(light_spot, 2)                 \
  X(light_sphere, 3)               \
  X(light_near_directional, 4)     \
  X(light_near_point, 5)           \
  X(light_near_spot, 6)            \
  X(light_near_sphere, 7)          \
  X(light_near_wrap, 8)            \
  X(material_wrap, 9)              \
  X(rig_auto, 10)                  \
  X(rig_constant, 11)              \
  X(rig_poly, 12)                  \
  X(rig_invquad, 13)               \
  X(rig_tensor, 14)                \
  X(rig_gauss, 15)                 \
  X(rig_texture, 16)               \
  X(rig_highBand, 17)              \
  X(light_disk, 18)                \
  X(light_near_disk, 19)           \
  X(light_near_diskTable, 20)      \
  X(light_near_diskQuadrature, 21) \
  X(rig_rbf, 22)                   \
  X(rig_latticegrad, 23)           \
  X(rig_hermite, 24)

#endif
