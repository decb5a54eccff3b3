// The embedded texels against a new making of them, their edges against closed forms, and the moments they are made
// from against quadrature of the integrals.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/make_disk_table.h>
#include <rigel/shader_disk_table.h>

#include <algorithm>

#include "disk_tables/moment_reference.h"
#include "gpu/packed_rig.h"
#include "lights/random.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::MomentReference;
using reference::Worst;

constexpr std::size_t kTexels = 4 * kDiskTableSize * kDiskTableSize;

// Another machine's pow and exp may round another way, which moves a texel by one step at the very most.
TEST(MakeDiskTable, GivesTheEmbeddedTexels) {
  constexpr double kStep = 0x1p-27;  // of a float below 2^-3; texels are below 0.17
  const DiskTableTexels made = makeDiskTable(kDiskTableSize);
  ASSERT_EQ(made.size, kDiskTableSize);
  Worst worst("embedded texels");
  int different = 0;
  for (int texture = 0; texture < 2; ++texture) {
    const auto embedded = DiskTable::data(texture);
    ASSERT_EQ(embedded.size(), kTexels);
    ASSERT_EQ(made.texels[texture].size(), kTexels);
    for (std::size_t i = 0; i < kTexels; ++i) {
      const float a = made.texels[texture][i], b = embedded[i];
      different += a != b;
      worst.add(std::abs(double(a) - double(b)), [&] { return std::to_string(i); });
    }
  }
  worst.expectWithin(2 * kStep);
  EXPECT_LE(different, 20) << "of " << 2 * kTexels;
  EXPECT_GT(*std::max_element(made.texels[0].begin(), made.texels[0].end()), 0.01f) << "the table is empty";
}

TEST(MakeDiskTable, ProvenanceNamesWhatIsEmbedded) {
  const DiskTable::Provenance provenance = DiskTable::provenance();
  EXPECT_EQ(provenance.hash, hashDiskTable(DiskTable::data(0), DiskTable::data(1)));
  EXPECT_EQ(provenance.version, kDiskTableVersion);
  EXPECT_NE(provenance.command.find("rigel tables --embed"), std::string_view::npos);
}

TEST(MakeDiskTable, HashSeesEveryBit) {
  std::vector<float> a(4, 0.25f), b(4, -1.0f);
  const std::uint64_t hash = hashDiskTable(a, b);
  EXPECT_NE(hash, hashDiskTable(b, a));
  b[3] = std::nextafter(b[3], 0.0f);
  EXPECT_NE(hash, hashDiskTable(a, b));
  // FNV-1a of nothing, and of four zero bytes.
  EXPECT_EQ(hashDiskTable({}, {}), 0xcbf29ce484222325u);
  EXPECT_EQ(hashDiskTable(std::vector<float>{0.0f}, {}), 0x4d25767f9dce13f5u);
}

TEST(MakeDiskTable, HalvesAreTheFloatsRounded) {
  for (int texture = 0; texture < 2; ++texture) {
    const auto floats = DiskTable::data(texture);
    const auto halves = DiskTable::halfData(texture);
    ASSERT_EQ(halves.size(), floats.size());
    for (std::size_t i = 0; i < floats.size(); ++i) {
      const float back = test::floatFromHalf(halves[i]);
      EXPECT_NEAR(back, floats[i], std::max(std::abs(floats[i]) * 0x1p-11f, 0x1p-25f)) << texture << " " << i;
    }
  }
}

// On the axis and on the face c does not depend on psi: one node is all there is.
TEST(MakeDiskTable, NothingIsLeftOnTheAxisAndOnTheFace) {
  const int n = kDiskTableSize;
  for (int texture = 0; texture < 2; ++texture) {
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < 4; ++c) {
        EXPECT_EQ(DiskTable::data(texture)[static_cast<std::size_t>(4 * i + c)], 0) << "axis, " << i;
        EXPECT_EQ(DiskTable::data(texture)[static_cast<std::size_t>(4 * (i * n + n - 1) + c)], 0) << "face, " << i;
      }
    }
  }
  for (std::size_t i = 2; i < kTexels; i += 4) {
    EXPECT_EQ(DiskTable::data(1)[i], 0);
    EXPECT_EQ(DiskTable::data(1)[i + 1], 0);
  }
}

// Far off in the disk's plane (cx = 1) and on the rim (u = 0) <c> is an elliptic integral: on the rim 2 cx / pi.
TEST(MakeDiskTable, CornerOfPlaneAndRimIsElementary) {
  const double average = 2 / M_PI, node = std::sqrt(0.5);
  const auto corner = static_cast<std::size_t>(4 * (kDiskTableSize - 1) * kDiskTableSize);
  EXPECT_NEAR(DiskTable::data(0)[corner + 1], 2 * 0.31539156525252000603 * (average - node), 1e-8);
  // <1/(1 + cos psi)> = 2/pi.
  EXPECT_NEAR(DiskTable::data(0)[corner], 2 * 0.28209479177387814347 * (average - 1 / (1 + node)), 1e-8);
}

TEST(MakeDiskTable, MomentsAgreeWithTheirIntegrals) {
  Worst worst("moments in double");
  test::Random random(41);
  for (int k = 0; k < 3000; ++k) {
    const double ax = random.index(4) == 0 ? random.logUniform(1e-8, 1) : random.uniform(0, M_PI / 2);
    const double rim = random.index(3) == 0 ? random.logUniform(1e-3, 1) : random.uniform(0, M_PI / 2);
    const double beta = M_PI / 2 - rim;
    const auto cone = detail::diskConeOf(std::sin(ax), std::cos(ax), std::sin(beta), std::pow(std::sin(rim), 2));
    const detail::DiskMoments<double> q = detail::exactDiskMoments(cone);
    const MomentReference expected(ax, beta);
    const double differences[] = {q.q00 - expected.q00, q.q20 - expected.q20, q.q22 - expected.q22,
                                  q.q30 - expected.q30, q.q32 - expected.q32, q.q40 - expected.q40,
                                  q.q42 - expected.q42, q.q44 - expected.q44};
    for (const double difference : differences) {
      worst.add(std::abs(difference) / expected.norm(),
                [&] { return std::to_string(ax) + " " + std::to_string(beta); });
    }
  }
  worst.expectWithin(1e-10);
}

}  // namespace
}  // namespace rigel
