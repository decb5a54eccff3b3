// The 3-D view's data: what a reader unpacks is what was recorded, and all of it keeps to its budget.
#include "report/formats/deflate.h"
#include "report/formats/report_html.h"
#include "report/formats/report_json.h"
#include "report/view3d/view3d_json.h"
#include "report/view3d/view3d_lights.h"
#include "report/view3d/view3d_mesh.h"
#include "report/view3d/view3d_pack.h"
#include "report/view3d/view3d_plan.h"
#include "report_fixture.h"
#include "view_fixture.h"

#include <gmock/gmock.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numeric>
#include <random>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using Bytes = std::vector<std::uint8_t>;

Bytes inflated(const Bytes& packed) {
  Bytes out(4'000'000);
  uLongf size = static_cast<uLongf>(out.size());
  EXPECT_EQ(uncompress(out.data(), &size, packed.data(), static_cast<uLong>(packed.size())), Z_OK);
  out.resize(size);
  return out;
}

Bytes fromBase64(const std::string& text) {
  Bytes out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const auto place = std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    if (place == std::string_view::npos) break;
    bits = bits << 6 | static_cast<std::uint32_t>(place);
    if ((count += 6) < 8) continue;
    out.push_back(static_cast<std::uint8_t>(bits >> (count -= 8)));
  }
  return out;
}

/// What the page does with rows, written by the description of RowPacker.
class Reader {
 public:
  explicit Reader(Bytes bytes) : bytes_(std::move(bytes)) {}
  template <class T>
  std::vector<T> row(std::size_t count, const std::vector<T>& before) {
    const bool across = bytes_.at(next_++) == 1;
    std::vector<T> out(count, 0);
    for (std::size_t byte = 0; byte < sizeof(T); ++byte)
      for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<T>(out[i] | bytes_.at(next_++) << (8 * byte));
    for (std::size_t i = 0; i < count; ++i)
      out[i] = static_cast<T>(out[i] + (across ? before.at(i) : i > 0 ? out[i - 1] : 0));
    return out;
  }
  bool atEnd() const { return next_ == bytes_.size(); }

 private:
  Bytes bytes_;
  std::size_t next_ = 0;
};

TEST(View3d, DeflateComesBack) {
  std::mt19937 random(1);
  for (const std::size_t size : {0u, 1u, 2u, 3u, 1000u, 70'000u}) {
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(inflated(deflated(bytes)), bytes) << size;
    EXPECT_EQ(inflated(fromBase64(packedText(bytes))), bytes) << size;
    EXPECT_LE(deflated(bytes).size(), size + size / 1000 + 32);
  }
}

template <class T>
void expectRowsComeBack() {
  std::mt19937 random(2);
  const std::size_t widths[] = {0, 1, 5, 300};
  for (const std::size_t width : widths) {
    RowPacker packer;
    std::vector<std::vector<T>> rows;
    for (int i = 0; i < 6; ++i) {
      std::vector<T>& row = rows.emplace_back(width);
      // Noise, what stays as it was, and what moves by one: both kinds of differences.
      for (std::size_t k = 0; k < width; ++k)
        row[k] = static_cast<T>(i % 3 == 0 ? random() : rows[rows.size() - 2][k] + (i % 3 - 1));
      packer.add(std::span<const T>(row), i == 0 ? std::span<const T>() : std::span<const T>(rows[rows.size() - 2]));
    }
    EXPECT_EQ(packer.bytes().size(), rows.size() * (1 + width * sizeof(T)));
    Reader reader(packer.bytes());
    std::vector<T> before;
    for (const auto& row : rows) EXPECT_EQ(before = reader.row(width, before), row);
  }
}

TEST(View3d, RowsComeBack) {
  expectRowsComeBack<std::uint8_t>();
  expectRowsComeBack<std::uint16_t>();
}

TEST(View3d, NumbersArePackedToTheirSteps) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (int i = -1000; i <= 1000; ++i) {
    const float x = static_cast<float>(i) / 400;  // of 2: over the ends too
    EXPECT_NEAR(-2 + 4.0 * quantised(x, -2, 4) / 65535, std::clamp(x, -2.0f, 2.0f), 4 * 0.51 / 65535);
    const double held = std::clamp(static_cast<double>(x) / 2, -1.0, 1.0);
    const int e = static_cast<std::int8_t>(packedSigned(x, 2));
    EXPECT_NEAR(e, std::copysign(127 * std::sqrt(std::abs(held)), held), 0.501);
    EXPECT_NEAR(packedMagnitude(x, 2), 255 * std::sqrt(std::max(held, 0.0)), 0.501);
  }
  EXPECT_EQ(packedSigned(kNaN, 1), 0);
  EXPECT_EQ(packedMagnitude(kNaN, 1), 0);
  EXPECT_EQ(quantised(kNaN, 0, 1), 0);
  EXPECT_EQ(packedSigned(-5, 2), 129);
}

