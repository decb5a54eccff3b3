// Many characters of a few kinds, lit in every frame: skinning of sample points, operators, near lights, projection,
// fit and packing, for sixteen characters at a time in vectors as wide as the machine's (Highway).
//
// A frame is cut into blocks of up to sixteen due characters of one kind, in the order in which they were added, or
// with a light tree by place. What comes out for a character depends on its own input and on the lights alone: not on
// its neighbours, on the order in which blocks are done, or on the number of threads, to the last bit. All lights light
// all characters, but for groups, and for what a tree merges.
// No locks; no allocation but while characters or lights grow in number.
//
//   pose      anchors on the palette, into the world; the pose's box
//   refresh   the least-squares operator P of the pose (rig.h)
//   select    with a light tree: what lights the cells in which the block is
//   rank      error of leaving each light in the rig, by a formula of a few flops (below); near weights; shares
//   project   F, project_batch.h
//   fit       c = P F
//   pack      results as shaders read them (gpu_rig.h)
//
// Ranking. A light of peak irradiance E, with e^2 = (distance to the pose's box)^2 + (R/4)^2 and R the rms radius of
// the anchors, counts as E(max(e, r)) min(1, (R/e)^n), with window and cone at their largest over the box; n = 1 for K
// < 4, 2 for K < 10 and 3 above: the degree that the rig spans, and one. A pair of near lights chosen by it leaves 1.03
// of the error of the best pair, nearest first 1.12 (test_crowd_rank.cpp). It ranks and weighs; it is no bound
// (light_bound.h has those, at fifty times the cost).
//
// Boxes. A polynomial does not depend on its box, which scales coordinates alone; here it is that of the anchors with
// their footprints (of rigid kinds that of the rest shape), and costs next to nothing.
#pragma once

#include <rigel/gpu_rig.h>
#include <rigel/light_tree.h>
#include <rigel/project_batch.h>
#include <rigel/rig_light.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rigel {

/// Most near lights a character can have.
inline constexpr int kMaxCrowdNear = 8;
/// Most frames from one update of a character to the next.
inline constexpr int kMaxCrowdInterval = 64;

/// From the rest pose to the rig frame, rows first: p' = m (p, 1). 48 bytes, as shaders read palettes.
struct JointMatrix {
  float m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

/// The joints that move a point of the surface, as indices into a palette, and their weights, which sum to 1.
struct SkinWeights {
  std::array<std::uint16_t, 4> joint{};
  std::array<float, 4> weight{1, 0, 0, 0};
};

/// What characters of a kind have in common.
struct CrowdShape {
  RigShape rest;
  std::span<const SkinWeights> skin;  // one a point of rest.surface; none: rigid, no palette is read
};

struct CrowdKindOptions {
  int nearSlots = 2;      // near lights of a character at most, fading ones included; 0 to kMaxCrowdNear
  float tolerance = 0;    // [W/m2] a light whose error is below it stays in the rig
  float weightRate = 20;  // [1/s] limit of a near weight's movement (near_far.h); not positive: none
};

/// Archetype of characters: a rig, where its samples are and what moves them. Immutable; shared by characters, crowds
/// and threads.
class CrowdKind {
 public:
  /// Error: where Rig::create has one; for rigs other than `poly:K`; where `skin` has not one entry a surface point, or
  /// a weight is not finite; nearSlots out of range. Takes what Rig::create takes.
  static Result<std::shared_ptr<const CrowdKind>> create(const RigSpec& spec, const CrowdShape& shape,
                                                         const CrowdKindOptions& options = {});
  ~CrowdKind();

  const Rig& rig() const noexcept;  // in its rest pose
  const CrowdKindOptions& options() const noexcept;
  int joints() const noexcept;  // a palette has at least as many

  struct Data;  // internal
  const Data& data() const noexcept { return *data_; }

