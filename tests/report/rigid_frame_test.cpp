// The rig frame of any node is rigid: orthonormal, right-handed, and it follows the node.
#include "report/measure/surface_set.h"

#include <rigel/glm.h>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel::tests {
namespace {

using tools::rigidFrame;

// Columns are rounded to float: 6e-8 each. Worst measured 7.4e-8.
constexpr double kRigid = 4e-7;

glm::dmat3 columns(const RigFrame& f) { return {glm::dvec3(toGlm(f.x)), toGlm(f.y), toGlm(f.z)}; }

/// The largest entry of RtR - 1, and of det R - 1.
double distanceFromRotation(const RigFrame& frame) {
  const glm::dmat3 r = columns(frame);
  const glm::dmat3 product = glm::transpose(r) * r;
  double worst = std::abs(glm::determinant(r) - 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(product[i][j] - (i == j ? 1 : 0)));
  return worst;
}

glm::mat4 turned() { return glm::rotate(glm::mat4(1), 1.1f, glm::normalize(glm::vec3(1, 2, -0.5f))); }

glm::mat4 sheared(float xy, float xz, float yz) {
  glm::mat4 m(1);
  m[1][0] = xy;
  m[2][0] = xz;
  m[2][1] = yz;
  return m;
}

TEST(RigidFrame, IsARotationForEveryNode) {
  std::vector<glm::mat4> nodes;
  const float sizes[] = {0, 1, -1, 1e-6f, 3e5f, -1e-18f, 1e-30f};
  for (const float x : sizes)
    for (const float y : sizes)
      for (const float z : sizes) nodes.push_back(turned() * glm::scale(glm::mat4(1), {x, y, z}));
  for (const float shear : {0.3f, -2.0f, 100.0f, 1e6f})
    for (const glm::mat4& m : {sheared(shear, 0, 0), sheared(0, shear, shear), sheared(shear, -shear, shear)})
      nodes.insert(nodes.end(), {m, turned() * m, m * turned(), -1.0f * (turned() * m)});
  glm::mat4 flat(1);
  flat[1] = flat[0];  // two columns alike, then all three
  nodes.push_back(flat);
  flat[2] = flat[0];
  nodes.push_back(flat);
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    nodes.push_back(glm::mat4(1));
    nodes.back()[1][2] = bad;
    nodes.push_back(glm::mat4(bad));
  }
  double worst = 0;
  for (const glm::mat4& node : nodes) {
    const double distance = distanceFromRotation(rigidFrame(node));
    ASSERT_LT(distance, kRigid) << "node " << &node - nodes.data();
    worst = std::max(worst, distance);
  }
  RecordProperty("worst", testing::PrintToString(worst));
}

TEST(RigidFrame, IsTheNodesOwnWhereThatIsRigid) {
  glm::mat4 node = turned();
  node[3] = {4, 5, 6, 1};
  const RigFrame frame = rigidFrame(node);
  for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(columns(frame)[i] - glm::dvec3(node[i])), kRigid) << i;
  EXPECT_EQ(frame.origin, (Vec3{4, 5, 6}));
}

TEST(RigidFrame, AMirroredNodeKeepsItsXAndY) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 scale(2);
    scale[axis] = -2;
    const glm::mat4 node = turned() * glm::scale(glm::mat4(1), scale);
    const glm::dmat3 r = columns(rigidFrame(node));
    EXPECT_LT(glm::length(r[0] - glm::dvec3(node[0]) / 2.0), kRigid) << axis;
    EXPECT_LT(glm::length(r[1] - glm::dvec3(node[1]) / 2.0), kRigid) << axis;
    EXPECT_LT(glm::length(r[2] + glm::dvec3(node[2]) / 2.0), kRigid) << axis;
  }
}

TEST(RigidFrame, AFlattenedNodeStillTurns) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 scale(1);
    scale[axis] = 0;
    const glm::dmat3 r = columns(rigidFrame(turned() * glm::scale(glm::mat4(1), scale)));
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(r[i] - glm::dvec3(turned()[i])), kRigid) << axis << i;
  }
}

}  // namespace
}  // namespace rigel::tests
