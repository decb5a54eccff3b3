// Drawing: where pixels land, what they hold, and what is refused.
#include "gpu/commands.h"
#include "gpu/gpu_test.h"

#include <gmock/gmock.h>

#include <array>

namespace rigel::test {
namespace {

using namespace tools;
using ::testing::HasSubstr;

constexpr std::array kFormats = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_UINT};

std::vector<std::uint32_t> compiled(ShaderKind kind, const std::string& text) {
  const ShaderText part{"shader", "#version 450\n" + text};
  return must(compileShader(kind, std::span(&part, 1), std::array{shaderLibrary()})).spirv;
}

/// What a drawing left behind, row by row from the top.
struct Picture {
  int width, height;
  std::vector<std::array<float, 4>> colour;
  std::vector<std::uint32_t> id;
  std::vector<float> depth;

  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
};

template <class T>
std::vector<T> content(GpuBuffer& buffer) {
  return {buffer.as<T>().begin(), buffer.as<T>().end()};
}

/// Draws with what `record` binds into a target of kFormats.
template <class Record>
Picture drawn(const RasterTarget& target, const Record& record) {
  const auto pixels = static_cast<std::size_t>(target.width() * target.height());
  GpuBuffer colour = must(GpuBuffer::create(gpu(), BufferUse::readBack, pixels * 16));
  GpuBuffer id = must(GpuBuffer::create(gpu(), BufferUse::readBack, pixels * 4));
  GpuBuffer depth = must(GpuBuffer::create(gpu(), BufferUse::readBack, pixels * 4));
  GpuCommands commands = must(GpuCommands::create(gpu()));
  must(commands.begin());
  std::array<VkClearColorValue, 2> clear{};
  clear[0] = {.float32 = {-1, -2, -3, -4}};
  clear[1] = {.uint32 = {0xffffffffu, 0, 0, 0}};
  const int before = commands.mark();
  commands.beginPass(target, clear);
  record(commands);
  commands.endPass();
  const int after = commands.mark();
  commands.read(target.colours()[0], colour);
  commands.read(target.colours()[1], id);
  commands.read(target.depth(), depth);
  must(commands.run());
  EXPECT_GT(commands.seconds(before, after), 0);
  return {target.width(), target.height(), content<std::array<float, 4>>(colour), content<std::uint32_t>(id),
          content<float>(depth)};
}

const char* const kPositionOnly = R"(
layout(location = 0) in vec3 position;
layout(location = 0) flat out uint triangle;
void main() { gl_Position = vec4(position, 1.0); triangle = uint(gl_VertexIndex) / 3u; }
)";

const char* const kIdAndPlace = R"(
layout(location = 0) flat in uint triangle;
layout(location = 0) out vec4 colour;
layout(location = 1) out uint id;
void main() { colour = vec4(gl_FragCoord.xyz, 1.0); id = triangle; }
)";

const std::array<VertexStream, 1> kPositions = {VertexStream{12, {{0, VK_FORMAT_R32G32B32_SFLOAT, 0}}}};

/// Triangles of positions in clip space.
Picture drawnTriangles(std::vector<float> positions, const RasterState& state) {
  const RasterTarget target = must(RasterTarget::create(gpu(), 8, 4, kFormats));
  const GpuLayout layout = must(GpuLayout::create(gpu(), {}));
  const GpuBindings bindings = must(GpuBindings::create(gpu(), layout));
  const auto vertex = compiled(ShaderKind::vertex, kPositionOnly);
  const auto fragment = compiled(ShaderKind::fragment, kIdAndPlace);
  const GpuPipeline pipeline =
      must(GpuPipeline::raster(gpu(), layout, {vertex}, {fragment}, kPositions, target, state));
  const GpuBuffer vertices = must(GpuBuffer::of<float>(gpu(), BufferUse::vertices, positions));
  return drawn(target, [&](GpuCommands& commands) {
    commands.bind(pipeline, bindings);
    commands.bindVertices(0, vertices);
    commands.draw(static_cast<std::uint32_t>(positions.size() / 3));
  });
}

