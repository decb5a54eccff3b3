// Many lights: which of them an object sees one by one, and which as clusters, within an error that is known.
//
// A balanced binary tree over the lights. A cluster stands for the lights below one node: a sphere light of their
// summed colour and mean radius at the centre of their power. Its error against the lights themselves is of second
// order (the first order vanishes at that centre, up to what colours differ), and bounded anywhere in the object's
// ball, over all normals, by the second moment of the lights' positions and their least distance:
//
//   RMS over normals <= N ( 2 D / d^3 + S G(a/d) / d^4 ),   G(t) = (3 - 2t)/(1-t)^2
//
// N: RMS over normals of a light of power 1 at distance 1; S = sum P |x - C|^2, D the moment that colours leave, a the
// largest |x - C|, d the least distance from the ball to C. What window, cone and emission cosine vary by over a
// cluster and the ball adds as much as it could at most. Derivation: rigs/README.md, "Many lights". Walter et al.,
// "Lightcuts: A Scalable Approach to Illumination", 2005, has the tree; its bound is the whole light of a cluster.
#pragma once

#include <rigel/prepared_lights.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rigel {

namespace detail {
struct LightTreeState;
}

/// One object, or several that are close together, and how exact the light is to be.
struct LightQuery {
  Vec3 centre;                             // of a ball that holds every point to be lit ...
  float radius = 0;                        // [m] ... and its radius
  float target = 0.01f;                    // error that clusters and slopes may add, a share of the reference
  float reference = 0;                     // [W/m2]; 0: the ball's own, LightSelection::mean
  float wrap = 0;                          // of the materials
  std::uint32_t groups = kAllLightGroups;  // lights that share no bit with it are left out
  float slopeShare = 0.25f;                // of the target, for slopes; 0: `distant` stays empty
  bool everywhere = false;                 // the mean is the least in the ball, not that at its centre
};

/// What lights an object, as PreparedLights counts: clusters from LightSet::size() on. Shares are within [0, 1]; a
/// light may be in both lists, and in a cluster besides, with shares that sum to one: so nothing jumps.
struct LightSelection {
  std::vector<LightUse> nearby;   // to be projected at every sample
  std::vector<LightUse> distant;  // value and slope at the ball's centre are enough (or every sample, which is better)
  /// Bounds of the sum of all errors [W/m2] of three-band irradiance, at any point of the ball: RMS over normals and
  /// channels, at most target x reference; and largest over normals (RMS over channels).
  float bound = 0, worst = 0;
  float reference = 0;  // [W/m2] in use
  float mean = 0;       // [W/m2] over normals and channels, at the ball's centre (or anywhere in it): from below
  int visited = 0;      // nodes and lights looked at
};

/// What LightTree::takeDistant has left of the lights, and an account of what it has taken: where `select` goes on.
struct LightCut {
  struct Part {
    std::uint32_t tree = 0, at = 0;  // the tree's own numbers
    float weight = 0;
  };
  std::vector<Part> open;
  // Of what has been taken, anywhere in the ball [W/m2]: as LightSelection's.
  double bound = 0, mean = 0;
};

/// Build it, refit it or let `update` choose, once a frame; then any number of threads may select.
///
/// Directional lights and those beyond 1e15 m or 1e20 W/sr are always by themselves; lights that hold a NaN, have no
/// radius, direction or range, or are black, never appear. Lights of equal groups have a tree of their own: cost grows
/// with the number of different masks that meet an object's.
class LightTree {
 public:
  LightTree();
  LightTree(LightTree&&) noexcept;
  LightTree& operator=(LightTree&&) noexcept;
  ~LightTree();

  /// Full build, O(n log n). Allocates only while the lights grow in number; where that throws, nothing is selected
  /// until the next build.
  void build(const LightSet& lights);

  /// For lights that moved, turned or changed their colour; their number, kinds, groups and whether they have a range
  /// are those of the last build, else it returns false and changes nothing. Linear in the lights, with `moved`
  /// (indices as LightSet::visit counts, any order) in these times the tree's depth. Nothing allocates.
  bool refit(const LightSet& lights);
  bool refit(const LightSet& lights, std::span<const std::uint32_t> moved);

  /// Refits; builds where that cannot be, or where clusters have grown by kWorthBuilding.
  void update(const LightSet& lights);
  static constexpr float kWorthBuilding = 1.25f;

  /// Sum of the clusters' sizes over that at the last build: how much worse than a fresh one the tree has become.
  float growth() const noexcept;

  /// Another number after each build and refit, and of each tree; 0 before the first build.
  std::uint64_t version() const noexcept;

  /// Bits that the masks of lights have: any of them, and all of them (all bits where there are no lights).
  struct Groups {
    std::uint32_t any = 0, all = kAllLightGroups;
  };
  Groups groups() const noexcept;

  /// To be added to PreparedLights, in this order, after `set` of the same lights.
  std::span<const SphereLight> clusters() const noexcept;

  /// Clears `out` and fills it; allocates only while it grows. O(log n) where lights are spread evenly, 1/target in
  /// general. The same bits on every thread. Continuous in positions, colours, cones and the query, but for a light
  /// that is switched on.
  void select(const LightQuery& query, LightSelection& out) const;
  /// Goes on where takeDistant has stopped, for a ball within its ball; null: from the beginning. Bound and mean are of
  /// both together, and so is what the target allows. A light may be listed more than once.
  void select(const LightQuery& query, const LightCut* from, LightSelection& out) const;

  /// For many balls of radius `part` [m] within a large one: takes the lights and clusters out of which each is at most
  /// query.target of its own light wrong, anywhere in the large ball, by
  ///
  ///   whole   value and slope at the large ball's centre,
  ///   parts   value and slope at a small ball's own centre,
  ///
  /// and leaves the others to `select`: all directional lights, and what is close, unseen. So what many balls see alike
  /// is looked at once. Clears and fills all three; allocates only while they grow. Continuous as `select` is.
  /// query.slopeShare, reference and everywhere do not count. `rest` is good until the tree changes, for queries of the
  /// same groups and wrap.
  void takeDistant(const LightQuery& query, float part, std::vector<LightUse>& whole, std::vector<LightUse>& parts,
                   LightCut& rest) const;

 private:
  std::unique_ptr<detail::LightTreeState> state_;
};

}  // namespace rigel
