// The lighting of one moving object: its rig, the lights too close for the rig, and how wrong the two together are.
//
// Each frame every light gets a weight w: the share w is evaluated exactly at every point, 1 - w enters the rig. Fixed
// rigs move the few lights with the largest error bounds; `auto` rigs weigh rig coefficients and near lights against
// each other until an error target, or a time budget, is met.
#pragma once

#include <rigel/near_far.h>
#include <rigel/near_light.h>
#include <rigel/rig_light.h>
#include <rigel/vec3_rows.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace rigel {

/// What the choice of coefficients and near lights aims at. Errors are RMS over the surface, relative to the reference
/// irradiance.
struct LightingTarget {
  enum class Kind {
    none,          // fixed rig, fixed number of near slots
    spatialError,  // rig against SH of the same bands at every point
    totalError,    // everything against exact irradiance
    budget,        // microseconds of modelled time a frame (CostModel)
  };
  Kind kind = Kind::none;
  float value = 0;
};

/// Modelled time [ns] of shading one point, so that choices depend on no clock. What counts is their ratio: a near
/// light costs as much as two SH vectors in a shader, as five on a CPU that shades many points.
struct CostModel {
  float base = 2.5f;       // a rig at all: the normal's SH basis and the convolution
  float vector = 2.6f;     // each SH vector of the rig
  float anyNear = 7;       // near lights at all
  float nearLight = 5.2f;  // each of them
  float nearWrap = 7.7f;   // the same on materials with wrap
  float highBand = 2;      // the constant high band

  /// Of shaders, on Mesa's lavapipe (`rigel bench --filter '^gpu'`); the counted arithmetic has the same ratios. The
  /// default.
  static constexpr CostModel shaders() noexcept { return {}; }
  /// Of `ObjectLighting::shade` with many points on one core, in vectors (`rigel bench --filter
  /// '^shade.batch|^near.batch'`).
  static constexpr CostModel cpu() noexcept { return {2.1f, 0.3f, 0, 1.5f, 1.9f, 1.2f}; }
};

struct LightingOptions {
  LightingTarget target;
  /// Near lights at most. Empty: as many as the target asks for, up to kMaxNearLights; none without a target.
  std::optional<int> nearSlots;
  float reference = 0;    // [W/m2] irradiance that errors are relative to (what the exposure shows as mid-grey); 0: the
                          // object's own mean in the frame
  float wrap = 0;         // of the object's materials
  int points = 10000;     // shaded a frame, for budgets
  bool estimate = false;  // wanted even where the choice does not need it; decided when it is made
  CostModel cost;

  int slots() const noexcept {
    return nearSlots.value_or(target.kind == LightingTarget::Kind::none ? 0 : kMaxNearLights);
  }
};

/// Why a light is where it is.
enum class LightRole : std::uint8_t {
  culled,   // gives the object nothing: out of range, outside its cone, black
  inRig,    // left to the rig
  blended,  // part in the rig, part exact
  exact,    // evaluated at every point
};

struct LightVerdict {
  LightRole role = LightRole::inRig;
  float weight = 0;  // evaluated exactly
  float bound = 0;   // of the error of leaving it in the rig [W/m2], RMS over channels
  float share = 0;   // of the object's mean irradiance (estimated at the rig's samples); all lights sum to 1
};

/// The part of the light beyond the rig's bands that is the same everywhere on the object: one band of radiance SH
/// (2 band + 1 colours), or none (band 0).
struct HighBand {
  int band = 0;
  std::array<Rgb, 2 * kMaxBands - 1> c{};
};

/// Parts of a frame's work, for whoever times them.
enum class LightingStage : std::uint8_t { bound, choose, project, fit, estimate };
struct LightingProbe {
  void (*done)(void* context, LightingStage stage) = nullptr;  // called as each ends
  void* context = nullptr;
};

/// What shading needs to know of a material's wrap reflectance; made once a material.
template <int B>
struct MaterialWrap {
  std::array<float, B> bands;  // f_l
  std::array<float, kMaxBands> allBands;
  NearWrap nearLights;

  explicit MaterialWrap(float wrap = 0) noexcept
      : bands(wrapCoefficients<B>(wrap)), allBands(wrapCoefficients<kMaxBands>(wrap)), nearLights(nearWrap(wrap)) {}
};

template <int B>
class ObjectLighting {
 public:
  static Result<ObjectLighting> create(const RigSpec& spec, const RigShape& rest, const LightingOptions& options);
  ObjectLighting(ObjectLighting&&) noexcept;
  ObjectLighting& operator=(ObjectLighting&&) noexcept;
  ~ObjectLighting();

  const Rig& rig() const noexcept;
  LightingOptions& options() noexcept;

  /// Indices into RigShape::surface of the points that setPose wants posed.
  std::span<const int> anchors() const noexcept;
  void setPose(const RigPose& pose, const RigFrame& worldFromRig) noexcept;

  /// After a cut or a teleport: nothing fades.
  void reset() noexcept;

  /// Fits the object's lighting to the frame's lights. `seconds` since the last call; `ids` name the lights from frame
  /// to frame (empty: by index). Allocates only while lights grow in number.
  void light(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids = {}, LightingProbe probe = {});

  /// `light` in two steps, for who spreads a frame's time over many objects (light_budget.h). `weigh` finds what every
  /// choice would cost; `costAt` says what [ns a point] an error target costs, and `settle` takes it in place of
  /// options().target.value. Needs a target of kind spatialError or totalError.
  void weigh(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids = {}, LightingProbe probe = {});
  float costAt(float target) const;
  void settle(const LightSet& lights, float target, float seconds, std::span<const std::uint32_t> ids = {},
              LightingProbe probe = {});

  /// SH vectors in use: of an `auto` rig as many as the frame needs, in nested order.
  std::span<const RadianceSH<B>> coefficients() const noexcept;
  std::span<const NearLight> nearLights() const noexcept;
  std::span<const LightVerdict> verdicts() const noexcept;  // per light

  /// RMS error over the surface, relative to the reference irradiance; empty where it was not asked for.
  std::optional<float> spatialEstimate() const noexcept;
  std::optional<float> totalEstimate() const noexcept;
  float modelledNanoseconds() const noexcept;  // per point, by the cost model
  /// How much of it was not chosen: lights and vectors on their way out, less what is on its way in. 0 where nothing
  /// chooses.
  float lateNanoseconds() const noexcept;

  const HighBand& highBand() const noexcept;

  /// Rig and near lights at a world point with unit normal; the rig's part is not clamped.
  struct Parts {
    Rgb rig, nearLights;
  };
  Parts shade(Vec3 p, Vec3 n, const MaterialWrap<B>& wrap) const noexcept;

  /// The same at many points, in vectors (sh_batch.h, near_batch.h): to rounding what one point after another gives.
  void shade(const Vec3Rows& points, const Vec3Rows& normals, const MaterialWrap<B>& wrap,
             std::span<Parts> out) const noexcept;

 private:
  struct State;
  Rgb rigIrradiance(Vec3 p, Vec3 n, const MaterialWrap<B>& wrap) const noexcept;
  void rigIrradiance(const Vec3Rows& points, const Vec3Rows& normals, const MaterialWrap<B>& wrap,
                     std::span<float> irradiance) const noexcept;
  explicit ObjectLighting(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace rigel
