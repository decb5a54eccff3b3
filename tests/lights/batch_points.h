// Points, lights and sums as projectBatch takes and gives them.
#pragma once

#include <rigel/project_batch.h>

#include <vector>

namespace rigel::test {

/// Points in rows that begin `offset` floats behind an aligned address.
class BatchPoints {
 public:
  explicit BatchPoints(int offset = 0) : offset_(static_cast<std::size_t>(offset)) {
    for (auto& row : rows_) row.assign(offset_, 0);
  }
  void add(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) rows_[axis].push_back(p[axis]);
  }
  std::size_t size() const { return rows_[0].size() - offset_; }
  Vec3Rows rows() const { return {row(0), row(1), row(2)}; }
  Vec3 operator[](std::size_t i) const { return {row(0)[i], row(1)[i], row(2)[i]}; }

 private:
  std::span<const float> row(int i) const { return std::span(rows_[i]).subspan(offset_); }

  std::size_t offset_;
  std::vector<float> rows_[3];
};

template <int B>
std::vector<float> sumsOf(const LightSet& lights, const BatchPoints& points, std::span<const float> footprints = {}) {
  PreparedLights prepared;
  prepared.set(lights);
  std::vector<float> sums(3 * B * B * points.size(), -12345.0f);
  projectBatch<B>(prepared, prepared.all(), points.rows(), footprints, sums);
  return sums;
}

/// Point k of `count`.
template <int B>
RadianceSH<B> shAt(std::span<const float> sums, std::size_t count, std::size_t k) {
  RadianceSH<B> sh;
  for (int i = 0; i < 3 * B * B; ++i) sh.data()[i] = sums[static_cast<std::size_t>(i) * count + k];
  return sh;
}

}  // namespace rigel::test
