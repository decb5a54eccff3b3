// The text form of a rig model: "constant", "gradient@numeric", "lattice:3x2x2", "mixed:l3,g,c", "poly:6",
// "invquad:6", "auto", "rbf:12", "latticegrad:2x2x1", "hermite:2x2x1", ...
#pragma once

#include <rigel/result.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rigel {

/// What a tensor rig does along one axis of the box.
struct AxisModel {
  enum class Kind { constant, gradient, lattice };
  Kind kind = Kind::constant;
  int nodes = 1;  // of a lattice axis, >= 2

  friend bool operator==(const AxisModel&, const AxisModel&) = default;
};

/// Interpolation between lattice nodes, b(p) of the paper, by name.
enum class LatticeKernel { linear, smooth, cubic };

/// How the parameters are computed from samples.
enum class FitMethod {
  corners,  // as the paper: lattice nodes spread over the box, corners included; analytic derivatives at its centre
  numeric,  // derivatives as secants between interior points (gradient axes only)
  gauss,    // nodes where the object's surface is (Gauss quadrature of its distribution along each axis), a polynomial
            // through them; slopes as secants between two such nodes
  lsq,      // least squares over sample points on the object's surface
};

struct RigSpec {
  /// The last three are models that the paper tried and dropped: for comparison on the CPU, without shaders.
  enum class Family {
    tensor,
    poly,
    rbf,          // radial basis functions about K points of the surface
    latticegrad,  // a lattice whose nodes hold value and slopes, blended first-order expansions
    hermite,      // the same nodes, cubic along the axes
  };
  Family family = Family::tensor;
  /// By decreasing extent of the rest box, or x, y, z if `pinnedAxes`; latticegrad and hermite: lattice or constant.
  std::array<AxisModel, 3> axes;
  bool pinnedAxes = false;
  LatticeKernel kernel = LatticeKernel::linear;
  FitMethod fit = FitMethod::corners;
  int terms = 0;  // poly, rbf: K
  bool falloff =
      false;  // poly: `invquad`, the polynomial times one falloff 1/quadratic, fitted to the light each frame
  bool adaptive = false;  // poly: `auto`, whose coefficients and near lights are weighed anew each frame
                          // (object_lighting.h); of the K terms a frame takes as many as it needs

  std::string text;  // as the user wrote it, without blanks

  /// SH vectors stored: product of lattice nodes times (1 + gradient axes) (latticegrad, hermite: times 4), or K.
  int shVectors() const noexcept;

  /// The same model, however it was written.
  friend bool operator==(const RigSpec& a, const RigSpec& b) noexcept {
    return a.family == b.family && a.axes == b.axes && a.pinnedAxes == b.pinnedAxes && a.kernel == b.kernel &&
           a.fit == b.fit && a.terms == b.terms && a.falloff == b.falloff && a.adaptive == b.adaptive;
  }
};

inline constexpr int kMaxAxisNodes = 64;
inline constexpr int kMaxShVectors = 512;    // per rig
inline constexpr int kMaxPolyTerms = 56;     // all monomials up to degree 5
inline constexpr int kAutoTerms = 24;        // of `auto` without a number
inline constexpr int kMaxGaussVectors = 64;  // every point sees all of them
inline constexpr int kMaxLsqVectors = 64;    // least squares solves a dense K x K system each frame

/// What is out of the limits above in a spec that was not parsed, or nothing.
std::optional<Error> checkRigSpec(const RigSpec& spec);

/// One spec. The Error names the spec, the part at fault and what is allowed there.
Result<RigSpec> parseRigSpec(std::string_view text);

/// Specs separated by ';'. Empty list and duplicates (equal models) are errors.
Result<std::vector<RigSpec>> parseRigSpecs(std::string_view text);

}  // namespace rigel
