// Rigs as shaders read them (shaders/include/rigel/rig.glsl): a GpuRig each, and their coefficients in one buffer of
// vec4 that all characters share, as float32 or half floats, or a lattice's in a 3-D texture.
//
// Buffers belong to the caller, who asks for their size beforehand. Nothing here allocates; any number of threads may
// pack into different parts of a buffer. Coefficients are stored as pi times radiance SH, interleaved RGB, padded to
// whole vec4 with zeros.
#pragma once

#include <rigel/object_lighting.h>
#include <rigel/rig_light.h>
#include <rigel/shader_types.h>

#include <cstdint>
#include <optional>
#include <span>

namespace rigel {

using GpuVec4 = shader_types::vec4;

/// Four half floats, a texel of RGBA16F.
struct GpuHalf4 {
  std::uint16_t x = 0, y = 0, z = 0, w = 0;
};

/// vec4 that an SH vector takes: 3, 7, 12, 19 for 2 to 5 bands.
constexpr int gpuVectorSize(int bands) noexcept { return (3 * shCount(bands) + 3) / 4; }

/// The error that such rigs have no shaders, for the models that were tried and dropped (rbf, latticegrad, hermite);
/// nothing for all others. What follows is for those others alone.
std::optional<Error> checkGpuRig(const RigSpec& spec);

/// Where a rig's numbers go, in vec4 of their buffer.
struct GpuRigPlace {
  int offset = 0;       // of the coefficients
  int vectors = 0;      // SH vectors to have there at least: more than the rig holds in a frame are 0, so that a shader
                        // may sum a fixed number of them
  int gaussOffset = 0;  // of what packGaussNodes wrote; @gauss only
};

/// vec4 that packRig writes at most, in any frame: SH vectors, and a high band.
int packRigBound(const Rig& rig, int bands, int vectors = 0) noexcept;

/// The rig with its pose in the world, its K = coefficients.size() <= rig.shVectors() SH vectors (a prefix of them for
/// `auto`) and a high band (or none), which go to `buffer` from place.offset on. Non-finite coefficients stay so.
/// Cost: 3 B^2 K products.
template <int B>
GpuRig packRig(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
               const HighBand& highBand, const GpuRigPlace& place, std::span<GpuVec4> buffer) noexcept;

/// The same in half floats, rounded to nearest even, over GpuRig::scale: a power of two that brings the rig's largest
/// coefficient between 2^14 and 2^15. No coefficient is off by more than 2^-11 of itself or, below 2^-28 of the
/// largest, 2^-39 of that. Light of less than 2e-26 altogether fades out.
template <int B>
GpuRig packRig(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
               const HighBand& highBand, const GpuRigPlace& place, std::span<GpuHalf4> buffer) noexcept;

/// The nodes of a rig @gauss, which stay the same from frame to frame, always in float32; none for other rigs. Writes
/// packGaussNodesBound(rig) vec4.
int packGaussNodesBound(const Rig& rig) noexcept;
void packGaussNodes(const Rig& rig, std::span<GpuVec4> out) noexcept;

/// A texture's width, height and depth in texels.
struct GpuTextureSize {
  int width = 1, height = 1, depth = 1;

  int texels() const noexcept { return width * height * depth; }
};

/// Can a texture unit interpolate such a rig? A lattice or constant, linear or smooth, of samples at its nodes.
bool fitsTexture(const RigSpec& spec) noexcept;

/// The 3-D texture of a rig: its nodes along the axes by decreasing number, times gpuVectorSize slabs of depth (64
/// nodes and 3 bands: 8x4x14). Nothing where fitsTexture says no: those are for buffers.
std::optional<GpuTextureSize> textureSize(const Rig& rig, int bands) noexcept;

/// The rig with its pose in the world and its coefficients, rig.shVectors() of them, as texels, x fastest; `texels` has
/// textureSize's number. A high band goes elsewhere (packHighBand).
/// Half floats as in packRig.
template <int B>
GpuRig packTexture(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                   std::span<GpuVec4> texels) noexcept;
template <int B>
GpuRig packTexture(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                   std::span<GpuHalf4> texels) noexcept;

/// The high band of a rig whose vectors are in a texture: written to `buffer` from vec4 `offset` on, over packed.scale,
/// and noted in `packed`. Takes packHighBandBound() vec4.
int packHighBandBound() noexcept;
void packHighBand(const HighBand& highBand, int offset, std::span<GpuVec4> buffer, GpuRig& packed) noexcept;

}  // namespace rigel
