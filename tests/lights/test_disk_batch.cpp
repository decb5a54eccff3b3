// Many points against one disk light in vectors: on every instruction set of this machine, what the scalar functions
// give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rigel/disk_batch.h>
#include <rigel/near_light.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "lights/describe.h"
#include "lights/every_target.h"
#include "lights/random.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::onEveryTarget;
using test::Random;

// Relative to the norm of the SH vector, and to the peak over normals. Worst measured 1.1e-6 and 1.2e-6: the scalar
// functions form their geometry in double, the vectors only what cancels.
constexpr double kShTolerance = 2e-6;
constexpr double kIrradianceTolerance = 2e-6;

constexpr DiskNodes kNodes[] = {DiskNodes::four, DiskNodes::six, DiskNodes::eight};
constexpr float kUntouched = -12345;

/// Points and normals in rows that begin `offset` floats behind an aligned address.
struct Rows {
  explicit Rows(int offset = 0) : offset_(offset) {
    for (auto& row : rows_) row.assign(offset, kUntouched);
  }
  void add(Vec3 p, Vec3 n) {
    for (int axis = 0; axis < 3; ++axis) {
      rows_[axis].push_back(p[axis]);
      rows_[3 + axis].push_back(n[axis]);
    }
  }
  std::size_t size() const { return rows_[0].size() - offset_; }
  Vec3Rows points() const { return {row(0), row(1), row(2)}; }
  Vec3Rows normals() const { return {row(3), row(4), row(5)}; }
  Vec3 point(std::size_t i) const { return {row(0)[i], row(1)[i], row(2)[i]}; }
  Vec3 normal(std::size_t i) const { return {row(3)[i], row(4)[i], row(5)[i]}; }

 private:
  std::span<const float> row(int i) const { return std::span(rows_[i]).subspan(offset_); }

  int offset_;
  std::vector<float> rows_[6];
};

DiskLight randomDisk(Random& random) {
  DiskLight light;
  light.direction = random.direction() * random.uniformf(0.1, 10);
  light.radius = static_cast<float>(random.logUniform(1e-15, 1e15));
  light.position = random.pointInCube(static_cast<double>(light.radius) * 0.3);
  light.radiance = {1, 1, 1};
  light.twoSided = random.index(2) == 0;
  return light;
}

/// Anywhere, on the axis or near it, on the face, at the rim, near the plane or very far; in front and behind.
Vec3 hardPoint(Random& random, const DiskLight& light) {
  double rho = random.logUniform(1e-3, 1e4), z = random.logUniform(1e-3, 1e4);
  switch (random.index(6)) {
    case 0:
      rho = random.index(2) == 0 ? 0 : random.logUniform(1e-9, 1e-2) * z;
      break;
    case 1:
      z = random.logUniform(1e-6, 1e-2);
      break;
    case 2: {
      const double gap = random.logUniform(1e-3, 1e-1), angle = random.uniform(0, M_PI);
      rho = 1 + gap * std::cos(angle);
      z = gap * std::sin(angle);
      break;
    }
    case 3:
      z = rho * random.logUniform(1e-5, 1e-1);
      break;
    case 4:
      rho *= 1e8;
      break;
    default:
      break;
  }
  const Vec3 axis = light.direction * (1 / length(light.direction));
  const Vec3 side = cross(axis, random.direction());
  const double sign = random.index(3) == 0 ? -1 : 1;
  return light.position +
         (axis * static_cast<float>(sign * z) + side * static_cast<float>(rho / length(side))) * light.radius;
}

/// So nearly in the disk's plane that doubles do not tell on which side: not to be compared.
bool allButInPlane(const DiskLight& light, Vec3 p) {
  double along = 0, direction2 = 0, distance2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = static_cast<double>(light.position[axis]) - p[axis], a = light.direction[axis];
    along += v * a;
    direction2 += a * a;
    distance2 += v * v;
  }
  return std::abs(along) < 1e-9 * std::sqrt(direction2 * distance2);
}

