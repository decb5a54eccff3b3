#include "gpu_rig_reader.h"

#include "model.h"
#include "poly_model.h"
#include "tensor_model.h"

#include <cassert>

namespace rigel {
namespace {

using shader_types::ivec4;
using shader_types::vec4;

static_assert(static_cast<int>(LatticeKernel::linear) == shader_types::kGpuLinear);
static_assert(static_cast<int>(LatticeKernel::smooth) == shader_types::kGpuSmooth);
static_assert(static_cast<int>(LatticeKernel::cubic) == shader_types::kGpuCubic);
static_assert(sizeof(GpuRig::terms) >= kMaxPolyTerms);

int& component(ivec4& v, int i) noexcept { return i == 0 ? v.x : i == 1 ? v.y : i == 2 ? v.z : v.w; }

}  // namespace

void placeRigBox(const RigBox& box, const RigFrame& worldFromRig, GpuRig& out) noexcept {
  const std::array<Vec3, 3> columns{worldFromRig.x, worldFromRig.y, worldFromRig.z};
  std::array<double, 3> centre{};
  for (int i = 0; i < 3; ++i) {
    centre[i] = static_cast<double>(worldFromRig.origin[i]);
    for (int a = 0; a < 3; ++a)
      centre[i] +=
          static_cast<double>(columns[a][i]) * (static_cast<double>(box.lo[a]) + static_cast<double>(box.hi[a])) / 2;
  }
  out.centre = {static_cast<float>(centre[0]), static_cast<float>(centre[1]), static_cast<float>(centre[2])};
  const std::array<double, 3> lost{static_cast<double>(out.centre.x) - centre[0],
                                   static_cast<double>(out.centre.y) - centre[1],
                                   static_cast<double>(out.centre.z) - centre[2]};
  const BoxCoordinates coordinates(box);
  const std::array<vec4*, 3> axes{&out.axisX, &out.axisY, &out.axisZ};
  for (int a = 0; a < 3; ++a) {
    if (coordinates.inverseHalf[a] == 0) continue;
    const double inverse = 2 / (static_cast<double>(box.hi[a]) - static_cast<double>(box.lo[a]));
    double w = 0;
    for (int i = 0; i < 3; ++i) w += static_cast<double>(columns[a][i]) * lost[i] * inverse;
    const auto entry = [&](int i) { return static_cast<float>(static_cast<double>(columns[a][i]) * inverse); };
    *axes[a] = {entry(0), entry(1), entry(2), static_cast<float>(w)};
  }
}

GpuRig GpuRigReader::describe(const RigFrame& worldFromRig) const noexcept {
  assert(!checkGpuRig(rig_.spec()));
  GpuRig out{};
  placeRigBox(rig_.box(), worldFromRig, out);
  out.nodes = {1, 1, 1};
  out.perNode = 1;
  if (rig_.spec().family == RigSpec::Family::poly) {
    describePoly(out);
  } else {
    describeTensor(out);
  }
  return out;
}

GpuRigReader::Term GpuRigReader::term(int k) const noexcept {
  const auto& model = static_cast<const Rig::PolyModel&>(*rig_.model_);
  return {model.divisor(k), model.axis(k)};
}

void GpuRigReader::describePoly(GpuRig& out) const noexcept {
  const auto& model = static_cast<const Rig::PolyModel&>(*rig_.model_);
  out.kind = rig_.spec().falloff ? shader_types::kGpuRigInvquad : shader_types::kGpuRigPoly;
  for (int k = 0; k < rig_.shVectors(); ++k) {
    const int packed = term(k).from * 4 + term(k).axis;
    component(out.terms[k / 16], k / 4 % 4) |= packed << (8 * (k % 4));
  }
  const auto& q = model.falloff().coefficients();
  out.falloff[0] = {q[0], q[1], q[2], q[3]};
  out.falloff[1] = {q[4], q[5], q[6], q[7]};
  out.falloff[2] = {q[8], q[9], 0, 0};
}

void GpuRigReader::describeTensor(GpuRig& out) const noexcept {
  const std::array<AxisModel, 3>& axes = rig_.axes();
  out.nodes = {axes[0].nodes, axes[1].nodes, axes[2].nodes};
  out.kernel = static_cast<int>(rig_.spec().kernel);
  const auto slope = [&](int a) { return axes[a].kind == AxisModel::Kind::gradient ? out.perNode++ : 0; };
  out.slope.x = slope(0);
  out.slope.y = slope(1);
  out.slope.z = slope(2);
  if (rig_.shVectors() == 1) {
    out.kind = shader_types::kGpuRigConstant;
  } else {
    out.kind = rig_.spec().fit == FitMethod::gauss ? shader_types::kGpuRigGauss : shader_types::kGpuRigTensor;
  }
}

void GpuRigReader::gaussNodes(std::span<GpuVec4> out) const noexcept {
  const auto& model = static_cast<const Rig::TensorModel&>(*rig_.model_);
  auto to = out.begin();
  for (int a = 0; a < 3; ++a) {
    const std::span<const float> node = model.gaussAxis(a).nodes();
    const std::span<const float> inverse = model.gaussAxis(a).inverseScales();
    for (std::size_t i = 0; i < node.size(); i += 2) {
      const bool pair = i + 1 < node.size();
      *to++ = {node[i], inverse[i], pair ? node[i + 1] : 0, pair ? inverse[i + 1] : 0};
    }
  }
}

}  // namespace rigel
