// Blocks of points in rows, and light that their horizon may cross: the closed form of what is left takes longer than
// all else and is needed at few points, which are put side by side first. Included once per Highway target, after
// lane.h.
#if defined(RIGEL_BLOCK_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_BLOCK_LANES_H
#undef RIGEL_BLOCK_LANES_H
#else
#define RIGEL_BLOCK_LANES_H
#endif

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// What a block's points see. Packing writes a vector at a time, hence the room at the end.
template <int Rows>
struct alignas(64) BlockRows {
  static constexpr int kRows = Rows;
  static constexpr std::size_t kRoom = kPointBlock + Lane::kCount;
  float row[Rows][kRoom];
};

/// `Seen(rows, i)`: a vector of points from i on, of rows `Seen::Rows`. Where crossed() holds its irradiance is
/// clipped(), elsewhere whole(), which clipped() gives there too; zero rows are not crossed.
template <class Seen>
HWY_NOINLINE void clipAll(const typename Seen::Rows& seen, std::size_t points, float* irradiance) {
  for (std::size_t i = 0; i < points; i += Lane::kCount) Seen(seen, i).clipped().store(irradiance + i);
}

template <class Seen>
HWY_NOINLINE void clipCrossed(const typename Seen::Rows& seen, std::size_t points, float* irradiance) {
  using Rows = typename Seen::Rows;
  Rows crossed;
  float index[Rows::kRoom], clipped[Rows::kRoom];
  std::size_t end = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const LaneMask where = Seen(seen, i).crossed();
    const LanePacker packer(where);
    for (int k = 0; k < Rows::kRows; ++k) packer.store(Lane::load(seen.row[k] + i), crossed.row[k] + end);
    packer.store(hn::Iota(Lane::Tag(), static_cast<float>(i)), index + end);
    end += count(where);
  }
  for (auto& row : crossed.row) Lane(0.0f).store(row + end);
  clipAll<Seen>(crossed, end, clipped);
  for (std::size_t i = 0; i < end; ++i) irradiance[static_cast<std::size_t>(index[i])] = clipped[i];
}

/// How many points a horizon crosses.
template <class Seen>
HWY_NOINLINE std::size_t wholeBlock(const typename Seen::Rows& seen, std::size_t points, float* irradiance) {
  std::size_t crossed = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const Seen at(seen, i);
    at.whole().store(irradiance + i);
    crossed += count(at.crossed());
  }
  return crossed;
}

template <class Seen>
HWY_INLINE void irradianceOf(const typename Seen::Rows& seen, std::size_t points, float* irradiance) {
  const std::size_t crossed = wholeBlock<Seen>(seen, points, irradiance);
  // Packing costs a quarter of what clipping a disk does, half of what a sphere does.
  if (4 * crossed > 3 * points) return clipAll<Seen>(seen, points, irradiance);
  if (crossed > 0) clipCrossed<Seen>(seen, points, irradiance);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
