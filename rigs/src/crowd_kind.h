// What the crowd's kernels read of a kind.
#pragma once

#include "aligned_array.h"
#include "crowd_ahead.h"
#include "crowd_block.h"

namespace rigel {

struct CrowdKind::Data {
  Rig rig;
  CrowdKindOptions options;
  int samples = 0, vectors = 0;  // S, K
  int degree = 1;                // of RankObject
  int joints = 0;
  std::vector<float> shares, footprints;  // per anchor
  std::vector<std::uint8_t> from, axis;   // crowd::Monomials
  GpuRig description{};                   // but for place, offset, scale
  std::vector<int> first;                 // crowd::Skin; empty: rigid
  std::vector<std::uint16_t> joint;
  std::vector<float> point;
  crowd::JointLines jointLines;          // of joints that are read
  std::vector<JointMatrix> restPalette;  // in place of one that is too short
  AlignedArray<float> restPositions;     // of rigid kinds, as skinAnchors leaves them
  std::vector<float> restOperator;       // of rigid kinds, K x S

  Data(Rig r, const CrowdShape& shape, const CrowdKindOptions& o);

  bool skinned() const noexcept { return !first.empty(); }
  crowd::Skin skin() const noexcept { return {first, joint.data(), point.data()}; }
  crowd::Monomials monomials() const noexcept { return {from, axis}; }

 private:
  void addSkin(const CrowdShape& shape);
  void addRest(const CrowdShape& shape);
};

}  // namespace rigel
