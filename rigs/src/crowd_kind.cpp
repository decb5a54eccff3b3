#include "crowd_kind.h"

#include <algorithm>
#include <cmath>

#include "gpu_rig_reader.h"

namespace rigel {
namespace {

constexpr int kLinearTerms = 4, kQuadraticTerms = 10;

}  // namespace

CrowdKind::Data::Data(Rig r, const CrowdShape& shape, const CrowdKindOptions& o) : rig(std::move(r)), options(o) {
  samples = rig.projections();
  vectors = rig.shVectors();
  degree = vectors < kLinearTerms ? 1 : vectors < kQuadraticTerms ? 2 : 3;
  for (const RigSample& sample : rig.samples()) {
    shares.push_back(sample.share);
    footprints.push_back(sample.footprint);
  }
  const GpuRigReader reader(rig);
  description = reader.describe({});
  description.vectors = vectors;
  description.scale = 1;
  for (int k = 0; k < vectors; ++k) {
    from.push_back(static_cast<std::uint8_t>(reader.term(k).from));
    axis.push_back(static_cast<std::uint8_t>(reader.term(k).axis));
  }
  shape.skin.empty() ? addRest(shape) : addSkin(shape);
}

void CrowdKind::Data::addSkin(const CrowdShape& shape) {
  first.push_back(0);
  for (const int anchor : rig.anchors()) {
    const Vec3 p = shape.rest.surface[anchor];
    const SkinWeights& skin = shape.skin[anchor];
    for (std::size_t i = 0; i < skin.joint.size(); ++i) {
      const float weight = skin.weight[i];
      if (weight == 0) continue;
      joint.push_back(skin.joint[i]);
      for (const float x : {weight * p.x, weight * p.y, weight * p.z, weight}) point.push_back(x);
      joints = std::max(joints, skin.joint[i] + 1);
    }
    first.push_back(static_cast<int>(joint.size()));
  }
  std::vector<std::uint16_t> read = joint;
  std::ranges::sort(read);
  jointLines = crowd::JointLines(read, sizeof(JointMatrix));
  restPalette.resize(static_cast<std::size_t>(joints));
}

void CrowdKind::Data::addRest(const CrowdShape& shape) {
  restPositions.reserve(static_cast<std::size_t>(3 * samples * crowd::kBlock));
  float* row = restPositions.data();
  for (const int anchor : rig.anchors())
    for (int a = 0; a < 3; ++a, row += crowd::kBlock) std::fill_n(row, crowd::kBlock, shape.rest.surface[anchor][a]);
  // P is what comes out for the unit functionals.
  const auto s = static_cast<std::size_t>(samples);
  std::vector<float> unit(s * s);
  for (std::size_t i = 0; i < s; ++i) unit[i * s + i] = 1;
  restOperator.resize(static_cast<std::size_t>(vectors) * s);
  rig.fit(unit, samples, restOperator);
}

Result<std::shared_ptr<const CrowdKind>> CrowdKind::create(const RigSpec& spec, const CrowdShape& shape,
                                                           const CrowdKindOptions& options) {
  const std::string place = "crowd of '" + spec.text + "'";
  if (spec.family != RigSpec::Family::poly || spec.falloff || spec.adaptive)
    return Error{"crowds take poly:K alone", place};
  if (options.nearSlots < 0 || options.nearSlots > kMaxCrowdNear)
    return Error{"near slots must be 0 to " + std::to_string(kMaxCrowdNear), place};
  if (!shape.skin.empty() && shape.skin.size() != shape.rest.surface.size())
    return Error{"skin weights must be as many as surface points", place};
  const auto finite = [](const SkinWeights& skin) {
    return std::ranges::all_of(skin.weight, [](float w) { return std::isfinite(w); });
  };
  if (!std::ranges::all_of(shape.skin, finite)) return Error{"a skin weight is not finite", place};
  auto rig = Rig::create(spec, shape.rest);
  if (!rig) return rig.error();
  auto data = std::make_unique<const Data>(*std::move(rig), shape, options);
  return std::shared_ptr<const CrowdKind>(new CrowdKind(std::move(data)));
}

CrowdKind::CrowdKind(std::unique_ptr<const Data> data) noexcept : data_(std::move(data)) {}
CrowdKind::~CrowdKind() = default;

const Rig& CrowdKind::rig() const noexcept { return data_->rig; }
const CrowdKindOptions& CrowdKind::options() const noexcept { return data_->options; }
int CrowdKind::joints() const noexcept { return data_->joints; }

}  // namespace rigel
