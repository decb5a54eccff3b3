#include "render/scene_renderer.h"

#include "picture/shade_exact.h"
#include "samples/mesh_builder.h"
#include "shader_binaries.h"

#include <rigel/glm.h>
#include <rigel/near_light.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace rigel::tools {
namespace {

constexpr int kBallSegments = 12;
constexpr float kBallEquator = 1e-3f;  // half the height within which a vertex of the unit ball is on its equator
/// Of the distance to what is framed: nearer things are not drawn.
constexpr float kNearPlane = 0.004f;

// What object.frag writes: radiance, irradiance, part and triangle.
constexpr VkFormat kColours[] = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32_UINT};
constexpr std::size_t kColourBytes[] = {16, 16, 8};
constexpr VkClearColorValue kClear[] = {{{0, 0, 0, 0}}, {{0, 0, 0, 0}}, {{0, 0, 0, 0}}};

/// As draw.glsl has it.
struct DrawConstants {
  glm::vec4 right{0}, up{0}, back{0};
  glm::vec3 eye{0};
  float nearPlane = 0;
  std::uint32_t part = 0;
  float radianceScale = 1;
  std::int32_t firstNear = 0, nearCount = 0;
  float unused[12] = {};
};
static_assert(sizeof(DrawConstants) == 128);

/// `normals`: flat.vert has no use for them, and layers complain of attributes that nobody reads.
std::vector<VertexStream> streams(bool normals) {
  VertexStream stream{sizeof(DrawVertex),
                      {{0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(DrawVertex, position)},
                       {2, VK_FORMAT_R32G32B32_SFLOAT, offsetof(DrawVertex, colour)},
                       {3, VK_FORMAT_R32_UINT, offsetof(DrawVertex, triangle)}}};
  if (normals) stream.attributes.push_back({1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(DrawVertex, normal)});
  return {stream};
}

std::vector<DrawVertex> unitBall() {
  Primitive sphere;
  addSphere(sphere, 1, kBallSegments);
  std::vector<DrawVertex> vertices;
  for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t)
    for (const glm::uint v : {sphere.triangles[t].x, sphere.triangles[t].y, sphere.triangles[t].z})
      vertices.push_back({sphere.positions[v], sphere.positions[v], {}, t});
  return vertices;
}

