// Rigs of every kind at a point of the world.
//
// What a scene lacks is left out by what an entry shader defines, of specialisation constants, before the include:
//   RIGEL_HAS_KIND(kind)      whether any rig is of a kind (kGpuRigPoly, ...)
//   RIGEL_IS_KIND(rig, kind)  whether the rig is: constants where all are alike
//   RIGEL_SCALE(rig)          1.0 where all coefficients are float32
// and what is in rig_source.glsl, rig_poly.glsl and rig_tensor.glsl.
#ifndef RIGEL_RIG_GLSL
#define RIGEL_RIG_GLSL

#include "rigel/rig_box.glsl"
#include "rigel/rig_poly.glsl"
#include "rigel/rig_source.glsl"
#include "rigel/rig_tensor.glsl"
#include "rigel/shader_types.h"

#ifndef RIGEL_HAS_KIND
#define RIGEL_HAS_KIND(rigKind) true
#endif
#ifndef RIGEL_IS_KIND
#define RIGEL_IS_KIND(rig, rigKind) (RIGEL_HAS_KIND(rigKind) && rig.kind == (rigKind))
#endif
#ifndef RIGEL_SCALE
#define RIGEL_SCALE(rig) rig.scale
#endif

/// Irradiance [W/m2] from the rig at `p` (m, world), not clamped. `y` is the SH basis of the normal times f_l(a), made
/// once a point. A rig without vectors gives 0.
vec3 rigel_rigIrradiance(RIGEL_SOURCE source, GpuRig rig, vec3 p, float y[RIGEL_SH_COUNT]) {
  vec3 e = vec3(0.0);
  if (RIGEL_IS_KIND(rig, kGpuRigConstant) && RIGEL_VECTORS(rig) > 0) {
    e = rigel_dotVector(source, RIGEL_OFFSET(rig), y);
  } else if (RIGEL_VECTORS(rig) > 0) {
    vec3 u = rigel_boxCoordinates(rig, p);
    if (RIGEL_IS_KIND(rig, kGpuRigPoly) || RIGEL_IS_KIND(rig, kGpuRigInvquad))
      e = rigel_polyIrradiance(source, rig, u, y);
    if (RIGEL_IS_KIND(rig, kGpuRigInvquad)) e /= rigel_falloff(rig, u);
    if (RIGEL_IS_KIND(rig, kGpuRigTensor)) e = rigel_tensorIrradiance(source, rig, u, y);
    if (RIGEL_IS_KIND(rig, kGpuRigGauss)) e = rigel_gaussIrradiance(source, rig, u, y);
  }
  return e * RIGEL_SCALE(rig);
}

/// pi times the radiance SH at `p`.
void rigel_rigSh(RIGEL_SOURCE source, GpuRig rig, vec3 p, out vec3 sh[RIGEL_SH_COUNT]) {
  float scale = RIGEL_SCALE(rig);
  rigel_clearSh(sh);
  if (RIGEL_IS_KIND(rig, kGpuRigConstant) && RIGEL_VECTORS(rig) > 0) {
    rigel_addVector(source, RIGEL_OFFSET(rig), 1.0, sh);
  } else if (RIGEL_VECTORS(rig) > 0) {
    vec3 u = rigel_boxCoordinates(rig, p);
    if (RIGEL_IS_KIND(rig, kGpuRigPoly) || RIGEL_IS_KIND(rig, kGpuRigInvquad)) rigel_polySh(source, rig, u, sh);
    if (RIGEL_IS_KIND(rig, kGpuRigInvquad)) scale /= rigel_falloff(rig, u);
    if (RIGEL_IS_KIND(rig, kGpuRigTensor)) rigel_tensorSh(source, rig, u, sh);
    if (RIGEL_IS_KIND(rig, kGpuRigGauss)) rigel_gaussSh(source, rig, u, sh);
  }
  for (int i = 0; i < RIGEL_SH_COUNT; ++i) sh[i] *= scale;
}

#endif
