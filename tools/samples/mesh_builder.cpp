#include "samples/mesh_builder.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>

namespace rigel::tools {
namespace {

constexpr float kTwoPi = glm::two_pi<float>();

/// Angle of the corner at `a`; the weight that makes a vertex normal independent of how a face is cut into triangles.
float cornerAngle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const glm::vec3 u = b - a, v = c - a;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

/// Exact position as a key; -0 and 0 are the same place.
struct PositionKey {
  std::array<std::uint32_t, 3> bits;
  explicit PositionKey(glm::vec3 p)
      : bits{std::bit_cast<std::uint32_t>(p.x + 0.0f), std::bit_cast<std::uint32_t>(p.y + 0.0f),
             std::bit_cast<std::uint32_t>(p.z + 0.0f)} {}
  bool operator==(const PositionKey&) const = default;
};

struct PositionHash {
  std::size_t operator()(const PositionKey& k) const noexcept {
    return (k.bits[0] * 73856093u) ^ (k.bits[1] * 19349663u) ^ (k.bits[2] * 83492791u);
  }
};

/// Replaces vertices at the same place by the first of them and drops triangles that thereby lose a corner; returns
/// the former indices of the others.
std::vector<std::uint32_t> weld(Primitive& mesh) {
  std::unordered_map<PositionKey, std::uint32_t, PositionHash> first;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> target(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto [it, isNew] =
        first.try_emplace(PositionKey(mesh.positions[i]), static_cast<std::uint32_t>(positions.size()));
    if (isNew) positions.push_back(mesh.positions[i]);
    target[i] = it->second;
  }
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t{target[mesh.triangles[i].x], target[mesh.triangles[i].y], target[mesh.triangles[i].z]};
    if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
    triangles.push_back(t);
    kept.push_back(static_cast<std::uint32_t>(i));
  }
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return kept;
}

}  // namespace

void addGrid(Primitive& out, int rows, int columns, bool closed, const std::function<glm::vec3(int, int)>& point) {
  const auto base = static_cast<std::uint32_t>(out.positions.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) out.positions.push_back(point(r, c));
  const auto at = [&](int r, int c) { return base + static_cast<std::uint32_t>(r * columns + c % columns); };
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c < (closed ? columns : columns - 1); ++c) {
      const std::uint32_t a = at(r, c), b = at(r, c + 1), d = at(r + 1, c), e = at(r + 1, c + 1);
      out.triangles.push_back({a, b, e});
      out.triangles.push_back({a, e, d});
    }
  }
}

void addLathe(Primitive& out, std::span<const glm::vec2> profile, int segments) {
  addGrid(out, static_cast<int>(profile.size()), segments, true, [&](int r, int c) {
    const float angle = kTwoPi * static_cast<float>(c) / static_cast<float>(segments);
    const glm::vec2 p = profile[static_cast<std::size_t>(r)];
    // Clockwise seen from +y, so that d/dcolumn x d/drow points away from the axis.
    return glm::vec3(p.x * std::cos(angle), p.y, -p.x * std::sin(angle));
  });
}

void addCylinder(Primitive& out, float radius, float height, float bevel, int segments) {
  constexpr int kBevelSteps = 3;
  std::vector<glm::vec2> profile{{0, 0}};
  for (int i = 0; i <= kBevelSteps; ++i) {
    const float a = glm::half_pi<float>() * static_cast<float>(i) / kBevelSteps;
    profile.push_back({radius - bevel + bevel * std::sin(a), bevel - bevel * std::cos(a)});
  }
  for (int i = 0; i <= kBevelSteps; ++i) {
    const float a = glm::half_pi<float>() * static_cast<float>(i) / kBevelSteps;
    profile.push_back({radius - bevel + bevel * std::cos(a), height - bevel + bevel * std::sin(a)});
  }
  profile.push_back({0, height});
  addLathe(out, profile, segments);
}

void addSphere(Primitive& out, float radius, int segments) {
  std::vector<glm::vec2> profile;
  for (int i = 0; i <= segments; ++i) {
    const float a = glm::pi<float>() * static_cast<float>(i) / static_cast<float>(segments);
    // Exactly 0 at the poles, so that they weld to one vertex.
    const float ring = i == 0 || i == segments ? 0.0f : std::sin(a);
    profile.push_back({radius * ring, -radius * std::cos(a)});
  }
  addLathe(out, profile, 2 * segments);
}