TEST(View3d, AViewComesBack) {
  constexpr std::size_t kFrames = 4, kRigs = 3, kLights = 6;
  const ObjectView view = madeUpView(kFrames, kRigs, kLights);
  const nlohmann::json json = nlohmann::json::parse(packedView(view, 1'000'000));
  const std::size_t vertices = view.frames[0].positions.size();
  EXPECT_EQ(json["frames"], nlohmann::json({0, 1, 2, 3}));
  EXPECT_EQ(json["vertices"], vertices);
  EXPECT_EQ(json["triangles"], view.triangles.size());
  EXPECT_EQ(json["lights"], kLights);
  EXPECT_EQ(json["rigid"], false) << "it breathes";
  EXPECT_FLOAT_EQ(json["poses"][1][11], 0.5f);

  Reader reader(inflated(fromBase64(json["data"])));
  const auto indices = reader.row<std::uint16_t>(3 * view.triangles.size(), {});
  for (std::size_t i = 0; i < indices.size(); ++i) ASSERT_EQ(indices[i], view.triangles[i / 3][i % 3]);
  const auto expectPlaces = [&](int axis, const std::vector<std::uint16_t>& row, const std::vector<Vec3>& expected) {
    const float lo = json["lo"][axis], size = json["size"][axis];
    for (std::size_t i = 0; i < row.size(); ++i)
      ASSERT_NEAR(lo + size * static_cast<float>(row[i]) / 65535, expected[i][axis], 1e-5 * size + 1e-6);
  };
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint16_t> row;
    for (const ObjectViewFrame& frame : view.frames)
      expectPlaces(axis, row = reader.row(vertices, row), frame.positions);
  }
  // Green first; the other two are differences from it.
  const auto expectColours = [&](const auto& coloursOf, const auto& pack) {
    std::vector<Bytes> green(kFrames);
    for (const int channel : {1, 0, 2}) {
      Bytes before;
      for (std::size_t f = 0; f < kFrames; ++f) {
        before = reader.row(vertices, before);
        Bytes values = before;
        if (channel == 1) green[f] = before;
        for (std::size_t i = 0; i < vertices; ++i) {
          if (channel != 1) values[i] = static_cast<std::uint8_t>(values[i] + green[f][i]);
          ASSERT_EQ(values[i], pack(coloursOf(view.frames[f])[i][channel])) << channel << " " << f << " " << i;
        }
      }
    }
  };
  // The largest as it is, not as the six digits in the document.
  float most = 0;
  for (const auto& frame : view.frames)
    for (const Rgb& e : frame.truth) most = std::max({most, e.r, e.g, e.b});
  EXPECT_NEAR(json["truth_max"], most, 1e-5 * most);
  expectColours(
      [](const auto& frame) -> const auto& { return frame.truth; }, [&](float x) { return packedMagnitude(x, most); });
  for (std::size_t r = 0; r < kRigs; ++r) {
    float worst = 0;
    for (const auto& frame : view.frames)
      for (const Rgb& e : frame.rigs[r].error) worst = std::max({worst, std::abs(e.r), std::abs(e.g), std::abs(e.b)});
    EXPECT_NEAR(json["rigs"][r]["error_max"], worst, 1e-5 * worst);
    expectColours(
        [&](const auto& frame) -> const auto& { return frame.rigs[r].error; },
        [&](float x) { return packedSigned(x, worst); });
    Bytes lights;
    for (const auto& frame : view.frames) EXPECT_EQ(lights = reader.row(kLights, lights), frame.rigs[r].lights);
    EXPECT_EQ(json["rigs"][r]["samples"], r + 1);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::uint16_t> row;
      for (const auto& frame : view.frames) expectPlaces(axis, row = reader.row(r + 1, row), frame.rigs[r].samples);
    }
  }
  EXPECT_TRUE(reader.atEnd());
}

