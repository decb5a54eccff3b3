// Error against cost of one object in one frame: how many near lights, how many SH vectors, with or without the high
// band. The choice is the cheapest of a ladder of levels, one more near light each; for a budget the best of them.
#pragma once

#include <rigel/object_lighting.h>

#include <optional>
#include <span>
#include <vector>

namespace rigel {

/// Prediction error over residual, mean squares, of a fit of `used` functions to `points` points: generalised
/// cross-validation (P. Craven, G. Wahba, "Smoothing noisy data with spline functions", 1979).
float inflation(float points, float used) noexcept;

/// What each light adds to the error of the object's rig, as rows that sum from light to light. Block `lights` is what
/// stays in the rig whatever is chosen. All rows are in sample space, scaled so that a sum of squares, each float times
/// its `weight`, is a mean-square irradiance [W/m2]^2 over the surface, the sphere of normals and the channels.
struct LightRows {
  int lights = 0;
  int nested = 0;     // leading rows: coefficients of nested functions (`auto` rigs)
  int residuals = 0;  // rows beyond them
  int width = 0;
  int truncated = 0;                 // floats of `truncation` a block
  int truncatedRows = 0;             // points they are taken at, of equal share
  int highFirst = 0, highCount = 0;  // floats of a truncated row that the high band can carry
  std::vector<float> fields;         // (lights + 1) x (nested + residuals) x width
  std::vector<float> truncation;     // (lights + 1) x truncated: what the SH bands leave out
  std::vector<float> weight;         // width: squared factor from SH to irradiance
  std::vector<float> excess;         // per block, [W/m2]^2: of a light so close that it varies between the rows' points
  std::vector<float> fade;           // per light: 0 for one that is about to leave the candidates, 1 for all others
  std::vector<float> contact;        // per light: share that is near whatever is chosen (FaceContact)
  float tail = 1;                    // all truncated energy over that of `truncation`
  float inflation = 1;               // fixed rigs: mean-square error at other points over that at the rows' points

  int rows() const noexcept { return nested + residuals; }
  std::size_t block() const noexcept { return static_cast<std::size_t>(rows()) * width; }
  void resize(int lightCount);
  /// Room for as many lights, so that resize allocates nothing.
  void reserve(int lightCount);
};

/// Mean-square errors [W/m2]^2 of the lights' rows weighted by 1 - w.
struct FarError {
  std::vector<float> beyond;  // per J = 0..nested: spatial, where J nested coefficients are kept
  float excess = 0;           // part of `beyond`
  float truncation = 0;       // of the SH bands
  float truncationHigh = 0;   // with the constant high band
  std::vector<float> field;   // the weighted rows themselves
  std::vector<float> energy;  // of each of them
  std::vector<float> truncated;
};

class TradeOff {
 public:
  /// A level of the ladder, with or without the high band.
  struct Pick {
    int level = 0;
    bool highBand = false;
    friend bool operator==(const Pick&, const Pick&) = default;
  };
  struct Request {
    LightingTarget::Kind kind = LightingTarget::Kind::spatialError;
    float value = 0;           // error [W/m2], or nanoseconds a point
    float spatialMargin = 1;   // estimated spatial errors are kept below what the target leaves them by this factor
    int vectors = 0;           // of a fixed rig; 0: nested
    bool highBand = false;     // available
    std::optional<Pick> held;  // of the last frame
    CostModel cost;
  };
  struct Choice {
    Pick pick;
    std::vector<float> weights;    // of each light, of being near
    float highBand = 0;            // share of it
    float spatialError = 0;        // [W/m2] that nested coefficients aim at in this frame
    float chosenSpatialError = 0;  // and where all weights have arrived
    float vectorCap = 0;           // nested coefficients at most
    float nanoseconds = 0;         // modelled, a point
    float objective = 0;  // that was least: nanoseconds and a price for what misses the target; for budgets an error
  };

  /// Room for as many lights, so that nothing else allocates.
  void reserve(const LightRows& rows, int lightCount);
  /// `damping`: NestedFit's.
  void build(const LightRows& rows, std::span<const float> damping, int slots, bool total);
  /// Allocates only while the number of lights grows.
  void choose(const Request& request, Choice& choice) const;
  /// w of each light at a level; not below its contact.
  void weightsAt(float level, std::span<float> weights) const;

  /// Errors of the far part for given weights.
  static void farError(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
                       FarError& out);
  /// Weights in [0, 1], non-increasing, of the nested coefficients: what the frame's far part needs, and what it will
  /// when the choice has arrived, so that a light that leaves finds its place in the rig. Returns how many are not 0.
  int coefficientWeights(const FarError& error, const Choice& choice, std::span<float> weights) const;
  /// Share of what the choice wants of the nested coefficients that these weights have.
  float readiness(const Choice& choice, std::span<const float> weights) const;
  /// Mean-square spatial error with these weights.
  static float spatialSquare(const LightRows& rows, const FarError& error, std::span<const float> damping,
                             std::span<const float> weights);
  /// What the target leaves for the spatial error [W/m2] beside a mean-square truncation.
  static float spatialRoom(const Request& request, float truncation);
  static float nanoseconds(const CostModel& cost, float vectors, float nearLights, float highBand);

 private:
  struct Level {
    float log2 = 0;
    float nearLights = 0;
    float truncation = 0, truncationHigh = 0;
    std::vector<float> beyond;
  };
  static void finishFar(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
                        FarError& out);
  /// Of the coefficient without which the mean-square error is `square`; `room`: how many more may be kept.
  static float coefficientWeight(float square, float target, float room);

  std::vector<float> error_;  // per light: RMS [W/m2] of leaving it in the rig
  std::vector<float> contact_;
  float floor_ = 0;  // error of the light ranked slots + 1
  std::vector<Level> levels_;
  std::size_t levelCount_ = 0;
  FarError scratch_;
  std::vector<float> sorted_;
  std::vector<float> weights_, nearer_;  // working memory
};

}  // namespace rigel
