// Value and slopes of many distant lights' SH at one point, with lights in the lanes of a vector: what a whole group of
// objects can share (light_tree.h, LightSelection::distant).
#pragma once

#include <rigel/prepared_lights.h>
#include <rigel/project.h>

#include <cstddef>
#include <span>
#include <vector>

namespace rigel {

namespace detail {

/// Lights in rows; what is missing has flux 0.
struct FarBlock {
  static constexpr int kSize = 64;
  alignas(64) float x[kSize], y[kSize], z[kSize];
  alignas(64) float squaredRadius[kSize];
  alignas(64) float flux[3][kSize];  // times share
};

}  // namespace detail

/// Lights brought together once, to be summed at many points. 28 bytes a light, in steps of 64 lights.
class FarLightList {
 public:
  void reserve(std::size_t uses) { blocks_.reserve(uses / detail::FarBlock::kSize + 1); }
  /// Replaces what was in it. Directional lights and disks are left out. Allocates only while it grows.
  void set(const PreparedLights& lights, std::span<const LightUse> uses);
  std::span<const detail::FarBlock> blocks() const noexcept { return blocks_; }
  std::size_t bytes() const noexcept { return blocks_.capacity() * sizeof(detail::FarBlock); }

 private:
  std::vector<detail::FarBlock> blocks_;
};

/// Sum over `uses` of share times the light's SH at p and its derivative by p: as projectWithGradient, of lights
/// without their window, cone and cosine. Made for points, spheres and directional lights, and spots that light p
/// fully, from two radii away on; closer than that finite, and too little. Disks are left out.
///
/// Errors per sum of the lights' ||q||: value 1e-6, slope 3e-6 (of ||q||/d). 10 ns a light with AVX-512 for 2 and 3
/// bands, where some hundreds out of 100,000 lights are taken; 4 and 5 bands take the scalar functions' time. B
/// in 2..5. No allocation; any number of threads.
template <int B>
ProjectionWithGradient<B> projectFar(const PreparedLights& lights, std::span<const LightUse> uses, Vec3 p) noexcept;
/// The same in less than half the time: nothing has to be brought together.
template <int B>
ProjectionWithGradient<B> projectFar(const FarLightList& lights, Vec3 p) noexcept;

}  // namespace rigel