TEST(View3d, WhatKeepsItsShapeIsWrittenOnce) {
  ObjectView view = madeUpView(3, 1, 0);
  for (auto& frame : view.frames) frame.positions = view.frames[0].positions;
  const nlohmann::json rigid = nlohmann::json::parse(packedView(view, 1'000'000));
  EXPECT_EQ(rigid["rigid"], true);
  view.frames[2].positions[5].x += 0.01f;
  EXPECT_EQ(nlohmann::json::parse(packedView(view, 1'000'000))["rigid"], false);
}

TEST(View3d, AViewThatIsTooLargeLosesFrames) {
  const ObjectView view = madeUpView(12, 4, 4);
  const std::size_t all = packedView(view, 1'000'000).size(), one = packedView(madeUpView(1, 4, 4), 1'000'000).size();
  std::size_t last = 12;
  for (std::size_t bytes = all; bytes >= one; bytes -= std::max<std::size_t>(1, (all - one) / 8)) {
    const std::string text = packedView(view, bytes);
    if (text.empty()) break;
    EXPECT_LE(text.size(), bytes);
    const std::size_t frames = nlohmann::json::parse(text)["frames"].size();
    EXPECT_LE(frames, last);
    last = frames;
  }
  EXPECT_LE(last, 4u);
  EXPECT_EQ(packedView(view, 100), "");
}

TEST(View3d, NumbersThatAreNotFiniteLeaveValidJson) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    ObjectView view = madeUpView(2, 2, 2);
    view.frames[1].positions[3].y = value;
    view.frames[0].truth[4].g = value;
    view.frames[0].rigs[1].error[7].r = value;
    view.frames[1].rigs[0].box.hi.x = value;
    view.frames[1].rigs[1].samples[0].z = value;
    view.frames[1].worldFromLocal.origin.x = value;
    EXPECT_TRUE(nlohmann::json::accept(packedView(view, 1'000'000)));
  }
}

/// A grid of n x n quads with smooth normals, or none.
struct Sheet {
  SceneObject object;
  PosedObject rest;

  Sheet(int n, bool smooth) {
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const float u = static_cast<float>(x) / static_cast<float>(n),
                    v = static_cast<float>(y) / static_cast<float>(n);
        rest.positions.push_back({u, 0.2f * std::sin(6 * u) * std::sin(6 * v), v});
        rest.normals.push_back(smooth ? glm::vec3(0, 1, 0) : glm::vec3(0));
      }
    const auto at = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        object.triangles.push_back({at(x, y), at(x, y + 1), at(x + 1, y)});
        object.triangles.push_back({at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)});
      }
    object.triangleWrap.assign(object.triangles.size(), 0);
    object.vertexCount = static_cast<int>(rest.positions.size());
  }
};

TEST(View3d, ASmallMeshIsTheObjectItself) {
  const Sheet sheet(8, true);
  const ViewMesh mesh = viewMesh(sheet.object, sheet.rest, 100);
  EXPECT_EQ(mesh.vertices.size(), 81u);
  ASSERT_EQ(mesh.triangles.size(), 128u);
  for (std::size_t t = 0; t < 128; ++t)
    for (int c = 0; c < 3; ++c) {
      const Vec3 p = surfacePosition(sheet.object, sheet.rest, mesh.vertices[mesh.triangles[t][c]]);
      const auto& corners = sheet.object.triangles[t];
      const bool among = (p == Vec3{sheet.rest.positions[corners.x].x, sheet.rest.positions[corners.x].y,
                                    sheet.rest.positions[corners.x].z}) ||
                         (p == Vec3{sheet.rest.positions[corners.y].x, sheet.rest.positions[corners.y].y,
                                    sheet.rest.positions[corners.y].z}) ||
                         (p == Vec3{sheet.rest.positions[corners.z].x, sheet.rest.positions[corners.z].y,
                                    sheet.rest.positions[corners.z].z});
      EXPECT_TRUE(among) << t;
    }
  // Flat triangles share no vertex with neighbours that face elsewhere: their edges stay.
  EXPECT_GT(viewMesh(Sheet(8, false).object, Sheet(8, false).rest, 1000).vertices.size(), 128u);
}