/// Two triangles over a rectangle, counter-clockwise with y up.
std::vector<float> rectangle(float x0, float y0, float x1, float y1, float z) {
  return {x0, y0, z, x1, y0, z, x1, y1, z, x0, y0, z, x1, y1, z, x0, y1, z};
}

TEST(Raster, PutsYUpAndClearsTheRest) {
  // The upper half of the picture.
  const Picture picture = drawnTriangles(rectangle(-1, 0, 1, 1, 0.25f), {});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const auto colour = picture.colour[picture.at(x, y)];
      if (y < 2) {
        const std::array<float, 4> expected = {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0.25f, 1};
        EXPECT_EQ(colour, expected);
        EXPECT_LE(picture.id[picture.at(x, y)], 1u);
        EXPECT_EQ(picture.depth[picture.at(x, y)], 0.25f);
      } else {
        EXPECT_EQ(colour, (std::array<float, 4>{-1, -2, -3, -4}));
        EXPECT_EQ(picture.id[picture.at(x, y)], 0xffffffffu);
        EXPECT_EQ(picture.depth[picture.at(x, y)], 1);
      }
    }
  }
}

TEST(Raster, TheNearerWins) {
  auto positions = rectangle(-1, -1, 1, 1, 0.5f);
  const auto nearer = rectangle(-1, -1, 0, 1, 0.25f), farther = rectangle(0, -1, 1, 1, 0.75f);
  positions.insert(positions.end(), nearer.begin(), nearer.end());
  positions.insert(positions.end(), farther.begin(), farther.end());
  const Picture tested = drawnTriangles(positions, {});
  const Picture untested = drawnTriangles(positions, {.depthTest = false});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(tested.id[tested.at(x, y)] / 2, x < 4 ? 1u : 0u);
      EXPECT_EQ(untested.id[tested.at(x, y)] / 2, x < 4 ? 1u : 2u);
    }
  }
}

TEST(Raster, CullsClockwiseTriangles) {
  auto positions = rectangle(-1, -1, 0, 1, 0.5f);
  const std::vector<float> away = {0, -1, 0.5f, 1, 1, 0.5f, 1, -1, 0.5f};
  positions.insert(positions.end(), away.begin(), away.end());
  const auto covered = [](const Picture& picture, std::uint32_t id) { return std::ranges::count(picture.id, id); };
  const Picture all = drawnTriangles(positions, {});
  EXPECT_GT(covered(all, 2), 0);
  const Picture culled = drawnTriangles(positions, {.cullBack = true});
  EXPECT_EQ(covered(culled, 2), 0);
  EXPECT_EQ(covered(culled, 0), covered(all, 0));
}

