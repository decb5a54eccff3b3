#include "picture/raycast.h"

#include "parallel/parallel.h"

#include <rigel/glm.h>
#include <rigel/sh.h>

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace rigel::tools {
namespace {

struct Part {
  SampleKind kind = SampleKind::object;
  std::uint32_t index = 0;  // among objects, or among lights
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::vec3> colours;
  std::vector<float> wraps;
  LightMarker light;
};

/// Cosine between the normals of neighbouring pixels below which an edge runs between them.
constexpr float kEdgeCosine = 0.94f;

bool isEdgeBetween(const VisibleSample* a, const VisibleSample* b) {
  if (!a || !b) return a != b;
  if (a->kind != b->kind || a->part != b->part || !(a->baseColour == b->baseColour)) return true;
  return a->kind != SampleKind::light && dot(a->normal, b->normal) < kEdgeCosine;
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  std::vector<Part> parts;  // index: Embree's geometry id
  std::uint32_t objectCount = 0, lightCount = 0;
  bool isCommitted = false;

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void attach(RTCGeometry geometry, Part part) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(parts.size()));
    rtcReleaseGeometry(geometry);
    parts.push_back(std::move(part));
    isCommitted = false;
  }

  void commit() {
    if (!isCommitted) rtcCommitScene(scene);
    isCommitted = true;
  }

  bool shoot(const Camera& camera, glm::vec2 pixel, VisibleSample& out) const {
    const glm::vec3 d = camera.direction(pixel);
    RTCRayHit query{};
    query.ray.org_x = camera.eye.x;
    query.ray.org_y = camera.eye.y;
    query.ray.org_z = camera.eye.z;
    query.ray.dir_x = d.x;
    query.ray.dir_y = d.y;
    query.ray.dir_z = d.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    const Part& part = parts[query.hit.geomID];
    const glm::vec3 flat{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
    out.kind = part.kind;
    out.part = part.index;
    out.position = fromGlm(camera.eye + query.ray.tfar * d);
    out.normal = fromGlm(glm::normalize(flat));
    if (part.kind == SampleKind::light) {
      const bool isBehind = part.light.isDisk() && dot(fromGlm(d), part.light.axis) > 0;
      if (!isBehind || part.light.twoSided) out.emission = part.light.emission;
      return true;
    }
    out.triangle = query.hit.primID;
    out.b1 = query.hit.u;
    out.b2 = query.hit.v;
    out.baseColour = rgbFromGlm(part.colours[out.triangle]);
    out.wrap = part.wraps[out.triangle];
    if (!part.normals.empty()) {
      const glm::uvec3 t = part.triangles[out.triangle];
      const glm::vec3 n =
          (1 - out.b1 - out.b2) * part.normals[t.x] + out.b1 * part.normals[t.y] + out.b2 * part.normals[t.z];
      if (glm::dot(n, n) > 1e-12f) out.normal = fromGlm(glm::normalize(n));
    }
    return true;
  }
};

RayCaster::RayCaster() : impl_(std::make_unique<Impl>()) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

void RayCaster::add(const SceneObject& object, const PosedObject& posed, SampleKind kind) {
  assert(kind != SampleKind::light);
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                           posed.positions.size());
  std::memcpy(vertices, posed.positions.data(), posed.positions.size() * sizeof(glm::vec3));
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                          object.triangles.size());
  std::memcpy(indices, object.triangles.data(), object.triangles.size() * sizeof(glm::uvec3));
  impl_->attach(
      geometry,
      {kind, impl_->objectCount++, posed.normals, object.triangles, object.triangleColour, object.triangleWrap, {}});
}

void RayCaster::addLight(const LightMarker& light) {
  RTCGeometry geometry = rtcNewGeometry(
      impl_->device, light.isDisk() ? RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT : RTC_GEOMETRY_TYPE_SPHERE_POINT);
  const auto fill = [&](RTCBufferType buffer, RTCFormat format, std::initializer_list<float> values) {
    std::ranges::copy(values, static_cast<float*>(rtcSetNewGeometryBuffer(geometry, buffer, 0, format,
                                                                          values.size() * sizeof(float), 1)));
  };
  fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, {light.centre.x, light.centre.y, light.centre.z, light.radius});
  if (light.isDisk()) fill(RTC_BUFFER_TYPE_NORMAL, RTC_FORMAT_FLOAT3, {light.axis.x, light.axis.y, light.axis.z});
  impl_->attach(geometry, {SampleKind::light, impl_->lightCount++, {}, {}, {}, {}, light});
}

