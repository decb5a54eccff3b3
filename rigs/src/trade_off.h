// Error against cost of one object in one frame: how many near lights, how many SH vectors, with or without the high
// band. The choice is an average over a ladder of levels, one more near light each, weighted towards the cheapest; for
// a budget it is the best of them.
#pragma once

#include <rigel/object_lighting.h>

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
  std::vector<float> truncated;
};

class TradeOff {
 public:
  struct Request {
    LightingTarget::Kind kind = LightingTarget::Kind::spatialError;
    float value = 0;          // error [W/m2], or nanoseconds a point
    float spatialMargin = 1;  // estimated spatial errors are kept below what the target leaves them by this factor
    int vectors = 0;          // of a fixed rig; 0: nested
    bool highBand = false;    // available
    CostModel cost;
  };
  struct Choice {
    std::vector<float> weights;  // of each light, of being near
    float highBand = 0;          // share of it
    float spatialError = 0;      // [W/m2] that nested coefficients aim at
    float vectorCap = 0;         // nested coefficients at most
    float nanoseconds = 0;       // modelled, a point
  };

  /// Room for as many lights, so that nothing else allocates.
  void reserve(const LightRows& rows, int lightCount);
  /// `damping`: NestedFit's.
  void build(const LightRows& rows, std::span<const float> damping, int slots, bool total);
  /// Allocates only while the number of lights grows.
  void choose(const Request& request, Choice& choice) const;
  /// w of each light at a level.
  void weightsAt(float level, std::span<float> weights) const;

  /// Errors of the far part for given weights.
  void farError(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
                FarError& out) const;
  /// Weights in [0, 1], non-increasing, of the nested coefficients. Returns how many are not 0.
  static int coefficientWeights(const FarError& error, const Choice& choice, std::span<float> weights);
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
  std::vector<float> error_;  // per light: RMS [W/m2] of leaving it in the rig
  float floor_ = 0;           // error of the light ranked slots + 1
  std::vector<Level> levels_;
  std::size_t levelCount_ = 0;
  FarError scratch_;
  std::vector<float> sorted_;
  mutable std::vector<float> weights_, costs_;  // working memory
};

}  // namespace rigel
