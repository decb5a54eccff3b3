// Which lights leave the rig and are evaluated exactly, how much of each, and in which slot: continuous in the
// geometry.
#pragma once

#include <rigel/near_light.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rigel {

inline constexpr int kMaxNearLights = 64;

struct NearFarOptions {
  int slots = 2;           // near lights at most, fading ones included; held within 0..kMaxNearLights
  float tolerance = 0;     // [W/m2] a light whose error is below it stays in the rig
  float weightRate = 20;   // [1/s] limit of a weight's movement, for lights switched on or off and for objects that
                           // jump; not positive: no limit
  float approachRate = 0;  // [1/s] a weight goes this times seconds of its way at most, so that jumps too small for the
                           // limit shrink with the frame, too; not positive: all of it at once
  float fallShare = 1;  // of weightRate, for weights that fall: a light that leaves slowly waits for the rig to take it
};

/// Weight w of each light: the share w is evaluated exactly, 1 - w stays in the rig. w = smoothstep(err/F - 1),
/// F = max(tolerance, err of the light ranked slots + 1); 0 where F = err = 0, and 1 where only F is 0. Keeps, from
/// frame to frame, the weights (for their rate limit) and the slot of each near light; everything else depends on the
/// present alone.
///
/// The rate limit: a weight moves by at most weightRate * seconds. Exempt, because nothing of them was in the rig:
/// lights that were not there in the last update or had no error then. A light that is gone frees its slot. A light
/// that is displaced fades out and keeps its slot meanwhile; a newcomer that finds no free slot stays in the rig and
/// fades in when there is one.
class NearFar {
 public:
  explicit NearFar(const NearFarOptions& options = {}) noexcept : options_(options) {}

  NearFarOptions& options() noexcept { return options_; }

  /// After a cut or a teleport: the next update takes its weights at once, and slots are dealt anew.
  void reset() noexcept;

  /// `errors`: per light, of leaving it in the rig [W/m2]; NaN and negative count as 0. `ids` name the lights from
  /// frame to frame, in any order; empty: by index. The n-th light of an id is the n-th of that id in the last update.
  /// `seconds` since the last update; not positive, NaN or infinite: a cut. n log n at most, 4 to 9 us for 500 lights;
  /// allocates only while n grows.
  void update(std::span<const float> errors, std::span<const std::uint32_t> ids, float seconds);

  /// The same bookkeeping for weights that were found elsewhere (`auto` rigs), held within [0, 1]. Where more than
  /// `slots` lights want to be near, the largest errors are served first. Without `errors` the largest weights are, and
  /// every light known from the last update is rate limited.
  void follow(std::span<const float> weights, std::span<const std::uint32_t> ids, float seconds,
              std::span<const float> errors = {});

  std::span<const float> weights() const noexcept { return weights_; }  // per light, of the last update
  /// The light in each slot, or -1; a light keeps its slot while w > 0, and has one wherever w > 0.
  std::span<const int> slots() const noexcept { return slots_; }

 private:
  /// A light of the present or of the last update.
  struct Known {
    std::uint32_t id = 0;
    int index = 0;
    int slot = -1;
    float weight = 0;
    bool counts = false;  // had an error: some of it is in the rig, or near
    bool fades = false;   // its weight moves no faster than the rate limit
  };

  std::size_t slotCount() const noexcept;
  void advance(std::span<const std::uint32_t> ids, float seconds);
  void listLights(std::span<const std::uint32_t> ids);
  void recallWeights() noexcept;
  float moved(const Known& light, float step) const noexcept;
  void moveHolders(float step) noexcept;
  void serveNewcomers(float step);

  NearFarOptions options_;
  bool cut_ = true;
  std::vector<float> wanted_, rank_;  // per light: the weight it should have, and who is served first
  float approach_ = 1;                // of its way that a weight goes in this update
  float seconds_ = 0;
  std::vector<Known> lights_, last_;  // by id, then index
  std::vector<int> waiting_;          // places in lights_
  std::vector<float> weights_;
  std::vector<int> slots_;
};

/// Splits a frame's lights into what the rig is fitted to and what is evaluated at every point: `inRig` gets each
/// light with its colour times 1 - w, `exact` the lights of w > 0 with share w. Lights of w = 1 and black ones are left
/// out of `inRig`; lights marked in `culled` (empty: none) are left out of both. Order is kept. `inRig` and `exact` are
/// cleared first, and allocate only while they grow.
void splitLights(const LightSet& lights, std::span<const float> weights, LightSet& inRig, std::vector<NearLight>& exact,
                 std::span<const std::uint8_t> culled = {});

}  // namespace rigel
