#include "pareto/gpu_times.h"

#include "pareto/pareto_axes.h"
#include "render/point_timer.h"

#include <algorithm>
#include <map>
#include <set>

namespace rigel::tools {
namespace {

constexpr std::size_t kTimedPoints = 65536;  // fewer take no longer than starting does
constexpr int kRepetitions = 5;

/// A shader in one storage, and its time once it has one.
struct Shader {
  ShaderVariant variant;
  bool half = false;
  PointTimer timer;
};

ShaderVariant plainVariant(const RigRunner& rig, float wrap) {
  std::vector<GpuVec4> texels(static_cast<std::size_t>(packRigBound(rig.rig(), rig.bands())));
  return variantOf(rig, rig.pack(GpuRigPlace{}, std::span(texels)), rig.effects(wrap), {});
}

class Timing {
 public:
  Timing(const GpuContext& context, const ObjectPareto& object, std::vector<PointAndNormal> points,
         const std::function<void(double)>& step)
      : context_(context), object_(object), step_(step), points_(std::move(points)), shaded_(points_.size()) {}

  std::optional<Error> measure(std::vector<ParetoPoint>& points) {
    bands_ = comparedBands(points);
    for (const char* cost : {"frame_us", "modelled_ns_per_point"})
      for (const char* error : {"total_rms", "spatial_rms"})
        for (const std::size_t i : paretoFront(compared(points, axisNamed(cost), axisNamed(error))))
          worthIt_.insert(points[i].spec);
    if (auto error = makeShaders(points)) return error;
    if (auto error = measureNear(points)) return error;
    for (int i = 0; i < kRepetitions; ++i)
      for (Shader& shader : shaders_)
        if (auto error = shader.timer.repeat()) return error;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (shaderOf_[i]) points[i].gpuNanoseconds = perPoint(shaders_[*shaderOf_[i]].timer) + nearTime(points[i]);
    return measureAdaptive(points);
  }

 private:
  /// Making a shader takes longer than timing it, so that in other bands and 16 bits only rigs are timed that are worth
  /// it: those on a front of the compared bands.
  bool isTimed(const std::vector<ParetoPoint>& points, std::size_t i) const {
    const ParetoPoint& point = points[i];
    if (point.form != NearForm::exact || checkGpuRig(object_.rigOf(i).rig().spec())) return false;
    return isCompared(point, bands_) || worthIt_.contains(point.spec);
  }
  bool isAdaptive(std::size_t i) const { return object_.rigOf(i).rig().spec().adaptive; }
  double perPoint(const PointTimer& timer) const {
    return 1000 * timer.microseconds() / static_cast<double>(points_.size());
  }

  Result<PointTimer> timerOf(const RigRunner& rig, bool half) {
    const int repeats = static_cast<int>(std::max<std::size_t>(1, kTimedPoints / points_.size()));
    return PointTimer::create(context_, rig, points_, wraps(), half ? RigStorage::float16 : RigStorage::float32,
                              shaded_, repeats);
  }
  std::span<const float> wraps() const { return object_.surface().wrap; }

  std::optional<Error> makeShaders(const std::vector<ParetoPoint>& points) {
    shaderOf_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      step_(0.6 * static_cast<double>(i) / static_cast<double>(points.size()));
      if (!isTimed(points, i) || isAdaptive(i)) continue;
      const RigRunner& rig = object_.plainRigOf(i);
      const ShaderVariant variant = plainVariant(rig, wraps().front());
      const auto known = std::ranges::find_if(
          shaders_, [&](const Shader& s) { return s.variant == variant && s.half == points[i].half; });
      if (known == shaders_.end()) {
        auto timer = timerOf(rig, points[i].half);
        if (!timer) return Error{timer.error().line(), points[i].spec};
        shaders_.push_back({variant, points[i].half, *std::move(timer)});
        shaderOf_[i] = shaders_.size() - 1;
      } else {
        shaderOf_[i] = static_cast<std::size_t>(known - shaders_.begin());
      }
    }
    return std::nullopt;
  }

