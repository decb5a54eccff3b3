// The body is a loft along z: at each station a ring runs from the middle of the floor over sill, belt line and roof
// edge to the middle of the roof and back on the other side. On bonnet and boot the rows between belt line and roof
// edge lie flat, in the cabin they stand up as windows; glass and lamps are ranges of stations and rows.
#include "samples/car_mesh.h"

#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace rigel::tools {
namespace {

constexpr float kCrease = glm::radians(38.0f);
constexpr float kArchRadius = 0.395f;
constexpr float kAxleFront = 1.38f, kAxleRear = -1.32f;
constexpr float kTrack = 0.785f;  // wheel centre to the car's middle
constexpr float kTyreWidth = 0.21f;
constexpr float kNose = 0.22f;        // length over which both ends round off
constexpr float kTrimDepth = 0.015f;  // by which bumpers and plates stand out at both ends
constexpr float kNoseHeight = 0.56f;

/// Curve through (z, value) points: cubic Hermite, slopes limited so that it does not overshoot (Fritsch and Carlson).
float curve(std::span<const glm::vec2> points, float z) {
  const std::size_t last = points.size() - 1;
  if (z <= points[0].x) return points[0].y;
  if (z >= points[last].x) return points[last].y;
  std::size_t i = 0;
  while (z > points[i + 1].x) ++i;
  const auto secant = [&](std::size_t k) { return (points[k + 1].y - points[k].y) / (points[k + 1].x - points[k].x); };
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k == last) return secant(k == 0 ? 0 : last - 1);
    const float a = secant(k - 1), b = secant(k);
    return a * b <= 0 ? 0 : 2 * a * b / (a + b);
  };
  const float h = points[i + 1].x - points[i].x, t = (z - points[i].x) / h;
  const float u = 1 - t;
  return u * u * (1 + 2 * t) * points[i].y + t * t * (3 - 2 * t) * points[i + 1].y +
         h * t * u * (u * slope(i) - t * slope(i + 1));
}

constexpr glm::vec2 kRoof[] = {{-2.25f, 0.86f}, {-2.0f, 0.985f}, {-1.72f, 1.03f}, {-1.5f, 1.09f}, {-1.1f, 1.31f},
                               {-0.7f, 1.45f},  {-0.25f, 1.5f},  {0.1f, 1.48f},   {0.38f, 1.4f},  {0.8f, 1.17f},
                               {1.08f, 1.01f},  {1.3f, 0.955f},  {1.7f, 0.89f},   {2.05f, 0.79f}, {2.25f, 0.68f}};
constexpr glm::vec2 kBelt[] = {{-2.25f, 0.80f}, {-1.9f, 0.915f}, {-1.3f, 0.95f}, {0.2f, 0.915f},
                               {1.1f, 0.89f},   {1.7f, 0.82f},   {2.25f, 0.62f}};
constexpr glm::vec2 kHalfWidth[] = {{-2.25f, 0.76f}, {-1.95f, 0.85f}, {-1.3f, 0.9f}, {1.3f, 0.9f},
                                    {1.85f, 0.86f},  {2.1f, 0.78f},   {2.25f, 0.7f}};
constexpr glm::vec2 kRoofEdge[] = {{-2.25f, 0.6f}, {-1.72f, 0.68f}, {-1.1f, 0.6f}, {-0.4f, 0.6f},
                                   {0.3f, 0.585f}, {1.08f, 0.7f},   {1.7f, 0.66f}, {2.25f, 0.5f}};
constexpr glm::vec2 kFloor[] = {{-2.25f, 0.3f}, {-1.8f, 0.24f}, {-1.0f, 0.2f},
                                {1.0f, 0.2f},   {1.9f, 0.22f},  {2.25f, 0.28f}};

/// Lowest point of the bodywork: the floor, raised by the wheel arches.
float sill(float z) {
  const float floor = curve(kFloor, z);
  for (const float axle : {kAxleFront, kAxleRear}) {
    const float reach = kArchRadius * kArchRadius - (z - axle) * (z - axle);
    if (reach > 0) return std::max(floor, kWheelRadius + std::sqrt(reach));
  }
  return floor;
}

