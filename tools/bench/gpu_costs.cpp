#include "bench/gpu_costs.h"

#include "render/point_timer.h"
#include "report/run/run_options.h"
#include "samples/samples.h"
#include "scene/gltf_load.h"
#include "shader_binaries.h"
#include "spirv/specialise.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace rigel::tools {
namespace {

constexpr int kPoints = 1280 * 720;
constexpr int kJudged = 4096;  // points at which errors are measured
constexpr double kTime = 0.7;  // s, of the clip: between two lamps

struct Case {
  std::string name;
  std::string rig;
  int near = 0;
  float wrap = 0;
  int bands = 3;
  RigStorage storage = RigStorage::float32;
  float totalError = 0;  // what `auto` aims at
  bool disks = false;    // the lamps are disks
  Effect wrappedDisk = kWrappedDisk;
};

const std::vector<Case>& cases() {
  constexpr RigStorage kFloats = RigStorage::float32;
  static const std::vector<Case> all{
      {"gpu.constant", "constant"},
      {"gpu.gradient", "gradient"},
      {"gpu.mixed-l3,g,c", "mixed:l3,g,c"},
      {"gpu.lattice3x2x2", "lattice:3x2x2"},
      {"gpu.lattice3x2x2.gauss", "lattice:3x2x2@gauss"},
      {"gpu.lattice8x4x2", "lattice:8x4x2"},
      {"gpu.lattice8x4x2.texture32", "lattice:8x4x2", 0, 0, 3, RigStorage::texture32},
      {"gpu.lattice8x4x2.texture16", "lattice:8x4x2", 0, 0, 3, RigStorage::texture16},
      {"gpu.poly4", "poly:4"},
      {"gpu.poly6", "poly:6"},
      {"gpu.poly6.float16", "poly:6", 0, 0, 3, RigStorage::float16},
      {"gpu.poly12", "poly:12"},
      {"gpu.poly20", "poly:20"},
      {"gpu.invquad6", "invquad:6"},
      {"gpu.poly6.near1", "poly:6", 1},
      {"gpu.poly6.near2", "poly:6", 2},
      {"gpu.poly6.near4", "poly:6", 4},
      {"gpu.poly6.near8", "poly:6", 8},
      {"gpu.poly6.wrap", "poly:6", 0, 0.3f},
      {"gpu.poly6.near2.wrap", "poly:6", 2, 0.3f},
      {"gpu.poly6.disks", "poly:6", 0, 0, 3, kFloats, 0, true},
      {"gpu.poly6.disks.near1", "poly:6", 1, 0, 3, kFloats, 0, true},
      {"gpu.poly6.disks.near2", "poly:6", 2, 0, 3, kFloats, 0, true},
      {"gpu.poly6.disks.wrap", "poly:6", 0, 0.3f, 3, kFloats, 0, true},
      {"gpu.poly6.disks.near2.wrap.quadrature", "poly:6", 2, 0.3f, 3, kFloats, 0, true,
       Effect::light_near_diskQuadrature},
      {"gpu.poly6.disks.near2.wrap.table", "poly:6", 2, 0.3f, 3, kFloats, 0, true, Effect::light_near_diskTable},
      {"gpu.poly6.bands2", "poly:6", 0, 0, 2},
      {"gpu.poly6.bands4", "poly:6", 0, 0, 4},
      {"gpu.poly6.bands5", "poly:6", 0, 0, 5},
      {"gpu.auto.total0.03", "auto", 0, 0, 3, RigStorage::float32, 0.03f},
  };
  return all;
}

/// The car of sample:street in one frame.
struct CarInFrame {
  Scene scene = *loadScene("sample:street");
  SceneObject object;
  PosedObject rest, posed;
  PosedLights lights;
  LightSet disks;  // the lamps with faces of 0.3 m

  CarInFrame() {
    for (const SceneObject& candidate : findObjects(scene))
      if (!candidate.isStatic) object = candidate;
    ScenePose pose;
    poseScene(scene, kRestPose, 0, pose);
    poseObject(scene, object, pose, rest);
    poseScene(scene, 0, kTime, pose);
    poseObject(scene, object, pose, posed);
    poseLights(scene, pose, lights);
    constexpr float kFace = 0.3f;
    for (int i = 0; i < lights.set.spotCount(); ++i) {
      const SpotLight lamp = lights.set.spot(i);
      disks.add(DiskLight{lamp.position, lamp.direction, kFace, lamp.intensity * (1 / (float(kPi) * kFace * kFace))});
    }
  }

