// Where the light tree is asked about characters: cells of a grid over the world. All characters in a cell share one
// selection, which depends on the cell and the lights alone, so that nobody is changed by a neighbour. At a cell's
// faces characters belong to both sides, by shares that are continuous in their place: nothing jumps there.
#pragma once

#include <rigel/vec3.h>

#include <compare>
#include <cstdint>

namespace rigel::crowd {

/// One cell: its middle is at x, y, z times its size, which is the grid's times 2^level; half of that along y. So what
/// stands on a ground at height 0 is not between two cells.
struct Cell {
  std::int32_t x = 0, y = 0, z = 0;
  std::int32_t level = 0;  // larger than 0 for characters that are large for the grid
  std::uint32_t groups = 0;
  friend auto operator<=>(const Cell&, const Cell&) = default;
};

/// How much of a character is lit by a cell's selection.
struct CellShare {
  Cell cell;
  float share = 0;
};

/// Both sides of three axes, and two levels.
inline constexpr int kMostShares = 16;

/// The cells of a ball, which is finite; their shares sum to 1. `size` [m] of level 0; returns how many.
int cellsOf(Vec3 centre, float radius, float size, std::uint32_t groups, CellShare* out) noexcept;

/// What holds every ball that has a share in the cell.
struct CellBall {
  Vec3 centre;
  float radius;
};
CellBall ballOf(const Cell& cell, float size) noexcept;

/// The region of kRegionSide^3 cells that a cell is in, numbered as cells are: its middle is at x, y, z times its own
/// size, half of that along y.
inline constexpr int kRegionSide = 5;
Cell regionOf(const Cell& cell) noexcept;
/// What holds the balls of all cells of a region.
CellBall ballOfRegion(const Cell& region, float size) noexcept;

/// Sorting by it brings together what is near in space (Morton 1966). Places that are not finite come last.
std::uint64_t placeKey(Vec3 p, float size) noexcept;
/// Keys of one cell of level 0 are alike but for these bits.
inline constexpr int kPlaceBits = 9;

}  // namespace rigel::crowd