TEST(View3d, ALargeMeshKeepsToItsBudgetAndItsShape) {
  for (const bool smooth : {true, false}) {
    const Sheet sheet(60, smooth);
    for (const std::size_t most : {1u, 7u, 100u, 1500u}) {
      const ViewMesh mesh = viewMesh(sheet.object, sheet.rest, most);
      EXPECT_LE(mesh.vertices.size(), most);
      if (most >= 100) {
        EXPECT_GT(mesh.vertices.size(), 2 * most / 3);
      }
      double area = 0;
      for (const auto& triangle : mesh.triangles) {
        glm::dvec3 p[3];
        for (int c = 0; c < 3; ++c) {
          ASSERT_LT(triangle[c], mesh.vertices.size());
          const Vec3 v = surfacePosition(sheet.object, sheet.rest, mesh.vertices[triangle[c]]);
          p[c] = {v.x, v.y, v.z};
        }
        area += 0.5 * glm::cross(p[1] - p[0], p[2] - p[0]).y;  // seen from above, the way it faces
      }
      // The rim moves in by up to half a cell. A flat sheet has three clusters a cell: 33 and 500 cells.
      const double cells = static_cast<double>(most) / (smooth ? 1 : 3);
      if (most >= 100) {
        EXPECT_NEAR(area, 1, 2.2 / std::sqrt(cells)) << most << smooth;
      }
    }
  }
}

TEST(View3d, PlansKeepToTheBudget) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&](double most) {
      return static_cast<std::size_t>(std::exp(std::log(most + 1) * std::generate_canonical<double, 30>(random)) - 1);
    };
    ViewDemand demand;
    const std::size_t objects = any(200);
    demand.frames = any(5000);
    for (std::size_t k = 0; k < objects; ++k) {
      demand.errors.push_back(std::generate_canonical<double, 30>(random));
      demand.worstFrames.push_back(demand.frames > 0 ? random() % demand.frames : 0);
    }
    demand.rigs = 1 + any(60);
    demand.evaluations = any(200'000);
    const ViewBudget budget = shareOf(ViewBudget{}, 1 + any(40));
    const ViewPlan plan = planViews(demand, budget);
    if (plan.objects.empty()) continue;
    EXPECT_LE(plan.objects.size(), std::min(budget.objects, objects));
    EXPECT_LE(plan.objects.size() * plan.bytes, budget.bytes);
    EXPECT_GE(plan.vertices, 64u);
    EXPECT_LE(plan.vertices * plan.frames.size() * plan.objects.size() * demand.evaluations, budget.evaluations);
    EXPECT_LE(plan.frames.size(), kViewFrames);
    ASSERT_FALSE(plan.frames.empty());
    EXPECT_LT(plan.frames.back(), demand.frames);
    EXPECT_TRUE(std::ranges::is_sorted(plan.frames));
    EXPECT_EQ(std::ranges::adjacent_find(plan.frames), plan.frames.end());
    // No object that was left out is worse than one that is shown.
    double least = 1;
    for (const std::size_t k : plan.objects) least = std::min(least, demand.errors[k]);
    for (std::size_t k = 0; k < objects; ++k)
      EXPECT_TRUE(std::ranges::binary_search(plan.objects, k) || demand.errors[k] <= least);
  }
}

