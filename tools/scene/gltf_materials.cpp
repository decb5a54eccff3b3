// Extensions, and the little that Rigel takes from materials: base colour and wrap.
#include "scene/gltf_import.h"

#include <rigel/wrap.h>

#include <algorithm>
#include <set>

namespace rigel::tools {
namespace {

bool isUnderstood(std::string_view name) {
  return name == "KHR_lights_punctual" || name == "EXT_lights_area" || name == "KHR_mesh_quantization";
}

// Extensions that change nothing but the look of surfaces: a file that requires one still has its geometry for us.
bool concernsLookOnly(std::string_view name) {
  constexpr std::string_view kTextures[] = {"KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp",
                                            "EXT_texture_avif", "MSFT_texture_dds"};
  return name.starts_with("KHR_materials_") || std::ranges::find(kTextures, name) != std::end(kTextures);
}

// glTF wants at least one entry in every list that is there; an empty one says what none says.
void noteEmptyLists(GltfImport& import) {
  for (const auto& [name, value] : import.document.root().members()) {
    if (value.value().is_array() && value.value().empty())
      import.note("{}: an empty list, taken for none", value.path());
  }
}

glm::vec3 baseColour(const JsonPlace& material) {
  float rgba[4] = {1, 1, 1, 1};
  if (const auto pbr = material.find("pbrMetallicRoughness")) {
    pbr->numbers("baseColorFactor", 4, rgba);
    for (const float c : rgba) {
      if (c < 0 || c > 1) pbr->member("baseColorFactor").fail("must lie in [0, 1], has {}", c);
    }
  }
  return {rgba[0], rgba[1], rgba[2]};
}

}  // namespace

std::string readName(const JsonPlace& thing, std::string otherwise) {
  std::string name = thing.text("name");
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return name.empty() ? otherwise : name;
}

void importExtensions(GltfImport& import) {
  const JsonPlace root = import.document.root();
  std::set<std::string> required, used;
  for (const JsonPlace& extension : root.items("extensionsRequired")) {
    const std::string name = extension.asText();
    if (!isUnderstood(name) && !concernsLookOnly(name)) {
      extension.fail("the file requires {}, which Rigel does not read", name);
    }
    required.insert(name);
  }
  for (const JsonPlace& extension : root.items("extensionsUsed")) used.insert(extension.asText());
  used.insert(required.begin(), required.end());
  for (const std::string& name : used) {
    if (!isUnderstood(name)) import.note("extension {} ignored: not supported by this version", name);
  }
  if (const auto extensions = root.find("extensions")) {
    for (const auto& [name, value] : extensions->members()) {
      if (isUnderstood(name) && !used.contains(name))
        import.note("{} is not in extensionsUsed, but read", value.path());
    }
  }
  noteEmptyLists(import);
  if (const std::size_t cameras = root.items("cameras").size()) import.note("{} camera(s) ignored", cameras);
  if (root.has("textures")) import.note("textures ignored: colours are the materials' base colour factors");
}

void importMaterials(GltfImport& import) {
  for (const JsonPlace& place : import.document.root().items("materials")) {
    Material material;
    material.name = readName(place);
    material.baseColour = baseColour(place);
    float emissive[3] = {0, 0, 0};
    place.numbers("emissiveFactor", 3, emissive);
    if (emissive[0] + emissive[1] + emissive[2] > 0) {
      import.note("emission of material \"{}\" ignored: surfaces are no lights", material.name);
    }
    const auto extras = place.find("extras");
    if (extras && extras->value().is_object() && extras->has("wrap")) {
      const double wrap = extras->number("wrap", 0);
      if (wrap < kMinWrap || wrap > kMaxWrap) {
        extras->member("wrap").fail("must lie in [{}, {}], is {}", kMinWrap, kMaxWrap, wrap);
      }
      material.wrap = static_cast<float>(wrap);
    }
    import.scene.materials.push_back(std::move(material));
  }
}

}  // namespace rigel::tools
