// What a texture unit makes of a lattice, in C++: coordinates as in rig_texture.glsl, filtering as Vulkan defines it
// ("Texel Filtering": from normalised coordinates to texels, weights from their fractions), all of it in float32.
#pragma once

#include <rigel/gpu_rig.h>
#include <rigel/shader_lattice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rigel::test {

template <int B>
class TextureTwin {
 public:
  /// `texels`: RGBA, as the texture reads.
  TextureTwin(const GpuRig& rig, GpuTextureSize size, std::span<const float> texels)
      : rig_(rig), size_(size), texels_(texels) {}

  RadianceSH<B> operator()(Vec3 p) const {
    const Vec3 at = coordinates(p);
    constexpr int kSlabs = gpuVectorSize(B);
    RadianceSH<B> sh;
    for (int slab = 0; slab < kSlabs; ++slab) {
      const std::array<float, 4> texel =
          filtered({at.x, at.y, at.z + static_cast<float>(slab) * (1.0f / static_cast<float>(kSlabs))});
      for (int i = 0; i < 4; ++i) {
        const int number = 4 * slab + i;
        if (number < 3 * shCount(B)) sh[number / 3][number % 3] = texel[i] * rig_.scale;
      }
    }
    return sh;
  }

 private:
  Vec3 coordinates(Vec3 p) const {
    const auto& c = rig_.centre;
    const Vec3 d{p.x - c.x, p.y - c.y, p.z - c.z};
    const auto along = [&](const auto& axis, int nodes, int slabs) {
      float u = axis.x * d.x + axis.y * d.y + axis.z * d.z + axis.w;
      if (std::isnan(u)) u = 0;
      float x = (std::clamp(u, -1.0f, 1.0f) + 1.0f) * 0.5f * static_cast<float>(nodes - 1);
      if (rig_.kernel == shader_types::kGpuSmooth) x = std::floor(x) + detail::latticeSmooth(x - std::floor(x));
      return (x + 0.5f) / static_cast<float>(nodes * slabs);
    };
    return {along(rig_.axisX, rig_.nodes.x, 1), along(rig_.axisY, rig_.nodes.y, 1),
            along(rig_.axisZ, rig_.nodes.z, gpuVectorSize(B))};
  }

  struct Between {
    int low, high;
    float part;
  };
  static Between between(float coordinate, int texels) {
    const float x = coordinate * static_cast<float>(texels) - 0.5f;
    const int low = static_cast<int>(std::floor(x));
    return {std::clamp(low, 0, texels - 1), std::clamp(low + 1, 0, texels - 1), x - std::floor(x)};
  }

  std::array<float, 4> filtered(Vec3 at) const {
    const Between x = between(at.x, size_.width), y = between(at.y, size_.height), z = between(at.z, size_.depth);
    std::array<float, 4> out;
    for (int i = 0; i < 4; ++i) {
      const auto texel = [&](int a, int b, int c) {
        return texels_[4 * static_cast<std::size_t>((c * size_.height + b) * size_.width + a) + i];
      };
      const auto mix = [](float a, float b, float part) { return a + (b - a) * part; };
      const auto row = [&](int b, int c) { return mix(texel(x.low, b, c), texel(x.high, b, c), x.part); };
      const auto slab = [&](int c) { return mix(row(y.low, c), row(y.high, c), y.part); };
      out[i] = mix(slab(z.low), slab(z.high), z.part);
    }
    return out;
  }

  const GpuRig& rig_;
  GpuTextureSize size_;
  std::span<const float> texels_;
};

}  // namespace rigel::test
