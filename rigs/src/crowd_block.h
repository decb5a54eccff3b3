// The kernels of crowd.h: what is done to a block of characters of one kind, one character a lane. Rows of kBlock
// numbers, one a character; what is in the rows of characters that a block does not have is of no account.
#pragma once

#include <rigel/crowd.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rigel::crowd {

/// Characters in a block: as many as the widest vectors have floats.
inline constexpr int kBlock = 16;

/// What a kind's anchors ride on: those of anchor s are influences first[s] to first[s + 1].
struct Skin {
  std::span<const int> first;
  const std::uint16_t* joint;
  const float* point;  // four an influence: weight times the rest position, weight
};

/// Anchors in the rig frame, three rows an anchor: x, y, z.
/// `palettes`: kBlock of them, each with all of the kind's joints.
void skinAnchors(const Skin& skin, std::span<const JointMatrix* const, kBlock> palettes, int characters,
                 float* positions) noexcept;

/// Rows of a block's places.
struct Places {
  float frame[12][kBlock];             // columns x, y, z and origin of worldFromRig
  float lo[3][kBlock], hi[3][kBlock];  // box, rig frame
  float radius[kBlock];                // rms about the mean of the anchors
  float finite[kBlock];                // 0, or NaN where an anchor is not finite in the world
};

/// World positions, densely packed: anchor s of character c at s * characters + c. `boxes`: also finds those of the
/// pose, from anchors with their footprints.
void placeAnchors(int characters, std::span<const float> footprints, std::span<const float> shares,
                  const float* positions, bool boxes, Places& places, float* x, float* y, float* z) noexcept;

/// What GpuRig begins with, a row a number: centre, a row left alone (offset), axisX, axisY, axisZ; as placeRigBox.
inline constexpr int kPlaceRows = 16;
void placeBoxes(int characters, const Places& places, float* rows) noexcept;

/// Monomial k > 0 is monomial from[k] < k times coordinate axis[k].
struct Monomials {
  std::span<const std::uint8_t> from, axis;
};

/// Doubles of scratch memory that refreshOperators takes.
std::size_t refreshScratch(int samples, int vectors) noexcept;

/// The operator of least_squares.h, K x S rows.
void refreshOperators(int characters, const Monomials& monomials, std::span<const float> shares, const float* positions,
                      const Places& places, double* scratch, float* op) noexcept;

/// c = P F times `scale`: `sums` as projectBatch leaves them (`width` rows of S x characters numbers, and kBlock more
/// that may be read); `op` one row an entry, or (`same`) one number for all. Row k * padded + i is coefficient i of
/// vector k; padded - width rows of zeros follow.
struct FitView {
  int characters, samples, vectors, width, padded;
  const float* op;
  bool same;
  const float* sums;
  float scale;
};
void fitBlock(const FitView& fit, float* rows) noexcept;

/// Rows to characters: `count` numbers, a multiple of 4, of each character to out[character].
void transposeRows(const float* rows, int count, int characters, float* const* out) noexcept;

/// Adds what distant lights give at each point to sums as projectBatch leaves them: `slopes` has four numbers a row of
/// sums, value and derivatives by x, y and z at `centre`. The same at a point whatever others there are.
void addDistant(const float* slopes, Vec3 centre, const Vec3Rows& points, std::span<float> sums) noexcept;

/// out = a + (b - a) t.
void blend(const float* a, const float* b, float t, std::size_t count, float* out) noexcept;
/// Largest finite magnitude.
float largestOf(const float* values, std::size_t count) noexcept;
/// Values times `inverseScale`, rounded to nearest even; `count` is a multiple of 4.
void storeHalves(const float* values, float inverseScale, std::size_t count, GpuHalf4* out) noexcept;

/// What lights are ranked by, structure of arrays.
struct RankRows {
  enum Row { x, y, z, power, radius, inverseRange, axisX, axisY, axisZ, cosOuter, inverseWidth, disk, twoSided };
  static constexpr int kRows = 13;
  const float* row[kRows];
  const std::uint32_t* groups = nullptr;
  int count = 0;
  bool directed = false;  // spots or disks among them
};

/// Characters as lights see them, beside their places.
struct RankBlock {
  const Places* places = nullptr;
  const std::uint32_t* groups = nullptr;  // one a character
  int characters = 0;
  int degree = 1;  // how the error falls with the distance, crowd.h
};

/// Error [W/m2] of leaving each light in the rigs, as crowd.h defines it: a row a light.
void rankLights(const RankRows& lights, const RankBlock& block, float* errors) noexcept;

/// The n-th largest error of each character (n = 1: the largest), 0 where there are not as many; n to kMaxCrowdNear
/// + 1.
void nthLargest(const float* errors, int lights, int characters, int n, float* floors) noexcept;

/// Lights whose error is above a character's floor: at most `most` each, lowest index first.
struct NearHits {
  int count[kBlock];
  int light[kBlock][kMaxCrowdNear];
};
void findAbove(const float* errors, int lights, int characters, const float* floors, int most, NearHits& hits) noexcept;

}  // namespace rigel::crowd