  /// Near lights beside the first rig of each number of bands that has some.
  std::optional<Error> measureNear(const std::vector<ParetoPoint>& points) {
    for (int bands = kMinBands; bands <= kMaxBands; ++bands) {
      std::vector<std::size_t> some;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const bool counted = points[i].bands == bands && points[i].target.empty() && points[i].near != "0";
        if (!counted || !isTimed(points, i) || points[i].half || isAdaptive(i)) continue;
        if (!some.empty() && &object_.plainRigOf(i) != &object_.plainRigOf(some.front())) break;
        if (!object_.rigOf(i).nearLights().empty()) some.push_back(i);
      }
      if (some.empty()) continue;
      const std::size_t most = *std::ranges::max_element(some, {}, [&](std::size_t i) { return nearCount(i); });
      auto timer = timerOf(object_.rigOf(most), false);
      if (!timer) return timer.error();
      auto& times = near_[bands];
      for (int i = 0; i < kRepetitions; ++i) {
        if (auto error = time(*timer, object_.plainRigOf(most), 0, times)) return error;
        for (const std::size_t k : some)
          if (auto error = time(*timer, object_.rigOf(k), nearCount(k), times)) return error;
      }
      double dearest = 0;  // more lights never take less: where they do, something else ran
      for (auto& [lights, nanoseconds] : times) nanoseconds = dearest = std::max(dearest, nanoseconds);
    }
    return std::nullopt;
  }
  std::size_t nearCount(std::size_t i) const { return object_.rigOf(i).nearLights().size(); }

  std::optional<Error> time(PointTimer& timer, const RigRunner& rig, std::size_t lights,
                            std::map<double, double>& times) {
    if (auto error = timer.set(rig, points_, wraps(), shaded_)) return error;
    for (int i = 0; i < kRepetitions; ++i)
      if (auto error = timer.repeat()) return error;
    const auto [entry, isNew] = times.try_emplace(static_cast<double>(lights), perPoint(timer));
    entry->second = std::min(entry->second, perPoint(timer));
    return std::nullopt;
  }

  /// Between the counts that were measured, and beyond the last, along straight lines.
  double nearTime(const ParetoPoint& point) const {
    const auto found = near_.find(point.bands);
    if (found == near_.end() || point.nearLights == 0) return 0;
    const auto& times = found->second;
    auto above = times.lower_bound(point.nearLights);
    if (above == times.begin()) ++above;
    if (above == times.end()) --above;
    const auto below = std::prev(above);
    const double slope = (above->second - below->second) / (above->first - below->first);
    return below->second + slope * (point.nearLights - below->first) - times.begin()->second;
  }

  /// Every variant of an `auto` rig is in one timer, made with whom may want them all.
  std::optional<Error> measureAdaptive(std::vector<ParetoPoint>& points) {
    std::map<std::tuple<std::string, int, bool>, std::vector<std::size_t>> kinds;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (isTimed(points, i) && isAdaptive(i)) kinds[{points[i].spec, points[i].bands, points[i].half}].push_back(i);
    double done = 0.7;
    for (const auto& [kind, members] : kinds) {
      const auto wantsAll = [&](std::size_t i) {
        return object_.rigOf(i).asked().target.kind == LightingTarget::Kind::totalError;
      };
      const auto maker = std::ranges::find_if(members, wantsAll);
      auto timer = timerOf(object_.rigOf(maker == members.end() ? members.front() : *maker), std::get<bool>(kind));
      if (!timer) return timer.error();
      for (const std::size_t i : members) {
        step_(done);
        if (auto error = timer->set(object_.rigOf(i), points_, wraps(), shaded_)) return error;
        for (int r = 0; r < kRepetitions; ++r)
          if (auto error = timer->repeat()) return error;
        points[i].gpuNanoseconds = perPoint(*timer);
      }
      done += 0.3 / static_cast<double>(kinds.size());
    }
    return std::nullopt;
  }

  const GpuContext& context_;
  const ObjectPareto& object_;
  const std::function<void(double)>& step_;
  std::vector<PointAndNormal> points_;
  std::vector<RigRunner::Shaded> shaded_;
  int bands_ = kDefaultBands;      // in which all rigs are timed
  std::set<std::string> worthIt_;  // specs that are timed in all
  std::vector<Shader> shaders_;
  std::vector<std::optional<std::size_t>> shaderOf_;  // of each point
  std::map<int, std::map<double, double>> near_;      // by bands: ns a point by the number of near lights
};

}  // namespace

std::optional<Error> measureGpuTimes(const GpuContext& context, ObjectPareto& object, const LightSet& lights,
                                     std::vector<ParetoPoint>& points, const std::function<void(double)>& step) {
  object.light(lights);
  std::vector<PointAndNormal> at;
  for (const SurfacePoint& point : object.surface().measured)
    at.push_back(evaluateSurface(object.object(), object.posed(), point));
  return Timing(context, object, std::move(at), step).measure(points);
}

}  // namespace rigel::tools