void addRoundedBox(Primitive& out, glm::vec3 half, float radius, int steps) {
  const glm::vec3 core = glm::max(half - radius, glm::vec3(0));
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const float side = face % 2 == 0 ? 1.0f : -1.0f;
    addGrid(out, steps + 1, steps + 1, false, [&](int r, int c) {
      // Equal angles rather than equal lengths: even triangles on the rounded part.
      const auto warp = [&](int i) {
        const int fromMiddle = 2 * i - steps;  // exactly odd, and exactly 1 at the rim, so that neighbouring faces weld
        if (std::abs(fromMiddle) == steps) return fromMiddle > 0 ? 1.0f : -1.0f;
        return std::tan(glm::quarter_pi<float>() * static_cast<float>(fromMiddle) / static_cast<float>(steps));
      };
      glm::vec3 cube;
      cube[axis] = side;
      cube[(axis + 1) % 3] = warp(c) * side;
      cube[(axis + 2) % 3] = warp(r);
      const glm::vec3 onBox = cube * half;
      const glm::vec3 inner = glm::clamp(onBox, -core, core);
      const glm::vec3 away = onBox - inner;
      return inner + radius * away / std::max(glm::length(away), 1e-20f);
    });
  }
}

void addFloor(Primitive& out, glm::vec2 minXz, glm::vec2 maxXz, float height) {
  addGrid(out, 2, 2, false,
          [&](int r, int c) { return glm::vec3(r == 0 ? minXz.x : maxXz.x, height, c == 0 ? minXz.y : maxXz.y); });
}

void append(Primitive& out, const Primitive& part, const glm::mat4& transform) {
  const auto base = static_cast<std::uint32_t>(out.positions.size());
  for (const glm::vec3 p : part.positions) out.positions.push_back(glm::vec3(transform * glm::vec4(p, 1)));
  for (const glm::vec3 n : part.normals) {
    out.normals.push_back(glm::normalize(glm::vec3(transform * glm::vec4(n, 0))));
  }
  for (const glm::uvec3 t : part.triangles) out.triangles.push_back(t + base);
  out.influences.insert(out.influences.end(), part.influences.begin(), part.influences.end());
}

std::vector<std::uint32_t> finishNormals(Primitive& mesh, float creaseAngle) {
  std::vector<std::uint32_t> kept = weld(mesh);
  const std::size_t triangleCount = mesh.triangles.size();
  std::vector<glm::vec3> faceNormal(triangleCount);
  std::vector<std::vector<std::uint32_t>> around(mesh.positions.size());
  for (std::size_t t = 0; t < triangleCount; ++t) {
    const glm::uvec3 tri = mesh.triangles[t];
    const glm::vec3 n =
        glm::cross(mesh.positions[tri.y] - mesh.positions[tri.x], mesh.positions[tri.z] - mesh.positions[tri.x]);
    faceNormal[t] = n / std::max(glm::length(n), 1e-30f);
    for (int k = 0; k < 3; ++k) around[tri[k]].push_back(static_cast<std::uint32_t>(t));
  }

  std::vector<glm::vec3> positions, normals;
  std::map<std::pair<std::uint32_t, std::array<int, 3>>, std::uint32_t> split;
  const float cosCrease = std::cos(creaseAngle);
  std::vector<glm::uvec3> triangles(triangleCount);
  for (std::size_t t = 0; t < triangleCount; ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[t][k];
      glm::vec3 sum{0};
      for (const std::uint32_t other : around[vertex]) {
        if (glm::dot(faceNormal[t], faceNormal[other]) < cosCrease) continue;
        const glm::uvec3 o = mesh.triangles[other];
        const int corner = o.x == vertex ? 0 : o.y == vertex ? 1 : 2;
        sum += faceNormal[other] * cornerAngle(mesh.positions[o[corner]], mesh.positions[o[(corner + 1) % 3]],
                                               mesh.positions[o[(corner + 2) % 3]]);
      }
      const float size = glm::length(sum);
      const glm::vec3 n = size > 0 ? sum / size : glm::vec3(0, 1, 0);
      // Corners that gathered the same faces agree to rounding; a thousandth tells real splits apart.
      const std::array<int, 3> rounded{static_cast<int>(std::lround(n.x * 1000)),
                                       static_cast<int>(std::lround(n.y * 1000)),
                                       static_cast<int>(std::lround(n.z * 1000))};
      const auto [it, isNew] = split.try_emplace({vertex, rounded}, static_cast<std::uint32_t>(positions.size()));
      if (isNew) {
        positions.push_back(mesh.positions[vertex]);
        normals.push_back(n);
      }
      triangles[t][k] = it->second;
    }
  }
  mesh.positions = std::move(positions);
  mesh.normals = std::move(normals);
  mesh.triangles = std::move(triangles);
  return kept;
}

std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0));
  for (const glm::uvec3 t : triangles) {
    const glm::vec3 n = glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    const glm::vec3 unit = n / std::max(glm::length(n), 1e-30f);
    for (int k = 0; k < 3; ++k) {
      normals[t[k]] += unit * cornerAngle(positions[t[k]], positions[t[(k + 1) % 3]], positions[t[(k + 2) % 3]]);
    }
  }
  for (glm::vec3& n : normals) n = n / std::max(glm::length(n), 1e-30f);
  return normals;
}

}  // namespace rigel::tools