TEST(View3d, AnEverydayPlanShowsTheWorstFrame) {
  const ViewPlan plan = planViews({{0.3}, {41}, 60, 8, 15}, ViewBudget{});
  EXPECT_THAT(plan.objects, testing::ElementsAre(0));
  EXPECT_THAT(plan.frames, testing::Contains(41u));
  EXPECT_EQ(plan.frames.front(), 0u);
  EXPECT_EQ(plan.frames.back(), 59u);
  EXPECT_GE(plan.frames.size(), 10u);
  EXPECT_GE(plan.vertices, 3000u);
  EXPECT_TRUE(planViews({{0.3}, {0}, 1, 1, 100'000'000}, ViewBudget{}).objects.empty());
}

TEST(View3d, ForemostLightsAreNearOnesThenBrightOnes) {
  ObjectReport object;
  LightReport dim, bright, near, dark;
  dim.share = 0.1;
  bright.share = 0.7;
  near.share = 0.01;
  near.weights = {0, 1};
  object.rigs.resize(1);
  object.rigs[0].lights = {dim, bright, dark, near};
  EXPECT_THAT(foremostLights({&object, 1}, 4, 1), testing::ElementsAre(3));
  EXPECT_THAT(foremostLights({&object, 1}, 4, 2), testing::ElementsAre(1, 3));
  EXPECT_THAT(foremostLights({&object, 1}, 4, 9), testing::ElementsAre(0, 1, 2, 3));
}

TEST(View3d, LightsOfEveryKind) {
  LightSet set;
  set.add(DirectionalLight{{0, -2, 0}, {1, 2, 3}});
  set.add(PointLight{{1, 2, 3}, {4, 5, 6}, 0.1f});
  set.add(SpotLight{{3, 2, 1}, {0, 0, 5}, {7, 8, 9}, 0.2f, 0.4f, 0.05f});
  set.add(SphereLight{{1, 1, 1}, 0.5f, {1, 1, 1}});
  set.add(DiskLight{{2, 2, 2}, {0, 0, 0}, 0.25f, {2, 2, 2}, true});
  const std::vector<int> all{0, 1, 2, 3, 4};
  const auto lights = viewLights(set, all);
  const auto places = lightPlaces(set, lights);
  EXPECT_EQ(lights[0].colour, (Rgb{1, 2, 3}));
  EXPECT_EQ(places[0].direction, (Vec3{0, -1, 0}));
  EXPECT_EQ(places[1].position, (Vec3{1, 2, 3}));
  EXPECT_FLOAT_EQ(places[1].radius, 0.1f);
  EXPECT_FLOAT_EQ(lights[2].innerAngle, 0.2f);
  EXPECT_FLOAT_EQ(lights[2].outerAngle, 0.4f);
  EXPECT_EQ(places[2].direction, (Vec3{0, 0, 1}));
  EXPECT_FLOAT_EQ(places[3].radius, 0.5f);
  EXPECT_TRUE(lights[4].twoSided);
  EXPECT_EQ(places[4].direction, (Vec3{})) << "a disk without a direction";
}

TEST(View3d, PagesCarryTheLibraryOnlyForAView) {
  const auto page = [](const Report& report) { return reportHtml(report, *reportJson(report)); };
  const std::string with = page(madeUpReport()), without = page(smallestReport());
  EXPECT_NE(with.find("id=\"view3d-data\""), std::string::npos);
  EXPECT_NE(with.find("three.js authors"), std::string::npos);
  EXPECT_EQ(without.find("id=\"view3d-data\""), std::string::npos);
  EXPECT_EQ(without.find("three.js authors"), std::string::npos);
  const nlohmann::json data = nlohmann::json::parse(view3dJson(madeUpReport()));
  EXPECT_EQ(data["scenes"].size(), 2u);
  EXPECT_TRUE(data["scenes"][1].is_null());
  EXPECT_EQ(data["objects"].size(), 2u);
  EXPECT_EQ(data["objects"][0]["rigs"].size(), madeUpReport().scenes[0].objects[0].rigs.size());
  EXPECT_TRUE(data["objects"][1].is_null());
  EXPECT_EQ(view3dJson(smallestReport()), "");
}

}  // namespace
}  // namespace rigel::tests
