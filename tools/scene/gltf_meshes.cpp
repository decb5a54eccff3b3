// Meshes: attributes, triangle lists out of lists, strips and fans, morph targets, skin influences.
#include "scene/gltf_import.h"

#include <cmath>

namespace rigel::tools {
namespace {

constexpr unsigned kQuantized = kNormalizedInt8 | kNormalizedInt16 | kPlainInt8 | kPlainInt16;

std::vector<glm::vec3> toVec3(const std::vector<float>& flat) {
  std::vector<glm::vec3> out(flat.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return out;
}

class MeshReader {
 public:
  explicit MeshReader(GltfImport& import) : import_(import), materials_(import.scene.materials.size()) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      for (const JsonPlace& name : import.document.root().items(list)) {
        if (name.asText() == "KHR_mesh_quantization") quantized_ = kQuantized;
      }
    }
  }

  void read(const JsonPlace& place) {
    Mesh mesh;
    mesh.name = readName(place);
    std::optional<std::size_t> targets;
    for (const JsonPlace& primitive : place.items("primitives", true)) {
      std::optional<Primitive> read = readPrimitive(primitive);
      if (!read) continue;
      if (targets.value_or(read->targets.size()) != read->targets.size()) {
        primitive.fail("has {} morph targets, the mesh's other primitives have {}", read->targets.size(), *targets);
      }
      targets = read->targets.size();
      mesh.primitives.push_back(std::move(*read));
    }
    mesh.morphWeights.assign(targets.value_or(0), 0.f);
    if (targets) place.numbers("weights", *targets, mesh.morphWeights.data());
    import_.scene.meshes.push_back(std::move(mesh));
  }

 private:
  // Element count of an attribute, compared with the primitive's vertex count.
  int attribute(const JsonPlace& owner, std::string_view name, std::size_t vertices) const {
    const int accessor = owner.requiredIndex(name, import_.accessors.count(), "accessor");
    const std::size_t count = import_.accessors.elements(accessor);
    if (vertices != 0 && count != vertices) {
      owner.member(name).fail("accessor {} has {} elements, POSITION has {}", accessor, count, vertices);
    }
    return accessor;
  }

  std::vector<glm::vec3> vectors(const JsonPlace& owner, std::string_view name, std::size_t vertices, unsigned extra) {
    const int accessor = attribute(owner, name, vertices);
    return toVec3(import_.accessors.floats(owner.member(name), accessor, 3, kFloat | extra));
  }

  // Draco leaves accessors without data behind, which glTF otherwise reads as zeros.
  void refuseCompressed(const JsonPlace& place, const JsonPlace& attributes) const {
    const auto extensions = place.find("extensions");
    if (!extensions || !extensions->has("KHR_draco_mesh_compression")) return;
    const int position = attributes.requiredIndex("POSITION", import_.accessors.count(), "accessor");
    if (!import_.accessors.hasData(position))
      place.fail("is compressed by KHR_draco_mesh_compression, which Rigel does not read");
  }

  std::optional<Primitive> readPrimitive(const JsonPlace& place) {
    const std::size_t mode = place.size("mode", 4);
    if (mode > 6) place.member("mode").fail("{} is none of glTF's", mode);
    const JsonPlace attributes = place.member("attributes");
    if (mode < 4) {
      checkInfluences(attributes);
      import_.note("{}: {} ignored: only triangles are lit", place.path(), mode == 0 ? "points" : "lines");
      return std::nullopt;
    }
    if (!attributes.has("POSITION")) {
      checkInfluences(attributes);
      if (const auto extensions = place.find("extensions")) {
        for (const auto& [name, value] : extensions->members())
          place.fail("has no POSITION but {}, not supported", name);
      }
      import_.note("{}: ignored: has no POSITION", place.path());
      return std::nullopt;
    }
    refuseCompressed(place, attributes);
    Primitive out;
    out.positions = vectors(attributes, "POSITION", 0, quantized_);
    const std::size_t vertices = out.positions.size();
    if (attributes.has("NORMAL")) {
      out.normals = vectors(attributes, "NORMAL", vertices, quantized_ & (kNormalizedInt8 | kNormalizedInt16));
    }
    out.material = place.index("material", materials_, "material");
    readTriangles(place, mode, vertices, out.triangles);
    if (out.triangles.empty()) {
      import_.note("{}: ignored: has no triangle", place.path());
      return std::nullopt;
    }
    readInfluences(attributes, vertices, out.influences);
    for (const JsonPlace& target : place.items("targets")) {
      MorphTarget morph;
      if (!target.has("POSITION")) import_.accessors.reserve(target, 3 * vertices);
      if (target.has("POSITION")) morph.positions = vectors(target, "POSITION", vertices, quantized_);
      if (target.has("NORMAL")) {
        if (out.normals.empty()) target.member("NORMAL").fail("the primitive itself has no NORMAL");
        morph.normals = vectors(target, "NORMAL", vertices, quantized_ & (kNormalizedInt8 | kNormalizedInt16));
      }
      if (morph.positions.empty()) morph.positions.assign(vertices, glm::vec3(0));
      out.targets.push_back(std::move(morph));
    }
    return out;
  }

