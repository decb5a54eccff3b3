// The look-up against the exact projection, as floats and as half-floats: over all distances and angles, where the
// table is exact, and of any size.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/make_disk_table.h>
#include <rigel/project.h>
#include <rigel/shader_disk_table.h>

#include "disk_tables/disk_poses.h"
#include "gpu/packed_rig.h"
#include "lights/describe.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::DiskPose;
using test::Random;

/// ||q - exact|| / ||exact|| in red. Poses without light count as no error where both are zero.
template <int B>
double errorOf(const DiskTableView& table, const DiskLight& light, Vec3 p) {
  const RadianceSH<B> q = table.project<B>(light, p);
  double exact[3 * shCount(B)];
  projectDiskExact(light, p, B, exact);
  double error = 0, norm = 0;
  for (int i = 0; i < shCount(B); ++i) {
    error += std::pow(static_cast<double>(q[i].r) - exact[3 * i], 2);
    norm += std::pow(exact[3 * i], 2);
  }
  return norm > 0 ? std::sqrt(error / norm) : error > 0 ? 1 : 0;
}

template <int B>
void add(Worst& worst, const DiskTableView& table, const DiskLight& light, Vec3 p) {
  worst.add(errorOf<B>(table, light, p), [&] {
    return std::to_string(B) + " bands, direction " + describe(light.direction) + ", radius " + describe(light.radius) +
           ", p " + describe(p);
  });
}

/// Receivers at least 1e-3 radii from the rim, all numbers of bands.
Worst worstOf(const char* name, const DiskTableView& table, int poses) {
  Worst worst(name);
  Random random(51);
  for (int k = 0; k < poses; ++k) {
    const DiskPose pose = test::randomDiskPose(random, random.logUniform(1e-2, 1e2));
    if (pose.rimDistance < 1e-3) continue;
    add<2>(worst, table, pose.light, pose.p);
    add<3>(worst, table, pose.light, pose.p);
    add<4>(worst, table, pose.light, pose.p);
    add<5>(worst, table, pose.light, pose.p);
  }
  return worst;
}

constexpr double kInterpolation = 1.6e-4;  // measured 1.5e-4, with five bands

int poseCount() { return test::fullRun() ? 1'000'000 : 20'000; }

/// A table that owns its texels.
struct OwnTable {
  std::vector<float> texture0, texture1;
  int size = kDiskTableSize;
  DiskTableView view() const { return {size, texture0, texture1}; }
};

OwnTable roundedToHalves() {
  OwnTable table;
  for (const std::uint16_t half : DiskTable::halfData(0)) table.texture0.push_back(test::floatFromHalf(half));
  for (const std::uint16_t half : DiskTable::halfData(1)) table.texture1.push_back(test::floatFromHalf(half));
  return table;
}

// Asked of the table: 6e-4.
TEST(DiskTable, IsWithinItsErrorOfTheExactProjection) {
  worstOf("32x32 float", DiskTable::view(), poseCount()).expectWithin(kInterpolation);
}

// Asked: 8e-4.
TEST(DiskTable, HalfFloatsAddLittle) {
  constexpr double kInterpolationAndRounding = 2.1e-4;
  const OwnTable halves = roundedToHalves();
  worstOf("32x32 half", halves.view(), poseCount()).expectWithin(kInterpolationAndRounding);
}

// The error of interpolation falls with the square of the size, down to where floats round.
TEST(DiskTable, OtherSizesScaleAsTheyShould) {
  const auto errorAt = [](int size) {
    DiskTableTexels texels = makeDiskTable(size);
    const OwnTable table{std::move(texels.texels[0]), std::move(texels.texels[1]), size};
    return worstOf(("size " + std::to_string(size)).c_str(), table.view(), 5000).error();
  };
  const double at16 = errorAt(16), at64 = errorAt(64);
  EXPECT_LE(at16, 6.5e-4);
  EXPECT_LE(at64, 4.5e-5);
  EXPECT_GT(at16 / at64, 12);
}

TEST(DiskTable, IsExactOnTheAxisOnTheFaceAndFarAway) {
  constexpr double kRounding = 1e-6;
  Worst axis("on the axis"), face("on the face"), far("at a million radii");
  Random random(52);
  for (int k = 0; k < 2000; ++k) {
    const DiskLight light{{0, 0, 0}, {0, -1, 0}, 1, random.colour(), false};
    add<5>(axis, DiskTable::view(), light, {0, -random.uniformf(0, 3), 0});
    const double angle = random.uniform(0, 2 * M_PI), rho = 0.9 * std::sqrt(random.uniform());
    add<5>(face, DiskTable::view(), light,
           {static_cast<float>(rho * std::cos(angle)), -1e-7f, static_cast<float>(rho * std::sin(angle))});
    Vec3 direction = random.direction();
    direction.y = -std::abs(direction.y);
    add<5>(far, DiskTable::view(), light, direction * 1e6f);
  }
  axis.expectWithin(kRounding);
  face.expectWithin(kRounding);
  far.expectWithin(kRounding);
}

// The last row of the table is the rim itself: unlike a quadrature it loses nothing there.
TEST(DiskTable, HoldsUpToTheRim) {
  Worst worst("at the rim");
  Random random(53);
  for (int k = 0; k < poseCount(); ++k) {
    const DiskPose pose = test::randomDiskPose(random);
    if (pose.rimDistance > 1e-2) continue;
    add<5>(worst, DiskTable::view(), pose.light, pose.p);
  }
  worst.expectWithin(kInterpolation);
}

// The corners of the domain are those of the textures: far away, on the face, in the plane at the rim.
TEST(DiskTable, DomainIsTheSquare) {
  EXPECT_EQ(detail::diskTableU(detail::diskConeOf(0.0f, 1.0f, 0.0f, 1.0f)), 0);
  EXPECT_EQ(detail::diskTableV(detail::diskConeOf(0.0f, 1.0f, 0.0f, 1.0f)), 0);
  EXPECT_EQ(detail::diskTableU(detail::diskConeOf(1.0f, 0.0f, 0.0f, 1.0f)), 1);
  EXPECT_EQ(detail::diskTableV(detail::diskConeOf(0.0f, 1.0f, 1.0f, 0.0f)), 1);
}

// The table and the quadrature see the same light: footprint, both sides, what is no light.
TEST(DiskTable, TakesFootprintAndSidesAsProjectDoes) {
  constexpr double kBoth = 1.5e-4;  // three bands of the table and six nodes together
  Worst worst("against project()");
  Random random(54);
  int lit = 0, dark = 0;
  for (int k = 0; k < 3000; ++k) {
    DiskPose pose = test::randomDiskPose(random);
    if (random.index(2) == 0) pose.p = pose.p * -1.0f;
    if (pose.rimDistance < 0.1) continue;
    const float footprint = random.index(2) == 0 ? 0.0f : random.uniformf(0, 0.5);
    const RadianceSH<3> q = DiskTable::project<3>(pose.light, pose.p, footprint);
    const RadianceSH<3> expected = project<3>(pose.light, pose.p, footprint);
    double error = 0, norm = 0;
    for (int i = 0; i < 9; ++i) {
      error += std::pow(static_cast<double>(q[i].g) - static_cast<double>(expected[i].g), 2);
      norm += std::pow(static_cast<double>(expected[i].g), 2);
    }
    ++(norm > 0 ? lit : dark);
    worst.add(norm > 0 ? std::sqrt(error / norm) : error, [&] { return describe(pose.p); });
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(dark, 100);
  worst.expectWithin(kBoth);
}

}  // namespace
}  // namespace rigel