// Rows of the half ring, from the middle of the floor to the middle of the roof.
constexpr int kFloorRows = 4, kSideRows = 9, kWindowRows = 5, kRoofRows = 5;
constexpr int kBeltRow = kFloorRows + kSideRows, kRoofEdgeRow = kBeltRow + kWindowRows;
constexpr int kHalfRows = kRoofEdgeRow + kRoofRows;

/// Half width of the body side at a height, as a share of the way from the floor to the belt line: tucked in below,
/// fullest a third of the way up, leaning in towards the belt line.
float sideHalfWidth(float half, float share) {
  const float bulge = std::sin(glm::pi<float>() * std::pow(share, 0.6f));
  return glm::mix(half - 0.055f, half - 0.075f, share) + 0.062f * bulge - 0.045f * std::pow(1 - share, 8.0f);
}

glm::vec2 halfRing(float z, int row) {
  const float low = sill(z), belt = curve(kBelt, z), half = curve(kHalfWidth, z), top = curve(kRoof, z);
  if (row <= kBeltRow) {
    // Of the height, not of the row: the arches then cut into the side without bending it.
    const float floor = curve(kFloor, z);
    const float y = glm::mix(low, belt, std::max(0.0f, static_cast<float>(row - kFloorRows) / kSideRows));
    const float x = sideHalfWidth(half, (y - floor) / (belt - floor));
    return {row < kFloorRows ? x * static_cast<float>(row) / kFloorRows : x, y};
  }
  const glm::vec2 shoulder{half - 0.075f, belt};
  const glm::vec2 edge{std::min(curve(kRoofEdge, z), shoulder.x - 0.05f), top - 0.055f};
  if (row <= kRoofEdgeRow) {
    const float t = static_cast<float>(row - kBeltRow) / kWindowRows;
    const glm::vec2 d = edge - shoulder;
    // Slightly barrelled panes: outwards, square to the chord.
    return shoulder + t * d + 0.05f * t * (1 - t) * 4.0f * glm::vec2(d.y, -d.x);
  }
  const float angle = glm::half_pi<float>() * static_cast<float>(row - kRoofEdgeRow) / kRoofRows;
  return {edge.x * std::cos(angle), glm::mix(edge.y, top, std::sin(angle))};
}

struct Station {
  float z = 0;      // where the ring is taken
  float shift = 0;  // and how far it is moved and
  float scale = 1;  // shrunk about the nose, so that both ends round off
};

std::vector<Station> stations() {
  const float front = kCarLength / 2 - kTrimDepth - kNose, rear = -front;
  std::vector<float> zs;
  for (int i = 0; i <= 40; ++i) zs.push_back(glm::mix(rear, front, static_cast<float>(i) / 40));
  for (const float axle : {kAxleFront, kAxleRear}) {
    std::erase_if(zs, [&](float z) { return std::abs(z - axle) < kArchRadius + 0.03f; });
    constexpr int kArchSteps = 20;
    for (int i = 0; i <= kArchSteps; ++i) {
      zs.push_back(axle - kArchRadius * std::cos(glm::pi<float>() * static_cast<float>(i) / kArchSteps));
    }
    for (const float side : {-1.0f, 1.0f}) zs.push_back(axle + side * (kArchRadius + 0.004f));
  }
  std::sort(zs.begin(), zs.end());

  constexpr int kNoseSteps = 9;
  constexpr float kBluntness = 2.6f;  // exponent of the superellipse both ends follow
  std::vector<Station> out;
  for (const float z : zs) out.push_back({z, 0, 1});
  for (int i = 1; i <= kNoseSteps; ++i) {
    const float a = glm::half_pi<float>() * static_cast<float>(i) / kNoseSteps;
    const float along = kNose * std::pow(std::sin(a), 2 / kBluntness);
    const float scale = i == kNoseSteps ? 0.0f : std::pow(std::cos(a), 2 / kBluntness);
    out.push_back({front, along, scale});
    out.insert(out.begin(), {rear, -along, scale});
  }
  return out;
}

enum class Part { paint, glass, headlamp, tailLamp, trim };