TEST(Raster, FragmentsSeeConstantsUniformsTexelsTexturesAndPushes) {
  const auto vertex = compiled(ShaderKind::vertex, R"(
layout(constant_id = 3) const float kDepth = 0.0;
layout(location = 0) in vec2 position;
layout(location = 1) in float shift;
void main() { gl_Position = vec4(position + vec2(shift, 0.0), kDepth, 1.0); }
)");
  const auto fragment = compiled(ShaderKind::fragment, R"(
layout(constant_id = 7) const int kTexel = 0;
layout(constant_id = 8) const bool kTwice = false;
layout(binding = 1) uniform Character { vec4 tint; };
layout(binding = 2) uniform samplerBuffer texels;
layout(binding = 5) uniform sampler3D textures[2];
layout(push_constant) uniform Push { float pushed; };
layout(location = 0) out vec4 colour;
layout(location = 1) out uint id;
void main() {
  colour = vec4(tint.x, texelFetch(texels, kTexel).y, textureLod(textures[1], vec3(0.5), 0.0).z, pushed);
  if (kTwice) colour *= 2.0;
  id = 1u;
}
)");
  using Kind = BindingSlot::Kind;
  const std::array<BindingSlot, 3> slots = {{{1, Kind::uniformDynamic}, {2, Kind::texels}, {5, Kind::texture, 2}}};
  const GpuLayout layout = must(GpuLayout::create(gpu(), slots, sizeof(float)));
  const RasterTarget target = must(RasterTarget::create(gpu(), 2, 1, kFormats));
  const std::array vertexConstants = {shaderConstant(3, 0.5f)};
  const std::array fragmentConstants = {shaderConstant(7, 1), shaderConstant(8, true)};
  const std::array<VertexStream, 2> streams = {VertexStream{8, {{0, VK_FORMAT_R32G32_SFLOAT, 0}}},
                                               VertexStream{4, {{1, VK_FORMAT_R32_SFLOAT, 0}}, true}};
  const int modules = gpu().shaderModulesCreated(), pipelines = gpu().pipelinesCreated();
  const GpuPipeline pipeline = must(
      GpuPipeline::raster(gpu(), layout, {vertex, vertexConstants}, {fragment, fragmentConstants}, streams, target));
  EXPECT_EQ(gpu().shaderModulesCreated(), modules + 2);
  EXPECT_EQ(gpu().pipelinesCreated(), pipelines + 1);

  const std::size_t stride = gpu().uniformStride(16);
  GpuBuffer characters = must(GpuBuffer::create(gpu(), BufferUse::uniform, stride + 16));
  characters.as<float>()[0] = 10;
  characters.as<float>()[stride / 4] = 20;
  const GpuBuffer texels = must(GpuBuffer::of<float>(gpu(), BufferUse::texels, std::array<float, 8>{0, 0, 0, 0, 0, 3}));
  std::array<float, 4> four = {4, 4, 4, 4};
  const Texture3d texture = must(Texture3d::create(gpu(), {1, 1, 1}, TextureFormat::rgba16f, four));
  GpuBindings bindings = must(GpuBindings::create(gpu(), layout));
  must(bindings.set(1, characters, 16));
  must(bindings.set(2, texels));
  must(bindings.set(5, texture, 0));
  must(bindings.set(5, texture, 1));
  // The left half, moved by the second stream to the right one.
  const GpuBuffer vertices =
      must(GpuBuffer::of<float>(gpu(), BufferUse::vertices, std::array<float, 8>{-1, -1, 0, -1, 0, 1, -1, 1}));
  const GpuBuffer shifts = must(GpuBuffer::of<float>(gpu(), BufferUse::vertices, std::array<float, 2>{0, 1}));
  const GpuBuffer indices =
      must(GpuBuffer::of<std::uint32_t>(gpu(), BufferUse::indices, std::array<std::uint32_t, 6>{0, 1, 2, 0, 2, 3}));
  const Picture picture = drawn(target, [&](GpuCommands& commands) {
    const std::array<float, 1> pushed = {6};
    for (std::uint32_t i = 0; i < 2; ++i) {
      commands.bind(pipeline, bindings, std::array{i * static_cast<std::uint32_t>(stride)});
      commands.push(std::as_bytes(std::span(pushed)));
      commands.bindVertices(0, vertices);
      commands.bindVertices(1, shifts, i * sizeof(float));
      commands.bindIndices(indices);
      commands.drawIndexed(6);
    }
  });
  EXPECT_EQ(picture.colour[0], (std::array<float, 4>{20, 6, 8, 12}));
  EXPECT_EQ(picture.colour[1], (std::array<float, 4>{40, 6, 8, 12}));
  EXPECT_EQ(picture.depth[0], 0.5f);
}

TEST(Raster, RefusesWhatTheDeviceCannotDraw) {
  const auto errorOf = [](int width, int height, std::span<const VkFormat> formats) {
    const auto target = RasterTarget::create(gpu(), width, height, formats);
    return target ? std::string("created") : target.error().message;
  };
  EXPECT_THAT(errorOf(1 << 20, 4, kFormats), HasSubstr("a picture of 1048576 x 4: the device takes"));
  EXPECT_THAT(errorOf(0, 4, kFormats), HasSubstr("0 x 4"));
  EXPECT_THAT(errorOf(-4, 4, kFormats), HasSubstr("0 x 4"));
  EXPECT_THAT(errorOf(4, 4, std::vector<VkFormat>(1000, VK_FORMAT_R32_UINT)), HasSubstr("1000 images to draw to"));
  EXPECT_THAT(errorOf(4, 4, std::array{VK_FORMAT_E5B9G9R9_UFLOAT_PACK32}), HasSubstr("does not draw to images of"));
}

}  // namespace
}  // namespace rigel::test