  std::vector<PointAndNormal> points(const std::vector<SurfacePoint>& on) const {
    std::vector<PointAndNormal> all;
    for (const SurfacePoint& point : on) all.push_back(evaluateSurface(object, posed, point));
    return all;
  }
};

double rmsOver(std::span<const RigRunner::Shaded> shaded, const Truth& truth, bool total) {
  double squares = 0;
  for (std::size_t i = 0; i < shaded.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double error = total ? static_cast<double>(shaded[i].clamped()[c]) - truth.exact[i][c]
                                 : static_cast<double>(shaded[i].rig[c] - truth.sh[i][c]);
      squares += error * error;
    }
  return std::sqrt(squares / (3 * static_cast<double>(shaded.size()))) / truth.mean;
}

class Measured {
 public:
  static Result<Measured> create(const GpuContext& context, const CarInFrame& car, const Case& wanted,
                                 const std::vector<PointAndNormal>& points) {
    Measured out;
    out.case_ = &wanted;
    auto surface = chooseSurface(car.object, car.rest, kJudged, wanted.wrap);
    if (!surface) return surface.error();
    const RigSpec spec = *parseRigSpec(wanted.rig);
    RunOptions options;
    options.near = NearChoice{wanted.totalError > 0, wanted.near};
    if (wanted.totalError > 0) options.target = LightingTarget{LightingTarget::Kind::totalError, wanted.totalError};
    LightingOptions asked = lightingOptions(spec, options);
    asked.wrap = wanted.wrap;
    auto rig = makeRigRunner(spec, asked, wanted.bands, car.object, car.rest, *surface);
    if (!rig) return rig.error();
    out.rig_ = *std::move(rig);
    const LightSet& lights = wanted.disks ? car.disks : car.lights.set;
    out.rig_->fit(car.object, car.posed, lights, 0);

    Truth truth;
    truth.update(car.object, car.posed, *surface, lights, wanted.bands);
    std::vector<RigRunner::Shaded> shaded(points.size());
    const std::vector<float> wraps(points.size(), wanted.wrap);
    auto timer = PointTimer::create(context, *out.rig_, points, wraps, wanted.storage, shaded, 1, wanted.wrappedDisk);
    if (!timer) return timer.error();
    out.timer_ = std::make_unique<PointTimer>(*std::move(timer));
    shaded.resize(truth.points.size());
    if (auto error = out.timer_->set(*out.rig_, truth.points, surface->wrap, shaded)) return *error;
    out.totalError_ = rmsOver(shaded, truth, true);
    if (out.rig_->nearLights().empty()) out.spatialError_ = rmsOver(shaded, truth, false);

    // The points that are timed stay in the shader's buffers.
    shaded.resize(points.size());
    if (auto error = out.timer_->set(*out.rig_, points, wraps, shaded)) return *error;
    return out;
  }

  std::optional<Error> repeat() { return timer_->repeat(); }

  double milliseconds() const { return 1e-3 * timer_->microseconds(); }

  Result<int> instructions() const {
    std::vector<SpecialisedConstant> constants;
    const ShaderVariant& variant = timer_->shader().variant();
    for (const ShaderConstant& c : variant.constants()) constants.push_back({c.id, c.bits});
    auto words = specialise(shaderBinary(variant.binary("points.comp")), constants);
    if (!words) return words.error();
    return instructionCount(*words);
  }

  const Case& what() const { return *case_; }
  std::optional<double> spatialError() const { return spatialError_; }
  double totalError() const { return totalError_; }

 private:
  const Case* case_ = nullptr;
  std::unique_ptr<RigRunner> rig_;
  std::unique_ptr<PointTimer> timer_;
  std::optional<double> spatialError_;
  double totalError_ = 0;
};

constexpr const char* kTextures[] = {"gpu.lattice8x4x2.texture32", "gpu.lattice8x4x2.texture16"};

}  // namespace

std::vector<std::string> gpuFigureNames() {
  std::vector<std::string> names;
  for (const Case& c : cases()) names.push_back(c.name);
  return names;
}

Result<std::vector<Figure>> measureGpuFigures(const std::vector<std::string>& names, int repetitions) {
  auto context = GpuContext::create();
  if (!context) return context.error();
  const CarInFrame car;
  auto surface = sampleSurface(car.object, car.rest, kPoints, 1);
  if (!surface) return surface.error();
  const std::vector<PointAndNormal> points = car.points(*surface);

  const auto isTexture = [](const Case& c) { return std::ranges::find(kTextures, c.name) != std::end(kTextures); };
  std::vector<Measured> all;
  for (const Case& c : cases()) {
    if (std::ranges::find(names, c.name) == names.end() && !isTexture(c)) continue;
    auto measured = Measured::create(*context, car, c, points);
    if (!measured) return Error{measured.error().line(), c.name};
    all.push_back(*std::move(measured));
  }
  for (int i = 0; i < repetitions; ++i)
    for (Measured& measured : all)
      if (auto error = measured.repeat()) return *error;

  double texture = HUGE_VAL;
  std::string faster;
  for (const Measured& m : all)
    if (isTexture(m.what()) && m.milliseconds() < texture) {
      texture = m.milliseconds();
      faster = m.what().name;
    }
  std::vector<Figure> figures;
  for (const Measured& m : all) {
    if (std::ranges::find(names, m.what().name) == names.end()) continue;
    const auto instructions = m.instructions();
    if (!instructions) return instructions.error();
    Figure figure{m.what().name, m.milliseconds(), "ms/1280x720", faster, texture / m.milliseconds()};
    figure.instructions = *instructions;
    figure.spatialError = m.spatialError();
    figure.totalError = m.totalError();
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace rigel::tools
