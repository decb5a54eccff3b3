// FLIP: how large a difference a viewer sees who flips between two pictures (P. Andersson, J. Nilsson,
// T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", HPG
// 2020), for pictures as a screen shows them.
#pragma once

#include "picture/image.h"

#include <array>
#include <vector>

namespace rigel::tools {

/// Pixels a degree of a 0.7 m wide screen of 3840 pixels, 0.7 m away: the paper's.
inline constexpr double kFlipPixelsPerDegree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180;

/// One picture, to be compared with others of its size. About 0.1 s for 560 x 420 pixels, as long again each time.
class Flip {
 public:
  explicit Flip(const Image8& reference, double pixelsPerDegree = kFlipPixelsPerDegree);

  /// In [0, 1] a pixel, rows from the top; 0 where no difference is seen. Of the two pictures either may be the
  /// reference.
  std::vector<float> against(const Image8& test) const;

 private:
  /// What is compared: a colour as a viewer at that distance sees it, and how much of an edge and of a point there is.
  struct Seen {
    std::array<std::vector<float>, 3> colour;  // L* a* b* with Hunt's adjustment
    std::vector<float> edge, point;
  };
  Seen see(const Image8& image) const;

  int width_, height_;
  double pixelsPerDegree_;
  Seen reference_;
};

}  // namespace rigel::tools
