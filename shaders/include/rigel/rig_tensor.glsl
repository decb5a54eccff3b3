// gradient, lattice and mixed rigs: per axis of the box nodes, a slope or nothing.
//
// What shapes the rig comes from the rig, or from what an entry shader defines instead; of specialisation constants
// nothing is left but the nodes and slopes that there are.
//   RIGEL_NODES(rig)     ivec3: nodes along the axes
//   RIGEL_SLOPE(rig)     ivec3: which of a node's vectors is the slope along the axis, 1 to 3, or 0
//   RIGEL_PER_NODE(rig)  vectors a node
//   RIGEL_KERNEL(rig)    kGpuLinear, kGpuSmooth or kGpuCubic
//   RIGEL_GAUSS(source, rig, i)  vec4 i of the nodes of @gauss, which are in the coefficients' buffer unless defined;
//                                a buffer of half floats cannot hold them
#ifndef RIGEL_RIG_TENSOR_GLSL
#define RIGEL_RIG_TENSOR_GLSL

#include "rigel/rig_source.glsl"
#include "rigel/shader_lattice.h"
#include "rigel/shader_types.h"

#ifndef RIGEL_OFFSET
#define RIGEL_OFFSET(rig) rig.offset
#endif
#ifndef RIGEL_NODES
#define RIGEL_NODES(rig) rig.nodes
#endif
#ifndef RIGEL_SLOPE
#define RIGEL_SLOPE(rig) rig.slope
#endif
#ifndef RIGEL_PER_NODE
#define RIGEL_PER_NODE(rig) rig.perNode
#endif
#ifndef RIGEL_KERNEL
#define RIGEL_KERNEL(rig) rig.kernel
#endif
#ifndef RIGEL_GAUSS
#define RIGEL_GAUSS(source, rig, i) RIGEL_FETCH(source, rig.gaussOffset + (i))
#endif

// A node's value and slopes; `at` is the vec4 of its value, b its weight.
#define RIGEL_NODE(ADD, at, b)                                                \
  ADD(at, b)                                                                  \
  if (slope.x > 0) { ADD((at) + slope.x * RIGEL_SH_VEC4, (b) * u.x) }         \
  if (slope.y > 0) { ADD((at) + slope.y * RIGEL_SH_VEC4, (b) * u.y) }         \
  if (slope.z > 0) { ADD((at) + slope.z * RIGEL_SH_VEC4, (b) * u.z) }

/// The cell of u along an axis of `nodes` equidistant nodes, the outermost at -1 and 1, and the place in it, 0 to 1.
void rigel_latticeCell(int nodes, float u, out int cell, out float t) {
  float x = (clamp(u, -1.0, 1.0) + 1.0) * 0.5 * float(nodes - 1);
  cell = max(min(int(x), nodes - 2), 0);
  t = x - float(cell);
}

/// Catmull-Rom weights of nodes cell - 1 to cell + 2. What an outer node that does not exist counts goes to the inner
/// ones, as if it were 2 p0 - p1.
vec4 rigel_cubicWeights(int nodes, int cell, float t) {
  if (nodes == 1) return vec4(0.0, 1.0, 0.0, 0.0);
  vec4 w = vec4(rigel_latticeOuter(t), rigel_latticeInner(t), rigel_latticeInner(1.0 - t), rigel_latticeOuter(1.0 - t));
  if (cell + 2 >= nodes) w = vec4(w.x, w.y - w.w, w.z + 2.0 * w.w, 0.0);
  if (cell == 0) w = vec4(0.0, w.y + 2.0 * w.x, w.z - w.x, w.w);
  return w;
}

// Two nodes an axis, one where there is no lattice, unrolled.
#define RIGEL_LATTICE_X(ADD, row, b)                                                     \
  RIGEL_NODE(ADD, row, (b) * near.x)                                                     \
  if (nodes.x > 1) { RIGEL_NODE(ADD, (row) + step.x, (b) * far.x) }
#define RIGEL_LATTICE_Y(ADD, row, b)                                                     \
  RIGEL_LATTICE_X(ADD, row, (b) * near.y)                                                \
  if (nodes.y > 1) { RIGEL_LATTICE_X(ADD, (row) + step.y, (b) * far.y) }
#define RIGEL_LATTICE(ADD)                                                               \
  RIGEL_LATTICE_Y(ADD, first, near.z)                                                    \
  if (nodes.z > 1) { RIGEL_LATTICE_Y(ADD, first + step.z, far.z) }

// Four nodes an axis.
#define RIGEL_LATTICE_CUBIC(ADD)                                                                          \
  mat3x4 w = mat3x4(rigel_cubicWeights(nodes.x, cell.x, t.x), rigel_cubicWeights(nodes.y, cell.y, t.y),   \
                    rigel_cubicWeights(nodes.z, cell.z, t.z));                                            \
  for (int k = 0; k < 64; ++k) {                                                                          \
    ivec3 i = ivec3(k & 3, (k >> 2) & 3, k >> 4);                                                         \
    float b = w[0][i.x] * w[1][i.y] * w[2][i.z];                                                          \
    if (b != 0.0) {                                                                                       \
      ivec3 node = i - 1;                                                                                 \
      int at = first + node.x * step.x + node.y * step.y + node.z * step.z;                               \
      RIGEL_NODE(ADD, at, b)                                                                              \
    }                                                                                                     \
  }