Part partOf(float z, int row) {
  const bool pane = row >= kBeltRow && row < kRoofEdgeRow - 1;
  const bool pillar = z > -0.31f && z < -0.2f;
  if (pane && z > -1.02f && z < 0.42f && !pillar) return Part::glass;
  if (row >= kBeltRow + 2 && z > 0.5f && z < 1.1f) return Part::glass;
  if (row >= kBeltRow + 2 && z > -1.56f && z < -1.0f && row > kRoofEdgeRow - 1) return Part::glass;
  const bool lampRows = row >= kFloorRows + 5 && row < kBeltRow;
  if (lampRows && z > 2.03f && z < 2.225f) return Part::headlamp;
  if (lampRows && z < -2.03f && z > -2.225f) return Part::tailLamp;
  if (row < kFloorRows + 1 && std::abs(z) < kCarLength / 2 - kTrimDepth - kNose) return Part::trim;
  return Part::paint;
}

std::array<Primitive, 5> bodyParts() {
  const std::vector<Station> along = stations();
  const int rows = static_cast<int>(along.size()), columns = 2 * kHalfRows;
  Primitive whole;
  addGrid(whole, rows, columns, true, [&](int r, int c) {
    const Station& station = along[r];
    // Columns run up the +x side and down the -x side.
    const bool mirrored = c > kHalfRows;
    glm::vec2 p = halfRing(station.z, mirrored ? columns - c : c);
    p = glm::vec2(0, kNoseHeight) + (p - glm::vec2(0, kNoseHeight)) * station.scale;
    return glm::vec3(mirrored ? -p.x : p.x, p.y, station.z + station.shift);
  });
  // Normals first, parts after: shading runs smoothly across the borders of paint and glass.
  std::array<Primitive, 5> parts;
  std::vector<Part> partOfQuad;
  for (int r = 0; r + 1 < rows; ++r) {
    const float z = 0.5f * (along[r].z + along[r].shift + along[r + 1].z + along[r + 1].shift);
    for (int c = 0; c < columns; ++c) partOfQuad.push_back(partOf(z, c < kHalfRows ? c : columns - 1 - c));
  }
  const std::vector<std::uint32_t> kept = finishNormals(whole, kCrease);
  constexpr std::uint32_t kUnused = ~0u;
  std::array<std::vector<std::uint32_t>, 5> local;
  for (auto& indices : local) indices.assign(whole.positions.size(), kUnused);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    const auto which = static_cast<std::size_t>(partOfQuad[kept[t] / 2]);
    Primitive& part = parts[which];
    glm::uvec3 triangle;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = whole.triangles[t][k];
      if (local[which][vertex] == kUnused) {
        local[which][vertex] = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(whole.positions[vertex]);
        part.normals.push_back(whole.normals[vertex]);
      }
      triangle[k] = local[which][vertex];
    }
    part.triangles.push_back(triangle);
  }
  return parts;
}

/// Grille and bumper in front, bumper and number plate behind: slim blocks sunk into the blunt ends.
void addEndTrim(Primitive& trim, Primitive& plate) {
  const auto block = [](Primitive& out, glm::vec3 half, glm::vec3 at) {
    Primitive part;
    addRoundedBox(part, half, 0.9f * half.z, 6);
    finishNormals(part, kCrease);
    append(out, part, glm::translate(glm::mat4(1), at));
  };
  const float end = kCarLength / 2;
  block(trim, {0.33f, 0.05f, 0.03f}, {0, 0.6f, end - 0.034f});
  for (const float side : {-1.0f, 1.0f}) block(trim, {0.58f, 0.06f, 0.05f}, {0, 0.385f, side * (end - 0.052f)});
  for (const float side : {-1.0f, 1.0f}) {
    block(plate, {0.25f, 0.055f, 0.016f}, {0, side > 0 ? 0.475f : 0.6f, side * (end - 0.016f)});
  }
}

