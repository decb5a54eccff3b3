#include "light_tree_state.h"

#include <algorithm>

namespace rigel {
namespace {

int longestAxis(const TreeItem* first, const TreeItem* last) noexcept {
  float lo[3] = {first->x, first->y, first->z};
  float hi[3] = {lo[0], lo[1], lo[2]};
  for (const TreeItem* item = first; item != last; ++item) {
    const float p[3] = {item->x, item->y, item->z};
    for (int a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], p[a]);
      hi[a] = std::max(hi[a], p[a]);
    }
  }
  const float e[3] = {hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
  if (e[0] >= e[1] && e[0] >= e[2]) return 0;
  return e[1] >= e[2] ? 1 : 2;
}

template <float TreeItem::*Axis>
void halve(TreeItem* first, TreeItem* middle, TreeItem* last) noexcept {
  // Ties go by the light's index, so that coincident lights are split the same way in every frame.
  std::nth_element(first, middle, last, [](const TreeItem& a, const TreeItem& b) {
    return a.*Axis != b.*Axis ? a.*Axis < b.*Axis : a.light < b.light;
  });
}

/// Splits the items of node `j` of a level, then of those below it.
void order(TreeItem* items, const Tree& tree, int level, std::size_t j) noexcept {
  if (level == tree.depth) return;
  const auto at = [&](std::size_t part, int parts) { return items + ((part * tree.count) >> parts); };
  TreeItem* first = at(j, level);
  TreeItem* middle = at(2 * j + 1, level + 1);
  TreeItem* last = at(j + 1, level);
  const int axis = longestAxis(first, last);
  if (axis == 0) halve<&TreeItem::x>(first, middle, last);
  if (axis == 1) halve<&TreeItem::y>(first, middle, last);
  if (axis == 2) halve<&TreeItem::z>(first, middle, last);
  order(items, tree, level + 1, 2 * j);
  order(items, tree, level + 1, 2 * j + 1);
}

}  // namespace

void orderForTree(TreeItem* items, const Tree& tree) noexcept { order(items, tree, 0, 0); }

}  // namespace rigel
