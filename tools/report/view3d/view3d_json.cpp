#include "report/view3d/view3d_json.h"

#include "report/formats/deflate.h"
#include "report/view3d/view3d_pack.h"
#include "report/view3d/view3d_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Six digits.
Json number(float value) {
  if (!std::isfinite(value)) return 0;
  if (value == 0) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(static_cast<double>(value)))) - 5);
  return std::round(static_cast<double>(value) / step) * step;
}

void append(Json& to, Vec3 v) {
  for (int axis = 0; axis < 3; ++axis) to.push_back(number(v[axis]));
}

/// The box of all that is drawn, which positions are quantised in.
class Bounds {
 public:
  void add(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(p[axis])) continue;
      lo_[axis] = std::min(lo_[axis], p[axis]);
      hi_[axis] = std::max(hi_[axis], p[axis]);
    }
  }
  Vec3 lo() const { return {low(0), low(1), low(2)}; }
  Vec3 size() const { return {width(0), width(1), width(2)}; }

 private:
  float low(int axis) const { return lo_[axis] <= hi_[axis] ? lo_[axis] : 0; }
  /// Not 0: it is divided by.
  float width(int axis) const {
    return std::max(std::numeric_limits<float>::min(), lo_[axis] <= hi_[axis] ? hi_[axis] - lo_[axis] : 0);
  }

  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Vec3 lo_{kInfinity, kInfinity, kInfinity}, hi_{-kInfinity, -kInfinity, -kInfinity};
};

/// Does the object keep its shape through the frames?
bool isRigid(const std::vector<const ObjectViewFrame*>& frames, Vec3 size) {
  constexpr float kTolerance = 1e-4f;  // of the box: rounding of poses far from the origin
  const float allowed = kTolerance * length(size);
  return std::ranges::all_of(frames, [&](const ObjectViewFrame* frame) {
    for (std::size_t i = 0; i < frame->positions.size(); ++i)
      if (!(length(frame->positions[i] - frames.front()->positions[i]) <= allowed)) return false;
    return true;
  });
}

/// Rows of frames: each is compared with the one before.
template <class T>
class Course {
 public:
  explicit Course(RowPacker& packer) : packer_(packer) {}
  void add(std::vector<T> row) {
    packer_.add(std::span<const T>(row),
                row.size() == before_.size() ? std::span<const T>(before_) : std::span<const T>());
    before_ = std::move(row);
  }

 private:
  RowPacker& packer_;
  std::vector<T> before_;
};

class ViewWriter {
 public:
  explicit ViewWriter(std::vector<const ObjectViewFrame*> frames) : frames_(std::move(frames)) {
    Bounds bounds;
    for (const ObjectViewFrame* frame : frames_) {
      for (const Vec3& p : frame->positions) bounds.add(p);
      for (const auto& rig : frame->rigs)
        for (const Vec3& p : rig.samples) bounds.add(p);
    }
    lo_ = bounds.lo();
    size_ = bounds.size();
  }

  Json write(const ObjectView& view) {
    const ObjectViewFrame& first = *frames_.front();
    const bool rigid = isRigid(frames_, size_);
    Json lo = Json::array(), size = Json::array(), poses = Json::array(), rigs = Json::array();
    append(lo, lo_);
    append(size, size_);
    for (const ObjectViewFrame* frame : frames_) poses.push_back(pose(frame->worldFromLocal));
    addTriangles(view.triangles);
    addPositions(rigid);
    const float truthMost = addTruth();
    for (std::size_t r = 0; r < first.rigs.size(); ++r) rigs.push_back(addRig(r));
    return {{"triangles", view.triangles.size()},
            {"vertices", first.positions.size()},
            {"rigid", rigid},
            {"lo", std::move(lo)},
            {"size", std::move(size)},
            {"poses", std::move(poses)},
            {"truth_max", number(truthMost)},
            {"rigs", std::move(rigs)},
            {"lights", first.rigs.empty() ? 0 : first.rigs.front().lights.size()},
            {"data", packedText(packer_.bytes())}};
  }

 private:
  static Json pose(const rigel::RigFrame& frame) {
    Json out = Json::array();
    for (const Vec3 column : {frame.x, frame.y, frame.z, frame.origin}) append(out, column);
    return out;
  }

  /// Green, then how red and blue differ from it: less than each by itself.
  template <class Pack, class Colours>
  void addColours(const Colours& coloursOf, const Pack& pack) {
    for (const int channel : {1, 0, 2}) {
      Course<std::uint8_t> course(packer_);
      for (const ObjectViewFrame* frame : frames_) {
        std::vector<std::uint8_t> row;
        for (const Rgb& e : coloursOf(*frame))
          row.push_back(static_cast<std::uint8_t>(channel == 1 ? pack(e.g) : pack(e[channel]) - pack(e.g)));
        course.add(std::move(row));
      }
    }
  }