/// `across`: with normals whose horizon passes through the disk's centre.
Rows hardRows(Random& random, const DiskLight& light, int count, bool across = false) {
  Rows rows;
  while (static_cast<int>(rows.size()) < count) {
    const Vec3 p = hardPoint(random, light);
    if (allButInPlane(light, p)) continue;
    Vec3 n = random.direction();
    const Vec3 w = light.position - p;
    const float scale = std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
    if (across && scale > 0) n = cross(w * (1 / scale), n);
    rows.add(p, n * (1 / length(n)));
  }
  return rows;
}

template <int B>
void compareSh(Worst& worst, const DiskLight& light, const Rows& rows, DiskNodes nodes) {
  std::vector<float> sh(B * B * rows.size());
  projectDiskBatch<B>(light, rows.points(), nodes, sh);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RadianceSH<B> expected = projectDisk<B>(light, rows.point(i), nodes);
    double squared = 0, difference = 0;
    for (int k = 0; k < B * B; ++k) {
      const double e = expected[k].r, d = std::abs(static_cast<double>(sh[k * rows.size() + i]) - e);
      squared += e * e;
      difference = d <= difference ? difference : d;
    }
    const double error = difference == 0 ? 0 : difference / std::sqrt(squared);
    worst.add(error, [&] { return describe(light) + ", p " + describe(rows.point(i)); });
  }
}

