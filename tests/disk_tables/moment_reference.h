// Moments of a disk's elliptic cone by quadrature of the integrals as they are written down in the literature of the
// cone's frame, sharing no text with shader_disk.h.
#pragma once

#include <cmath>

#include "reference/smoothed_quadrature.h"

namespace rigel::reference {

/// SH per vector irradiance (coefficient (1, 0) is sqrt(3/4pi)) of the cone whose half-angles are ax in the mirror
/// plane through the disk's axis and ay across it: sin^2 ay = sin^2 ax + t^2 cos^2 ax, t = sin(beta).
struct MomentReference {
  double q00, q10, q20, q22, q30, q32, q40, q42, q44;

  MomentReference(double ax, double beta) {
    const double sx2 = std::pow(std::sin(ax), 2), cx = std::cos(ax), t2 = std::pow(std::sin(beta), 2);
    const double sy2 = sx2 + t2 * cx * cx;
    const auto average = [&](const auto& h) {
      return 2 / M_PI *
             integrateSmoothed(
                 [&](double rest) {  // pi/2 - psi: near the rim c vanishes there
                   const double cos2 = std::pow(std::sin(rest), 2), sin2 = std::pow(std::cos(rest), 2);
                   const double c = cx * std::sqrt(cos2 + std::pow(std::cos(beta), 2) * sin2);
                   return h(c, sx2 * cos2 - sy2 * sin2, sx2 * cos2 + sy2 * sin2);
                 },
                 0, M_PI / 2);
    };
    const auto scale = [](double perPi) { return 2 * std::sqrt(perPi / M_PI); };
    q00 = scale(1.0 / 4) * average([](double c, double, double) { return 1 / (1 + c); });
    q10 = scale(3.0 / 4) / 2;
    q20 = scale(5.0 / 4) * average([](double c, double, double) { return c / 2; });
    q22 = scale(15.0 / 16) * average([](double c, double e, double) { return (2 + c) * e / (3 * (1 + c) * (1 + c)); });
    q30 = scale(7.0 / 16) / 2 * (2 - 1.25 * (sx2 + sy2));
    q32 = scale(105.0 / 16) / 2 * (sx2 - sy2) / 4;
    q40 = scale(9.0 / 4) * average([](double c, double, double k2) { return c * (4 - 7 * k2) / 8; });
    q42 = scale(45.0 / 64) * average([](double c, double e, double) {
            return (c * (c * (1.4 * c + 2.8) + 23.0 / 15) + 4.0 / 15) * e / ((1 + c) * (1 + c));
          });
    q44 = scale(315.0 / 256) * average([](double c, double e, double k2) {
            return (8 + 9 * c + 3 * c * c) * (2 * e * e - k2 * k2) / (15 * std::pow(1 + c, 3));
          });
  }

  double norm() const {
    return std::sqrt(q00 * q00 + q10 * q10 + q20 * q20 + q22 * q22 + q30 * q30 + q32 * q32 + q40 * q40 + q42 * q42 +
                     q44 * q44);
  }
};

}  // namespace rigel::reference