 private:
  explicit CrowdKind(std::unique_ptr<const Data> data) noexcept;
  std::unique_ptr<const Data> data_;
};

/// A character's name; stays good until it is removed. CrowdId{} is nobody's.
struct CrowdId {
  std::uint32_t kind = 0, index = 0, generation = 0;
  friend bool operator==(CrowdId, CrowdId) = default;
};

/// What moves a character, to be kept up to date by the caller between frames.
struct CrowdInput {
  RigFrame worldFromRig;
  std::span<const JointMatrix> palette;    // the caller's; `frame` reads it where the character is updated
  std::uint32_t groups = kAllLightGroups;  // lights that share one of them (LightSet::groups) light it
  int interval = 1;     // frames from one update to the next, 1 to kMaxCrowdInterval: update rate by distance (below)
  bool visible = true;  // what is not seen is neither computed nor packed
  bool cut = true;      // after a cut or a teleport, and at first: nothing fades. `frame` sets it to false
};

/// Where a character's results are in the frame's output.
struct CrowdResult {
  int rig = -1;        // of CrowdOutput::rigs; -1: not visible
  int nearOffset = 0;  // of CrowdOutput::nearLights
  int nearCount = 0;
};

/// Where there are many lights: what a frame asks a tree over them. Characters that are in one cell of a grid over the
/// world share one question, asked of all of the cell, and cells in one region of 5^3 what is distant for all of it. So
/// what they get depends on where they are and on the lights alone, not on their neighbours. Between cells, over 1/16
/// of their size, shares of both make what is seen continuous.
struct CrowdTree {
  const LightTree* tree = nullptr;  // of the same lights, as they are; null: all lights one by one
  float target = 0.1f;              // LightQuery::target: the share of the light that may be dropped or merged at most
  float cell = 8;                   // [m] size of the cells; characters with a radius above a quarter of it take larger
  float wrap = 0;                   // of the materials
};

/// A frame's lights.
struct CrowdLights {
  const LightSet* lights = nullptr;
  const PreparedLights* prepared = nullptr;  // of the same lights; with a tree, its clusters added
  std::span<const std::uint32_t> ids;        // a light's name from frame to frame, each once; empty: its index
  CrowdTree tree{};
};

/// The caller's memory; sizes by Crowd::outputBound. Coefficients in float32, in half floats over GpuRig::scale, or
/// both: what is empty is not written. What is written is not read: it may be a GPU's, mapped.
struct CrowdOutput {
  std::span<GpuRig> rigs;  // one a visible character, in the order of kinds and of characters in them
  std::span<GpuVec4> coefficients;
  std::span<GpuHalf4> halves;
  std::span<GpuNearLight> nearLights;  // nearSlots a character, of which nearCount are lit
};

struct CrowdOutputBound {
  std::size_t rigs = 0, coefficients = 0, nearLights = 0;
};

/// The caller's threads: `run` calls task(work, i) for each i in [0, count), in any order, on any threads, and returns
/// when all are done. Null: this thread does all.
struct ParallelFor {
  using Task = void (*)(void* work, int i);
  void (*run)(void* context, int count, Task task, void* work) = nullptr;
  void* context = nullptr;
};

/// Stages that are timed apart.
enum class CrowdStage : std::uint8_t { pose, refresh, rank, project, fit, pack, select };
inline constexpr int kCrowdStages = 7;

/// For whoever times stages: a clock that any thread may ask. Null: no time is taken.
struct CrowdProbe {
  std::uint64_t (*now)(void* context) = nullptr;
  void* context = nullptr;
};

/// What a frame did.
struct CrowdStats {
  int visible = 0;                                  // characters packed
  int updated = 0;                                  // fitted anew
  int unusable = 0;                                 // of these, without a finite pose: they are dark for the frame
  std::array<std::uint64_t, kCrowdStages> ticks{};  // of the probe's clock, summed over threads
  // Of those updated, summed; whoever is between cells has the lights of all of them.
  std::uint64_t lights = 0;    // taken one by one
  std::uint64_t clusters = 0;  // taken in place of others
  float merged = 0;            // largest share of anybody's light that clusters and slopes may be wrong by; a bound
  std::uint64_t asked = 0;     // of the tree, for cells and regions; more where more tasks ask for themselves
};

/// Update rates. A character of interval n is updated in one frame of n (different ones in different frames) and shows,
/// frame by frame, what lies linearly between its last two updates: coefficients, box and near weights. So it is lit by
/// where it was n - 1 frames ago, moved along with it: off by that time x its speed x the light's slope, and without a
/// jump. A walk past lamps at 60 frames a second has an error of 1.6 % updated in every frame, 2.3 % in every
/// fourth, 4.3 % in every eighth (test_crowd_continuity.cpp). An interval changes at an update; when it falls, by
/// halves.
///
/// Characters with poses or frames that are not finite, and with palettes too short, are dark (no SH vectors, no near
/// lights) until that is over.
template <int B>
class Crowd {
 public:
  /// `tasks`: into how many a frame is cut at most, that is, the most threads it can use. Each has about 0.1 MB of
  /// scratch memory for `poly:6`, and with a tree 1.8 MB more.
  explicit Crowd(int tasks = 1);
  Crowd(Crowd&&) noexcept;
  Crowd& operator=(Crowd&&) noexcept;
  ~Crowd();

  /// Allocates.
  int addKind(std::shared_ptr<const CrowdKind> kind);
  /// Of a kind that addKind returned. Allocates while the kind's characters grow beyond what there were at once; where
  /// that throws, nothing has changed.
  CrowdId add(int kind);
  void remove(CrowdId id) noexcept;
  int size() const noexcept;

  bool contains(CrowdId id) const noexcept;
  /// Stays where it is until the next `add`.
  CrowdInput& input(CrowdId id) noexcept;
  /// Of the last frame.
  CrowdResult result(CrowdId id) const noexcept;

  /// What a frame writes at most: all characters visible.
  CrowdOutputBound outputBound() const noexcept;

  /// Lights and packs all visible characters; nothing else of the crowd may be called meanwhile. `seconds` since the
  /// last call; not positive or not finite: a cut for all. Allocates only while lights grow in number. Linear in
  /// characters x lights; with a tree in characters, cells and regions, where what is asked of a region grows with the
  /// logarithm of the lights, and nothing is asked again while the tree stays as it is and a task's characters are in
  /// 256 cells or less. Beyond 1024 lights one by one a place, and 512 lights and clusters for a region's cells, its
  /// task allocates, and where that fails this throws std::bad_alloc after all tasks are done. Characters beyond 1e15 m
  /// are dark then.
  CrowdStats frame(const CrowdLights& lights, float seconds, const CrowdOutput& output, ParallelFor parallel = {},
                   CrowdProbe probe = {});

  /// Of a character of that kind, kinds and scratch aside, the caller's output not included: 1580 for `poly:6`, 3 bands
  /// and two near slots, most of it two sets of coefficients for those that are not updated in every frame.
  std::size_t bytesPerCharacter(int kind) const noexcept;
  /// All that is held.
  std::size_t bytes() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rigel