/// Takes the unit ball to the marker's shape: itself, or flattened to a disk whose face is the ball's upper half.
glm::mat3 shapeOf(const LightMarker& marker) {
  if (!marker.isDisk()) return glm::mat3(1);
  constexpr float kThickness = 0.01f;  // of the radius: keeps the two faces apart in the depth buffer
  const glm::vec3 y = toGlm(marker.axis);
  const glm::vec3 x = glm::normalize(glm::cross(y, std::abs(y.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
  return {x, kThickness * y, glm::cross(x, y)};
}

template <class T>
std::vector<T> threeOfFour(GpuBuffer& pixels) {
  std::vector<T> all;
  for (const glm::vec4& pixel : pixels.as<glm::vec4>()) all.push_back({pixel.x, pixel.y, pixel.z});
  return all;
}

}  // namespace

Result<SceneRenderer> SceneRenderer::create(const GpuContext& context, std::span<const DrawnObject> objects,
                                            const LightSet& lights, const RendererOptions& options) {
  ShadingRoom room;
  room.lights = lights.size();
  std::vector<Drawn> drawn;
  std::uint32_t vertices = 0;
  for (const DrawnObject& object : objects) {
    if (object.rig != nullptr)
      if (const auto error = checkGpuRig(object.rig->rig().spec())) return *error;
    drawn.push_back({object.object, object.rig, room.rigs.size(), DrawList(*object.object, options.wrap), vertices});
    vertices += drawn.back().draws.vertexCount();
    if (object.rig != nullptr) room.rigs.push_back(object.rig);
    for (const DrawRange& range : drawn.back().draws.ranges())
      if (std::ranges::find(room.wraps, range.wrap) == room.wraps.end()) room.wraps.push_back(range.wrap);
  }
  for (const float wrap : room.wraps)
    if (nearKindsOf(lightEffects(lights), wrap, options.wrappedDisk).has(Effect::light_near_diskTable))
      room.diskTable = true;
  auto buffers = ShadingBuffers::create(context, room, options.storage);
  if (!buffers) return buffers.error();
  auto commands = GpuCommands::create(context);
  if (!commands) return commands.error();
  SceneRenderer renderer(context, options, *std::move(buffers), *std::move(commands));
  renderer.drawn_ = std::move(drawn);
  renderer.objectVertices_ = vertices;
  renderer.ball_ = unitBall();
  if (auto error = renderer.makePipelines(lights)) return *error;
  return renderer;
}

std::optional<Error> SceneRenderer::makePipelines(const LightSet& lights) {
  // Any target of the same formats does for pipelines and their first draws.
  auto target = RasterTarget::create(*context_, 4, 4, kColours);
  if (!target) return target.error();
  const ShaderCode vertex{shaderBinary("flat.vert")}, fragment{shaderBinary("flat.frag")};
  auto flat = GpuPipeline::raster(*context_, buffers_.layout(), vertex, fragment, streams(false), *target);
  if (!flat) return flat.error();
  flat_ = *std::move(flat);
  if (options_.points) {
    auto surface = GpuPipeline::raster(*context_, buffers_.layout(), {shaderBinary("object.vert")},
                                       {shaderBinary("surface.frag")}, streams(true), *target);
    if (!surface) return surface.error();
    surface_ = *std::move(surface);
  }
  for (Drawn& drawn : drawn_) {
    GpuRig packed;
    if (drawn.rig != nullptr) packed = buffers_.pack(drawn.rigIndex, *drawn.rig).packed;
    for (const DrawRange& range : drawn.draws.ranges()) {
      const Effects near = nearKinds(lights, range.wrap);
      std::vector<ShaderVariant> variants{nearVariant(options_.bands, near)};
      if (drawn.rig != nullptr) variants = possibleVariants(*drawn.rig, packed, range.wrap, near);
      for (const ShaderVariant& variant : variants)
        if (auto error = addPipeline(variant, isPerVertex(drawn), *target)) return error;
    }
  }
  shaders_.save();  // what cannot be kept is only slower next time
  return warmUp(*target);
}

std::optional<Error> SceneRenderer::addPipeline(const ShaderVariant& variant, bool perVertex,
                                                const RasterTarget& target) {
  if (pipelineOf(variant, perVertex) != nullptr) return std::nullopt;
  const std::vector<ShaderConstant> constants = variant.constants();
  ShaderCode vertex{shaderBinary("object.vert")};
  ShaderCode fragment{shaderBinary("object_per_vertex.frag")};
  auto shading = shaders_.get(variant.binary(perVertex ? "object_per_vertex.vert" : "object.frag"), constants);
  if (!shading) return shading.error();
  (perVertex ? vertex : fragment) = ShaderCode{*shading};
  auto pipeline = GpuPipeline::raster(*context_, buffers_.layout(), vertex, fragment, streams(true), target);
  if (!pipeline) return pipeline.error();
  shelf_.push_back({variant, perVertex, *std::move(pipeline)});
  return std::nullopt;
}

/// Draws a triangle with every pipeline: drivers put compiling off to the first use.
std::optional<Error> SceneRenderer::warmUp(const RasterTarget& target) {
  if (auto error = makeRoom(1)) return error;
  const DrawVertex corners[] = {
      {{-1, -1, 0}, {0, 0, 1}, {}, 0}, {{1, -1, 0}, {0, 0, 1}, {}, 0}, {{0, 1, 0}, {0, 0, 1}, {}, 0}};
  std::memcpy(vertices_->bytes().data(), corners, sizeof corners);
  const Camera camera = frameSphere({{0, 0, 0}, 1}, 4, 4);
  if (auto error = commands_.begin()) return error;
  buffers_.upload(commands_);
  commands_.beginPass(target, kClear);
  Draw draw;
  draw.vertices = 3;
  draw.bindings = &buffers_.bindings(0);
  // Twice: lavapipe compiles a vertex shader once more where another pipeline was in use before.
  for (int round = 0; round < 2; ++round) {
    record(camera, draw, *flat_);
    if (surface_) record(camera, draw, *surface_);
    for (const Entry& entry : shelf_) record(camera, draw, entry.pipeline);
  }
  commands_.endPass();
  return commands_.run();
}

const GpuPipeline* SceneRenderer::pipelineOf(const ShaderVariant& variant, bool perVertex) const {
  const auto found = std::ranges::find_if(
      shelf_, [&](const Entry& entry) { return entry.variant == variant && entry.perVertex == perVertex; });
  return found == shelf_.end() ? nullptr : &found->pipeline;
}

std::optional<Error> SceneRenderer::makeRoom(std::size_t markers) {
  const std::size_t needed = (objectVertices_ + markers * ball_.size()) * sizeof(DrawVertex);
  if (vertices_ && vertices_->size() >= needed) return std::nullopt;
  auto vertices = GpuBuffer::create(*context_, BufferUse::vertices, needed);
  if (!vertices) return vertices.error();
  vertices_ = *std::move(vertices);
  return std::nullopt;
}

std::optional<Error> SceneRenderer::fitTarget(const Camera& camera) {
  if (target_ && target_->width() == camera.width && target_->height() == camera.height) return std::nullopt;
  auto target = RasterTarget::create(*context_, camera.width, camera.height, kColours);
  if (!target) return target.error();
  target_ = *std::move(target);
  readBacks_.clear();
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  for (const std::size_t bytes : kColourBytes) {
    auto buffer = GpuBuffer::create(*context_, BufferUse::readBack, bytes * pixels);
    if (!buffer) return buffer.error();
    readBacks_.push_back(*std::move(buffer));
  }
  return std::nullopt;
}

void SceneRenderer::fillVertices(std::span<const PosedObject> posed, std::span<const LightMarker> markers) {
  const std::span<DrawVertex> all = vertices_->as<DrawVertex>();
  for (std::size_t i = 0; i < drawn_.size(); ++i) drawn_[i].draws.fill(posed[i], &all[drawn_[i].firstVertex]);
  DrawVertex* out = all.data() + objectVertices_;
  for (const LightMarker& marker : markers) {
    const glm::vec3 centre = toGlm(marker.centre), emission{marker.emission.r, marker.emission.g, marker.emission.b};
    const glm::mat3 shape = marker.radius * shapeOf(marker);
    for (const DrawVertex& v : ball_) {
      const bool isDark = marker.isDisk() && !marker.twoSided && v.position.y < -kBallEquator;
      *out++ = {centre + shape * v.position, v.normal, isDark ? glm::vec3(0) : emission, v.triangle};
    }
  }
}

std::optional<Error> SceneRenderer::listDraws(const LightSet& lights, std::size_t markers) {
  list_.clear();
  effects_ = {};
  buffers_.begin();
  allLights_.clear();
  for (int i = 0; i < lights.size(); ++i)
    lights.visit(i, [&](const auto& light) { allLights_.push_back(nearLight(light)); });
  const ShadingPlace everyLight = buffers_.place(allLights_);
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    Drawn& drawn = drawn_[i];
    ShadingPlace place = everyLight;
    GpuRig packed;
    if (drawn.rig != nullptr) place = buffers_.pack(drawn.rigIndex, *drawn.rig);
    for (const DrawRange& range : drawn.draws.ranges()) {
      const Effects near = nearKinds(lights, range.wrap);
      const ShaderVariant variant =
          drawn.rig != nullptr ? variantOf(*drawn.rig, place.packed, drawn.rig->effects(range.wrap), near)
                               : nearVariant(options_.bands, near);
      const GpuPipeline* pipeline = pipelineOf(variant, isPerVertex(drawn));
      if (pipeline == nullptr) return Error{"an effect that was not prepared for", drawn.object->name};
      if (drawn.rig != nullptr) effects_.add(variant.effects);
      list_.push_back({pipeline,
                       &buffers_.bindings(drawn.rig != nullptr ? drawn.rigIndex : 0),
                       {place.rig, buffers_.material(range.wrap)},
                       drawn.firstVertex + range.first,
                       range.count,
                       static_cast<std::uint32_t>(i + 1),
                       drawn.rig != nullptr ? 1 : kSceneryDimming,
                       place.firstNear,
                       place.nearCount,
                       drawn.rig != nullptr});
    }
  }
  if (markers > 0)
    list_.push_back({&*flat_,
                     &buffers_.bindings(0),
                     {},
                     objectVertices_,
                     static_cast<std::uint32_t>(markers * ball_.size()),
                     static_cast<std::uint32_t>(drawn_.size() + 1),
                     1,
                     0,
                     0,
                     false});
  return std::nullopt;
}

void SceneRenderer::record(const Camera& camera, const Draw& draw, const GpuPipeline& pipeline) {
  DrawConstants constants;
  const float focal = 1 / camera.tanHalfFov;
  const float aspect = static_cast<float>(camera.width) / static_cast<float>(camera.height);
  constants.right = glm::vec4(camera.axes[0] * (focal / aspect), 0);
  constants.up = glm::vec4(camera.axes[1] * focal, 0);
  constants.back = glm::vec4(camera.axes[2], 0);
  constants.eye = camera.eye;
  constants.nearPlane = kNearPlane * camera.focus;
  constants.part = draw.part;
  constants.radianceScale = draw.radianceScale;
  constants.firstNear = draw.firstNear;
  constants.nearCount = draw.nearCount;
  commands_.bind(pipeline, *draw.bindings, draw.offsets);
  commands_.push(std::as_bytes(std::span(&constants, 1)));
  commands_.bindVertices(0, *vertices_);
  commands_.draw(draw.vertices, draw.firstVertex);
}

/// Draws the list, all of it or what has a rig by one pipeline if there is one `instead`.
Result<double> SceneRenderer::run(const Camera& camera, const GpuPipeline* instead, bool rigsAlone) {
  if (auto error = commands_.begin()) return *error;
  buffers_.upload(commands_);
  const int start = commands_.mark();
  commands_.beginPass(*target_, kClear);
  for (const Draw& draw : list_)
    record(camera, draw, instead != nullptr && (draw.hasRig || !rigsAlone) ? *instead : *draw.pipeline);
  commands_.endPass();
  const int end = commands_.mark();
  for (std::size_t i = 0; i < readBacks_.size(); ++i) commands_.read(target_->colours()[i], readBacks_[i]);
  if (auto error = commands_.run()) return *error;
  return 1e3 * commands_.seconds(start, end);
}

Result<RenderedFrame> SceneRenderer::render(const Camera& camera, std::span<const PosedObject> posed,
                                            const LightSet& lights, std::span<const LightMarker> markers) {
  if (auto error = fitTarget(camera)) return *error;
  if (auto error = makeRoom(markers.size())) return *error;
  fillVertices(posed, markers);
  if (auto error = listDraws(lights, markers.size())) return *error;
  const auto milliseconds = run(camera, nullptr);
  if (!milliseconds) return milliseconds.error();

  RenderedFrame frame;
  frame.width = camera.width;
  frame.height = camera.height;
  frame.milliseconds = *milliseconds;
  frame.radiance = threeOfFour<Rgb>(readBacks_[0]);
  frame.irradiance = threeOfFour<Rgb>(readBacks_[1]);
  for (const glm::uvec2 surface : readBacks_[2].as<glm::uvec2>()) {
    frame.part.push_back(surface.x);
    frame.triangle.push_back(surface.y);
  }
  return frame;
}

Result<double> SceneRenderer::unlitMilliseconds(const Camera& camera) { return run(camera, &*flat_, true); }

Result<RenderedPoints> SceneRenderer::points(const Camera& camera) {
  assert(surface_);
  const auto milliseconds = run(camera, &*surface_);
  if (!milliseconds) return milliseconds.error();
  return RenderedPoints{threeOfFour<glm::vec3>(readBacks_[0]), threeOfFour<glm::vec3>(readBacks_[1])};
}

}  // namespace rigel::tools
