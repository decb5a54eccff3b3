#include "samples/mesh_builder.h"

#include "mesh_checks.h"

#include <gmock/gmock.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>

namespace rigel::tools {
namespace {

constexpr double kPiD = 3.14159265358979323846;

Mesh meshOf(Primitive primitive) {
  Mesh mesh;
  mesh.primitives.push_back(std::move(primitive));
  return mesh;
}

TEST(MeshBuilder, SolidsAreClosedAndHaveTheirVolume) {
  Primitive ball, box, cylinder;
  addSphere(ball, 2, 40);
  addRoundedBox(box, {1, 2, 3}, 1e-3f, 6);
  addCylinder(cylinder, 1, 3, 1e-3f, 128);
  const struct {
    const char* name;
    Primitive& primitive;
    double volume;
  } solids[] = {{"ball", ball, 4 / 3.0 * kPiD * 8}, {"box", box, 48}, {"cylinder", cylinder, 3 * kPiD}};
  for (const auto& solid : solids) {
    finishNormals(solid.primitive, glm::radians(40.0f));
    const Mesh mesh = meshOf(solid.primitive);
    EXPECT_EQ(test::openEdges(mesh), 0) << solid.name;
    EXPECT_NEAR(test::volume(mesh) / solid.volume, 1, 5e-3) << solid.name;
    EXPECT_EQ(test::agreeingShare(mesh.primitives[0]), 1) << solid.name;
  }
}

TEST(MeshChecks, SeeHolesAndInsideOut) {
  Primitive floor, ball;
  addFloor(floor, {-1, -1}, {1, 1}, 0);
  EXPECT_EQ(test::openEdges(meshOf(floor)), 4);
  addSphere(ball, 1, 12);
  finishNormals(ball, glm::pi<float>());
  for (glm::uvec3& t : ball.triangles) std::swap(t.x, t.y);
  EXPECT_EQ(test::openEdges(meshOf(ball)), 0);
  EXPECT_LT(test::volume(meshOf(ball)), -4);
  EXPECT_EQ(test::agreeingShare(ball), 0);
  ball.triangles.pop_back();
  EXPECT_EQ(test::openEdges(meshOf(ball)), 3);
}

TEST(MeshBuilder, RoundedCubeOfFullRadiusIsABall) {
  Primitive ball;
  addRoundedBox(ball, glm::vec3(0.7f), 0.7f, 12);
  finishNormals(ball, glm::pi<float>());
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(ball.positions[i]), 0.7f, 1e-6f);
    EXPECT_GT(glm::dot(ball.normals[i], ball.positions[i] / 0.7f), 0.995f);
  }
}

TEST(FinishNormals, CreaseDecidesBetweenSharpAndSmooth) {
  const auto cube = [] {
    Primitive p;
    addRoundedBox(p, glm::vec3(1), 0, 1);
    return p;
  };
  Primitive sharp = cube(), smooth = cube();
  finishNormals(sharp, glm::radians(30.0f));
  finishNormals(smooth, glm::pi<float>());
  EXPECT_EQ(sharp.positions.size(), 24u) << "three normals a corner";
  EXPECT_EQ(smooth.positions.size(), 8u) << "one normal a corner";
  for (const glm::vec3 n : sharp.normals)
    EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6f);
  // Weighted by angle, a cube's corner points along its diagonal however its faces are cut.
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LT(glm::distance(smooth.normals[i], glm::normalize(smooth.positions[i])), 1e-6f);
  }
}

TEST(FinishNormals, DropsDegenerateTrianglesAndSaysWhichItKept) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  p.triangles = {{0, 1, 3}, {0, 1, 2}, {1, 1, 2}, {3, 1, 2}};
  const std::vector<std::uint32_t> kept = finishNormals(p, 1);
  EXPECT_THAT(kept, ::testing::ElementsAre(1u, 3u));
  EXPECT_EQ(p.triangles.size(), 2u);
  EXPECT_EQ(p.positions.size(), 3u);
}

TEST(Append, TransformsPositionsAndTurnsNormals) {
  Primitive part, whole;
  addFloor(part, {-1, -1}, {1, 1}, 0);
  finishNormals(part, 0);
  ASSERT_EQ(part.normals.at(0), glm::vec3(0, 1, 0));
  glm::mat4 m = glm::translate(glm::mat4(1), glm::vec3(5, 0, 0));
  m = glm::rotate(m, -glm::half_pi<float>(), glm::vec3(0, 0, 1));
  m = glm::scale(m, glm::vec3(2));
  append(whole, part, glm::mat4(1));
  append(whole, part, m);
  ASSERT_EQ(whole.positions.size(), 8u);
  EXPECT_EQ(whole.triangles.back(), part.triangles.back() + 4u);
  for (std::size_t i = 4; i < 8; ++i) {
    EXPECT_LT(glm::distance(whole.normals[i], glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_NEAR(whole.positions[i].x, 5, 1e-6f);
  }
}

TEST(SmoothNormals, OfAScaledBallFollowTheSurface) {
  Primitive ball;
  addSphere(ball, 1, 48);
  finishNormals(ball, glm::pi<float>());
  std::vector<glm::vec3> stretched;
  for (const glm::vec3 p : ball.positions) stretched.push_back(p * glm::vec3(1, 2, 1));
  const std::vector<glm::vec3> normals = smoothNormals(stretched, ball.triangles);
  float worst = 1;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::vec3 exact = glm::normalize(ball.positions[i] / glm::vec3(1, 2, 1));
    worst = std::min(worst, glm::dot(exact, normals[i]));
  }
  EXPECT_GT(worst, 0.998f);  // worst seen: 0.9989, next to the poles
}

}  // namespace
}  // namespace rigel::tools