  std::vector<std::uint32_t> readIndices(const JsonPlace& place, std::size_t vertices) {
    const int accessor = place.index("indices", import_.accessors.count(), "accessor");
    std::vector<std::uint32_t> indices;
    if (accessor < 0) {
      indices.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) indices[i] = static_cast<std::uint32_t>(i);
      return indices;
    }
    const JsonPlace user = place.member("indices");
    indices = import_.accessors.integers(user, accessor, 1, kUnsigned8 | kUnsigned16 | kUnsigned32);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (import_.accessors.isMaxIndex(accessor, indices[i])) {
        user.fail("accessor {} holds the primitive-restart value {} in element {}", accessor, indices[i], i);
      }
      if (indices[i] >= vertices) {
        user.fail("accessor {} holds index {} in element {}, there are {} vertices", accessor, indices[i], i, vertices);
      }
    }
    return indices;
  }

  void readTriangles(const JsonPlace& place, std::size_t mode, std::size_t vertices, std::vector<glm::uvec3>& out) {
    const std::vector<std::uint32_t> i = readIndices(place, vertices);
    const auto addUnlessStitch = [&](glm::uvec3 t) {
      if (t.x != t.y && t.y != t.z && t.z != t.x) out.push_back(t);  // strips are joined by triangles without area
    };
    if (mode == 4) {
      for (std::size_t k = 0; k + 2 < i.size(); k += 3) out.emplace_back(i[k], i[k + 1], i[k + 2]);
      if (i.size() % 3 != 0) import_.note("{}: {} left-over indices ignored", place.path(), i.size() % 3);
    } else if (mode == 5) {
      for (std::size_t k = 0; k + 2 < i.size(); ++k) {
        addUnlessStitch(k % 2 == 0 ? glm::uvec3(i[k], i[k + 1], i[k + 2]) : glm::uvec3(i[k + 1], i[k], i[k + 2]));
      }
    } else {
      for (std::size_t k = 1; k + 1 < i.size(); ++k) addUnlessStitch({i[0], i[k], i[k + 1]});
    }
  }

  // Of a primitive that is ignored for another reason.
  void checkInfluences(const JsonPlace& attributes) {
    if (!attributes.has("JOINTS_0")) return;
    std::vector<Influences> unused;
    const int accessor = attributes.requiredIndex("JOINTS_0", import_.accessors.count(), "accessor");
    readInfluences(attributes, import_.accessors.elements(accessor), unused);
  }

  void readInfluences(const JsonPlace& attributes, std::size_t vertices, std::vector<Influences>& out) {
    if (attributes.has("JOINTS_2")) import_.note("{}/JOINTS_2: ignored: more than 8 influences", attributes.path());
    for (std::size_t set = 0; set < 2; ++set) {
      const std::string joints = fmt::format("JOINTS_{}", set), weights = fmt::format("WEIGHTS_{}", set);
      if (attributes.has(joints) != attributes.has(weights)) {
        attributes.fail("has {} without {}", attributes.has(joints) ? joints : weights,
                        attributes.has(joints) ? weights : joints);
      }
      if (!attributes.has(joints)) break;
      const auto j = import_.accessors.integers(attributes.member(joints), attribute(attributes, joints, vertices), 4,
                                                kUnsigned8 | kUnsigned16);
      const auto w = import_.accessors.floats(attributes.member(weights), attribute(attributes, weights, vertices), 4,
                                              kFloat | kNormalizedInt8 | kNormalizedInt16);
      out.resize(vertices);
      for (std::size_t k = 0; k < 4 * vertices; ++k) {
        if (w[k] < 0) attributes.member(weights).fail("vertex {} has the negative weight {}", k / 4, w[k]);
        // The joint of an influence without weight means nothing and may be any number.
        out[k / 4].joint[4 * set + k % 4] = w[k] > 0 ? static_cast<std::uint16_t>(j[k]) : std::uint16_t{0};
        out[k / 4].weight[4 * set + k % 4] = w[k];
      }
    }
    normalizeWeights(attributes, out);
  }

  void normalizeWeights(const JsonPlace& attributes, std::vector<Influences>& influences) {
    // Eight rounded floats that sum to 1 are off by at most 2.4e-7; leaving these alone makes loading idempotent.
    constexpr double kAlreadyOne = 1e-6;
    std::size_t weightless = 0, rescaled = 0;
    for (Influences& in : influences) {
      double sum = 0;
      for (const float w : in.weight) sum += w;
      if (sum == 0) {
        in.weight[0] = 1;
        ++weightless;
      } else if (std::abs(sum - 1) > kAlreadyOne) {
        for (float& w : in.weight) w = static_cast<float>(w / sum);
        if (std::abs(sum - 1) > 0.02) ++rescaled;  // what 8-bit weights are off by is no news
      }
    }
    if (weightless > 0) {
      import_.note("{}: {} vertices without weights follow joint 0", attributes.path(), weightless);
    }
    if (rescaled > 0)
      import_.note("{}: weights of {} vertices did not sum to 1; rescaled", attributes.path(), rescaled);
  }

  GltfImport& import_;
  std::size_t materials_;
  unsigned quantized_ = 0;
};

}  // namespace

void importMeshes(GltfImport& import) {
  MeshReader reader(import);
  for (const JsonPlace& mesh : import.document.root().items("meshes")) reader.read(mesh);
}

}  // namespace rigel::tools
