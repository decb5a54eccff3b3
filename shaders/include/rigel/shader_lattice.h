// b(t): how the nodes on both sides of a lattice cell count at t in [0, 1] of the cell. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_LATTICE_H
#define RIGEL_SHADER_LATTICE_H

#include "rigel/shader_language.h"

#ifdef __cplusplus
#define rigel_latticeSmooth latticeSmooth
#define rigel_latticeInner latticeInner
#define rigel_latticeOuter latticeOuter
namespace rigel::detail {
#endif

/// Smoothstep: what the far node counts; flat at the nodes.
RIGEL_FUNCTION float rigel_latticeSmooth(float t) RIGEL_NOEXCEPT { return t * t * (3.0f - 2.0f * t); }

/// Catmull-Rom: what the node at 0 counts, that at 1 with 1 - t.
RIGEL_FUNCTION float rigel_latticeInner(float t) RIGEL_NOEXCEPT { return 1.0f - t * t * (2.5f - 1.5f * t); }

/// Catmull-Rom: what the node at -1 counts, that at 2 with 1 - t.
RIGEL_FUNCTION float rigel_latticeOuter(float t) RIGEL_NOEXCEPT { return -0.5f * t * (1.0f - t) * (1.0f - t); }

#ifdef __cplusplus
}  // namespace rigel::detail
#endif

#endif