VisibleSurface RayCaster::cast(const Camera& camera, int perSide) const {
  impl_->commit();
  const int width = camera.width, height = camera.height;
  const std::size_t pixelCount = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<VisibleSample> centre(pixelCount);
  std::vector<char> isHit(pixelCount);
  parallelFor(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * width + x);
      centre[i].pixel = static_cast<std::uint32_t>(i);
      isHit[i] = impl_->shoot(camera, glm::vec2(x, y) + 0.5f, centre[i]);
    }
  });

  const auto seen = [&](int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y * width + x);
    return isHit[i] ? &centre[i] : nullptr;
  };
  std::vector<std::vector<VisibleSample>> rows(static_cast<std::size_t>(height));
  parallelFor(height, [&](int y) {
    std::vector<VisibleSample>& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < width; ++x) {
      const VisibleSample* here = seen(x, y);
      const bool isEdge =
          (x > 0 && isEdgeBetween(here, seen(x - 1, y))) || (x + 1 < width && isEdgeBetween(here, seen(x + 1, y))) ||
          (y > 0 && isEdgeBetween(here, seen(x, y - 1))) || (y + 1 < height && isEdgeBetween(here, seen(x, y + 1)));
      if (!isEdge || perSide < 2) {
        if (here) row.push_back(*here);
        continue;
      }
      const float step = 1 / static_cast<float>(perSide);
      for (int k = 0; k < perSide * perSide; ++k) {
        VisibleSample sample;
        sample.pixel = static_cast<std::uint32_t>(y * width + x);
        sample.weight = step * step;
        const glm::vec2 offset{static_cast<float>(k % perSide) + 0.5f, static_cast<float>(k / perSide) + 0.5f};
        if (impl_->shoot(camera, glm::vec2(x, y) + step * offset, sample)) row.push_back(sample);
      }
    }
  });

  VisibleSurface surface{width, height, {}};
  for (const auto& row : rows) surface.samples.insert(surface.samples.end(), row.begin(), row.end());
  return surface;
}

std::vector<LightMarker> lightMarkers(const LightSet& lights, float minRadius, float brightness) {
  std::vector<LightMarker> markers;
  for (int i = 0; i < lights.size(); ++i) {
    lights.visit(i, [&](const auto& light) {
      if constexpr (requires { light.radius; }) {
        const Rgb colour = colourOf(light);
        const float largest = std::max({colour.r, colour.g, colour.b});
        if (!(largest > 0)) return;
        LightMarker marker{light.position, std::max(light.radius, minRadius), colour * (brightness / largest), {}};
        if constexpr (requires { light.twoSided; }) {
          const float size = length(light.direction);
          if (!(size > 0)) return;
          marker.axis = light.direction * (1 / size);
          marker.twoSided = light.twoSided;
        }
        markers.push_back(marker);
      }
    });
  }
  return markers;
}

void addLights(RayCaster& caster, const LightSet& lights, float minRadius, float brightness) {
  for (const LightMarker& marker : lightMarkers(lights, minRadius, brightness)) caster.addLight(marker);
}

Rgb outgoingRadiance(const VisibleSample& sample, Rgb irradiance) {
  if (sample.kind == SampleKind::light) return sample.emission;
  constexpr auto kInversePi = static_cast<float>(1 / kPi);
  return {sample.baseColour.r * irradiance.r * kInversePi, sample.baseColour.g * irradiance.g * kInversePi,
          sample.baseColour.b * irradiance.b * kInversePi};
}

Image resolve(const VisibleSurface& surface, std::span<const Rgb> colours) {
  assert(colours.size() == surface.samples.size());
  Image image(surface.width, surface.height);
  for (std::size_t s = 0; s < colours.size(); ++s) {
    const VisibleSample& sample = surface.samples[s];
    for (int c = 0; c < 3; ++c) image.rgb[3 * sample.pixel + c] += sample.weight * colours[s][c];
    image.coverage[sample.pixel] += sample.weight;
  }
  // Nine ninths may sum to a hair above 1.
  for (float& c : image.coverage) c = std::min(c, 1.0f);
  return image;
}

}  // namespace rigel::tools
