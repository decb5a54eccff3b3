// Which of many choices no other beats in both cost and error.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rigel::tools {

/// Less is better in both. What is not finite in both was not measured: it is on no front and beats nothing.
struct CostAndError {
  double cost = 0, error = 0;
};

/// Indices of the points that no other dominates (is at most as large in both and smaller in one), by rising cost, then
/// by index. Equal points are on the front together. O(n log n).
std::vector<std::size_t> paretoFront(std::span<const CostAndError> points);

/// How far a choice is from the best of others.
struct FrontDistance {
  double cost = 1;   // its cost over the least at which another has no more error; 1 where none is cheaper
  double error = 1;  // its error over the least that another has at no more cost; 1 where none has less

  /// The change of either that takes the point to the front, 1 on it.
  double nearest() const { return cost < error ? cost : error; }
};

/// Of a finite point against `others`; the point itself among them changes nothing.
FrontDistance distanceToFront(CostAndError point, std::span<const CostAndError> others);

}  // namespace rigel::tools