/// Wheel about the x axis, its outer face towards +x.
void addWheel(Primitive& tyre, Primitive& rim) {
  const glm::mat4 lay = glm::rotate(glm::mat4(1), -glm::half_pi<float>(), glm::vec3(0, 0, 1));  // +y to +x
  constexpr int kSegments = 36;
  const float w = kTyreWidth / 2, r = kWheelRadius;
  const glm::vec2 tyreProfile[] = {{0, -w},
                                   {0.21f, -w},
                                   {0.29f, -w},
                                   {r - 0.012f, -w + 0.02f},
                                   {r, -w + 0.055f},
                                   {r, w - 0.055f},
                                   {r - 0.012f, w - 0.02f},
                                   {0.29f, w},
                                   {0.215f, w},
                                   {0.205f, w - 0.05f},
                                   {0, w - 0.06f}};
  Primitive part;
  addLathe(part, tyreProfile, kSegments);
  finishNormals(part, kCrease);
  append(tyre, part, lay);

  Primitive metal;
  const glm::vec2 hub[] = {{0, w - 0.07f}, {0.055f, w - 0.05f}, {0.05f, w - 0.012f}, {0.03f, w - 0.002f}, {0, w}};
  addLathe(metal, hub, 16);
  const glm::vec2 ring[] = {
      {0.185f, w - 0.055f}, {0.212f, w - 0.03f}, {0.212f, w + 0.002f}, {0.2f, w + 0.004f}, {0.185f, w - 0.055f}};
  addLathe(metal, ring, kSegments);
  finishNormals(metal, kCrease);
  append(rim, metal, lay);
  Primitive spoke;
  addRoundedBox(spoke, {0.012f, 0.085f, 0.022f}, 0.009f, 4);
  finishNormals(spoke, kCrease);
  for (int i = 0; i < 5; ++i) {
    const float angle = glm::two_pi<float>() * static_cast<float>(i) / 5;
    glm::mat4 place = glm::rotate(glm::mat4(1), angle, glm::vec3(1, 0, 0));
    place = glm::translate(place, glm::vec3(w - 0.024f, 0.115f, 0));
    append(rim, spoke, place);
  }
}

}  // namespace

Car addCar(Scene& scene, glm::vec3 paint) {
  const std::array<int, 5> materials{
      addMaterial(scene, "paint", paint), addMaterial(scene, "glass", {0.06f, 0.07f, 0.08f}),
      addMaterial(scene, "headlamp", {0.85f, 0.85f, 0.8f}), addMaterial(scene, "tail lamp", {0.5f, 0.03f, 0.03f}),
      addMaterial(scene, "trim", {0.08f, 0.08f, 0.085f})};
  const int rubber = addMaterial(scene, "rubber", {0.05f, 0.05f, 0.05f});
  const int metal = addMaterial(scene, "rim", {0.62f, 0.63f, 0.65f});

  Car car;
  car.node = addNode(scene, "car", kNoParent);
  scene.nodes[car.node].isObject = true;
  std::array<Primitive, 5> parts = bodyParts();
  addEndTrim(parts[static_cast<std::size_t>(Part::trim)], parts[static_cast<std::size_t>(Part::headlamp)]);
  std::vector<Primitive> body;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].material = materials[i];
    body.push_back(std::move(parts[i]));
  }
  const int bodyNode = addNode(scene, "body", car.node);
  scene.nodes[bodyNode].mesh = addMesh(scene, "body", std::move(body));

  std::vector<Primitive> wheel(2);
  wheel[0].material = rubber;
  wheel[1].material = metal;
  addWheel(wheel[0], wheel[1]);
  const int wheelMesh = addMesh(scene, "wheel", std::move(wheel));
  const char* const names[] = {"wheel front left", "wheel front right", "wheel rear left", "wheel rear right"};
  for (int i = 0; i < 4; ++i) {
    const float side = i % 2 == 0 ? 1.0f : -1.0f;  // left is +x of a car that looks along +z
    const int holder = addNode(scene, std::string(names[i]) + " hub", car.node,
                               {side * kTrack, kWheelRadius, i < 2 ? kAxleFront : kAxleRear});
    // The mesh shows its outer face on +x: turn it round for the right-hand side.
    if (side < 0) scene.nodes[holder].rotation = glm::angleAxis(glm::pi<float>(), glm::vec3(0, 1, 0));
    car.wheels[i] = addNode(scene, names[i], holder);
    scene.nodes[car.wheels[i]].mesh = wheelMesh;
  }
  return car;
}

}  // namespace rigel::tools