template <int B>
void compareAllNodes() {
  onEveryTarget([] {
    Worst worst("disk SH in vectors, " + std::to_string(B) + " bands");
    Random random(401);
    for (int k = 0; k < (test::fullRun() ? 10'000 : 100); ++k) {
      const DiskLight light = randomDisk(random);
      const Rows rows = hardRows(random, light, 70 + random.index(80));
      for (const DiskNodes nodes : kNodes) compareSh<B>(worst, light, rows, nodes);
    }
    worst.expectWithin(kShTolerance);
  });
}

TEST(DiskBatch, ShOf2Bands) { compareAllNodes<2>(); }
TEST(DiskBatch, ShOf3Bands) { compareAllNodes<3>(); }
TEST(DiskBatch, ShOf4Bands) { compareAllNodes<4>(); }
TEST(DiskBatch, ShOf5Bands) { compareAllNodes<5>(); }

TEST(DiskBatch, Irradiance) {
  onEveryTarget([] {
    Worst worst("disk irradiance in vectors");
    Random random(402);
    for (int k = 0; k < (test::fullRun() ? 20'000 : 200); ++k) {
      const DiskLight light = randomDisk(random);
      const Rows rows = hardRows(random, light, 70 + random.index(80), k % 3 == 0);
      std::vector<float> irradiance(rows.size());
      diskIrradianceBatch(light, rows.points(), rows.normals(), irradiance);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vec3 p = rows.point(i), n = rows.normal(i);
        NearLight near = nearLight(light);
        near.axis = light.direction;  // what its rounding costs is no matter of vectors
        const double expected = nearIrradiance(near, p, n).r;
        const double difference = std::abs(static_cast<double>(irradiance[i]) - expected);
        const detail::LocalDisk disk = detail::localDisk(light, p);
        const double vector = disk.powerScale * detail::viewOf<double>(disk).flux;
        const double error = difference == 0 ? 0 : difference / vector;
        worst.add(error, [&] {
          return describe(light) + ", p " + describe(p) + ", n " + describe(n) + ": " + describe(irradiance[i]) +
                 ", expected " + describe(expected);
        });
      }
    }
    worst.expectWithin(kIrradianceTolerance);
  });
}

TEST(DiskBatch, AnyCountAndAlignmentGivesTheSame) {
  onEveryTarget([] {
    Random random(403);
    const DiskLight light{{0.1f, 0.2f, 0.3f}, {0.2f, -1, 0.1f}, 0.4f, {1, 1, 1}, true};
    const Rows all = hardRows(random, light, 150);
    std::vector<float> sh(9 * all.size()), irradiance(all.size());
    projectDiskBatch<3>(light, all.points(), DiskNodes::six, sh);
    diskIrradianceBatch(light, all.points(), all.normals(), irradiance);
    for (int count = 0; count <= 150; count += count < 70 ? 1 : 16) {
      Rows some(1 + count % 5);
      for (int i = 0; i < count; ++i) some.add(all.point(i), all.normal(i));
      // One number before and one behind that no kernel may write.
      std::vector<float> someSh(9 * count + 2, kUntouched), someIrradiance(count + 2, kUntouched);
      projectDiskBatch<3>(light, some.points(), DiskNodes::six, std::span(someSh).subspan(1, 9 * count));
      diskIrradianceBatch(light, some.points(), some.normals(), std::span(someIrradiance).subspan(1, count));
      for (int i = 0; i < count; ++i) {
        ASSERT_EQ(someIrradiance[1 + i], irradiance[i]) << i << " of " << count;
        for (int k = 0; k < 9; ++k)
          ASSERT_EQ(someSh[1 + k * count + i], sh[k * all.size() + i]) << i << " of " << count;
      }
      for (const auto* out : {&someSh, &someIrradiance}) {
        ASSERT_EQ(out->front(), kUntouched);
        ASSERT_EQ(out->back(), kUntouched);
      }
    }
  });
}

TEST(DiskBatch, NoLightFromWhatIsNowhere) {
  onEveryTarget([] {
    constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
    const DiskLight light{{0, 1, 0}, {0, -1, 0}, 1, {1, 1, 1}, true};
    Rows rows;
    for (const float x : {kInf, -kInf, kNan})
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 p{0.1f, 0.2f, 0.3f};
        p[axis] = x;
        rows.add(p, {0, 1, 0});
      }
    rows.add({0.5f, 1, 0}, {0, 1, 0});  // in the plane
    std::vector<float> sh(25 * rows.size(), kUntouched), irradiance(rows.size(), kUntouched);
    projectDiskBatch<5>(light, rows.points(), DiskNodes::six, sh);
    diskIrradianceBatch(light, rows.points(), rows.normals(), irradiance);
    EXPECT_THAT(sh, testing::Each(0.0f));
    EXPECT_THAT(irradiance, testing::Each(0.0f));

    // Without a normal, alone and among points whose horizon crosses the disk.
    for (const bool across : {false, true}) {
      Rows unsure;
      for (int i = 0; i < 20; ++i) unsure.add({0, 0.1f, 0}, i % 5 == 0 || !across ? Vec3{0, kNan, 0} : Vec3{1, 0, 0});
      irradiance.assign(unsure.size(), kUntouched);
      diskIrradianceBatch(light, unsure.points(), unsure.normals(), irradiance);
      for (int i = 0; i < 20; ++i) EXPECT_EQ(irradiance[i] > 0, across && i % 5 != 0) << i << ": " << irradiance[i];
    }

    Rows below;
    for (int i = 0; i < 20; ++i) below.add({0.1f, 0.01f * static_cast<float>(i), 0}, {0, 1, 0});
    sh.assign(9 * below.size(), kUntouched);
    irradiance.assign(below.size(), kUntouched);
    diskIrradianceBatch(light, below.points(), below.normals(), irradiance);
    EXPECT_THAT(irradiance, testing::Each(testing::Gt(0.0f)));
    DiskLight dark[] = {light, light, light, light, light};
    dark[0].radius = 0;
    dark[1].radius = kNan;
    dark[2].direction = {};
    dark[3].direction.x = kNan;
    dark[4].position.z = kNan;
    for (const DiskLight& none : dark) {
      projectDiskBatch<3>(none, below.points(), DiskNodes::four, sh);
      diskIrradianceBatch(none, below.points(), below.normals(), irradiance);
      EXPECT_THAT(sh, testing::Each(0.0f)) << describe(none);
      EXPECT_THAT(irradiance, testing::Each(0.0f)) << describe(none);
    }
  });
}

}  // namespace
}  // namespace rigel