  void addTriangles(const std::vector<std::array<std::uint16_t, 3>>& triangles) {
    std::vector<std::uint16_t> indices;
    for (const auto& triangle : triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
    packer_.add(std::span<const std::uint16_t>(indices));
  }

  void addPositions(bool rigid) {
    for (int axis = 0; axis < 3; ++axis) {
      Course<std::uint16_t> course(packer_);
      for (std::size_t f = 0; f < (rigid ? 1 : frames_.size()); ++f) course.add(along(frames_[f]->positions, axis));
    }
  }

  std::vector<std::uint16_t> along(const std::vector<Vec3>& positions, int axis) const {
    std::vector<std::uint16_t> row;
    for (const Vec3& p : positions) row.push_back(quantised(p[axis], lo_[axis], size_[axis]));
    return row;
  }

  float addTruth() {
    float most = std::numeric_limits<float>::min();
    for (const ObjectViewFrame* frame : frames_)
      for (const Rgb& e : frame->truth) most = std::max({most, e.r, e.g, e.b});
    addColours(
        [](const ObjectViewFrame& frame) -> const auto& { return frame.truth; },
        [most](float x) { return packedMagnitude(x, most); });
    return most;
  }

  Json addRig(std::size_t r) {
    float most = std::numeric_limits<float>::min();
    std::size_t samples = frames_.front()->rigs[r].samples.size();
    Json boxes = Json::array();
    for (const ObjectViewFrame* frame : frames_) {
      const ObjectViewFrame::OfRig& rig = frame->rigs[r];
      for (const Rgb& e : rig.error) most = std::max({most, std::abs(e.r), std::abs(e.g), std::abs(e.b)});
      samples = std::min(samples, rig.samples.size());
      Json box = Json::array();
      append(box, rig.box.lo);
      append(box, rig.box.hi);
      boxes.push_back(std::move(box));
    }
    addColours(
        [r](const ObjectViewFrame& frame) -> const auto& { return frame.rigs[r].error; },
        [most](float x) { return packedSigned(x, most); });
    Course<std::uint8_t> lights(packer_);
    for (const ObjectViewFrame* frame : frames_) lights.add(frame->rigs[r].lights);
    for (int axis = 0; axis < 3; ++axis) {
      Course<std::uint16_t> course(packer_);
      for (const ObjectViewFrame* frame : frames_) {
        std::vector<Vec3> drawn(frame->rigs[r].samples);
        drawn.resize(samples);
        course.add(along(drawn, axis));
      }
    }
    return {{"error_max", number(most)}, {"samples", samples}, {"boxes", std::move(boxes)}};
  }

  std::vector<const ObjectViewFrame*> frames_;
  Vec3 lo_, size_;
  RowPacker packer_;
};

/// Positions, directions and radii of all frames, light by light, so that what stands still repeats.
std::string packedPlaces(const SceneView& view) {
  std::vector<std::uint8_t> bytes;
  const auto add = [&](float value) {
    const auto bits = std::bit_cast<std::uint32_t>(std::isfinite(value) ? value : 0.0f);
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  };
  for (std::size_t i = 0; i < view.lights.size(); ++i)
    for (const std::vector<ViewLightPlace>& frame : view.places) {
      for (const Vec3 v : {frame[i].position, frame[i].direction})
        for (int axis = 0; axis < 3; ++axis) add(v[axis]);
      add(frame[i].radius);
    }
  return packedText(bytes);
}

}  // namespace

std::string packedView(const ObjectView& view, std::size_t bytes) {
  for (std::size_t count = view.frames.size(); count > 0;) {
    std::vector<const ObjectViewFrame*> frames;
    Json shown = Json::array();
    for (const std::size_t f : spread(view.frames.size(), count)) {
      frames.push_back(&view.frames[f]);
      shown.push_back(f);
    }
    Json document = ViewWriter(std::move(frames)).write(view);
    document["frames"] = std::move(shown);
    std::string text = document.dump();
    if (text.size() <= bytes) return text;
    count = std::min(count - 1, count * bytes / text.size());
  }
  return "";
}

std::string packedScene(const SceneView& view) {
  Json lights = Json::array();
  for (const ViewLight& light : view.lights) {
    Json entry = {{"index", light.index},
                  {"color", {number(light.colour.r), number(light.colour.g), number(light.colour.b)}}};
    if (light.outerAngle > 0) entry["cone"] = {number(light.innerAngle), number(light.outerAngle)};
    if (light.twoSided) entry["two_sided"] = true;
    lights.push_back(std::move(entry));
  }
  return Json{{"frames", view.frames}, {"lights", std::move(lights)}, {"places", packedPlaces(view)}}.dump();
}

std::string view3dJson(const Report& report) {
  const auto entry = [](const std::string& text) { return text.empty() ? "null" : text; };
  std::string scenes, objects;
  bool any = false;
  for (const SceneReport& scene : report.scenes) {
    scenes += (scenes.empty() ? "" : ",") + entry(scene.view3d);
    for (const ObjectReport& object : scene.objects) {
      objects += (objects.empty() ? "" : ",") + entry(object.view3d);
      any = any || !object.view3d.empty();
    }
  }
  return any ? fmt::format("{{\"scenes\":[{}],\"objects\":[{}]}}", scenes, objects) : "";
}

}  // namespace rigel::tools