#define RIGEL_TENSOR(ADD)                                                                    \
  ivec3 nodes = RIGEL_NODES(rig);                                                            \
  ivec3 slope = RIGEL_SLOPE(rig);                                                            \
  ivec3 cell;                                                                                \
  vec3 t;                                                                                    \
  rigel_latticeCell(nodes.x, u.x, cell.x, t.x);                                              \
  rigel_latticeCell(nodes.y, u.y, cell.y, t.y);                                              \
  rigel_latticeCell(nodes.z, u.z, cell.z, t.z);                                              \
  ivec3 step = RIGEL_PER_NODE(rig) * RIGEL_SH_VEC4 * ivec3(1, nodes.x, nodes.x * nodes.y);   \
  int first = RIGEL_OFFSET(rig) + cell.x * step.x + cell.y * step.y + cell.z * step.z;       \
  if (RIGEL_KERNEL(rig) == kGpuCubic) {                                                      \
    RIGEL_LATTICE_CUBIC(ADD)                                                                 \
  } else {                                                                                   \
    vec3 far = t;                                                                            \
    if (RIGEL_KERNEL(rig) == kGpuSmooth)                                                     \
      far = vec3(rigel_latticeSmooth(t.x), rigel_latticeSmooth(t.y), rigel_latticeSmooth(t.z)); \
    vec3 near = 1.0 - far;                                                                   \
    RIGEL_LATTICE(ADD)                                                                       \
  }

/// As rigel_polyIrradiance. `u` is held to the box along lattice axes, not along slopes.
vec3 rigel_tensorIrradiance(RIGEL_SOURCE source, GpuRig rig, vec3 u, float y[RIGEL_SH_COUNT]) {
  vec3 e = vec3(0.0);
  RIGEL_TENSOR(RIGEL_ADD_IRRADIANCE)
  return e;
}

/// As rigel_polySh.
void rigel_tensorSh(RIGEL_SOURCE source, GpuRig rig, vec3 u, out vec3 sh[RIGEL_SH_COUNT]) {
  rigel_clearSh(sh);
  RIGEL_TENSOR(RIGEL_ADD_SH)
}

// @gauss: every node of every axis counts. Nodes are in vec4 pairs of node and 1 / prod (node - others), x before y
// before z, each axis beginning a vec4.
#define RIGEL_GAUSS_MAX 64

/// The Lagrange polynomials of an axis at u, whose nodes begin at vec4 `at`: products of the differences before and
/// after each node, so that u may be a node.
void rigel_lagrange(RIGEL_SOURCE source, GpuRig rig, int at, int nodes, float u, out float w[RIGEL_GAUSS_MAX]) {
  float v = clamp(u, -1.0, 1.0);
  float before = 1.0;
  for (int i = 0; i < nodes; ++i) {
    vec4 pair = RIGEL_GAUSS(source, rig, at + (i >> 1));
    vec2 node = (i & 1) == 0 ? pair.xy : pair.zw;
    w[i] = before * node.y;
    before *= v - node.x;
  }
  float after = 1.0;
  for (int i = nodes - 1; i >= 0; --i) {
    vec4 pair = RIGEL_GAUSS(source, rig, at + (i >> 1));
    w[i] *= after;
    after *= v - ((i & 1) == 0 ? pair.x : pair.z);
  }
}

#define RIGEL_GAUSS_NODES(ADD)                                                                     \
  ivec3 nodes = RIGEL_NODES(rig);                                                                  \
  ivec3 slope = RIGEL_SLOPE(rig);                                                                  \
  float wx[RIGEL_GAUSS_MAX];                                                                       \
  float wy[RIGEL_GAUSS_MAX];                                                                       \
  float wz[RIGEL_GAUSS_MAX];                                                                       \
  ivec3 pairs = (nodes + 1) >> 1;                                                                  \
  rigel_lagrange(source, rig, 0, nodes.x, u.x, wx);                                                \
  rigel_lagrange(source, rig, pairs.x, nodes.y, u.y, wy);                                          \
  rigel_lagrange(source, rig, pairs.x + pairs.y, nodes.z, u.z, wz);                                \
  int at = RIGEL_OFFSET(rig);                                                                      \
  for (int k = 0; k < nodes.z; ++k) {                                                              \
    for (int j = 0; j < nodes.y; ++j) {                                                            \
      float row = wz[k] * wy[j];                                                                   \
      for (int i = 0; i < nodes.x; ++i) {                                                          \
        RIGEL_NODE(ADD, at, row * wx[i])                                                           \
        at += RIGEL_PER_NODE(rig) * RIGEL_SH_VEC4;                                                 \
      }                                                                                            \
    }                                                                                              \
  }

/// As rigel_polyIrradiance.
vec3 rigel_gaussIrradiance(RIGEL_SOURCE source, GpuRig rig, vec3 u, float y[RIGEL_SH_COUNT]) {
  vec3 e = vec3(0.0);
  RIGEL_GAUSS_NODES(RIGEL_ADD_IRRADIANCE)
  return e;
}

/// As rigel_polySh.
void rigel_gaussSh(RIGEL_SOURCE source, GpuRig rig, vec3 u, out vec3 sh[RIGEL_SH_COUNT]) {
  rigel_clearSh(sh);
  RIGEL_GAUSS_NODES(RIGEL_ADD_SH)
}

#endif
