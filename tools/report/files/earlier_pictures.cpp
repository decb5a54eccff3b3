#include "report/files/earlier_pictures.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <system_error>

namespace rigel::tools {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// The elements of array `name`; none where there is no such array.
const Json& listIn(const Json& object, const char* name) {
  static const Json kNone = Json::array();
  if (!object.is_object()) return kNone;
  const auto found = object.find(name);
  return found != object.end() && found->is_array() ? *found : kNone;
}

/// The file's name, or "" where `path` is not that of a picture straight in the folder.
std::string pictureName(const std::string& path) {
  const std::string folder = std::string(kImageFolder) + "/";
  if (!path.starts_with(folder)) return "";
  const std::string name = path.substr(folder.size());
  const bool picture = name.ends_with(".png") || name.ends_with(".exr");
  return picture && name.find('/') == std::string::npos && name.find('\0') == std::string::npos ? name : "";
}

}  // namespace

std::set<std::string> picturesNamedIn(std::string_view document) {
  std::set<std::string> names;
  const Json json = Json::parse(document, nullptr, false);
  for (const Json& object : listIn(json, "objects"))
    for (const Json& picture : listIn(object, "pictures"))
      for (const char* key : {"image_png", "image_exr", "error_png", "error_exr"}) {
        if (!picture.is_object() || !picture.contains(key) || !picture[key].is_string()) continue;
        if (std::string name = pictureName(picture[key].get<std::string>()); !name.empty())
          names.insert(std::move(name));
      }
  return names;
}

std::set<std::string> earlierPictures(const fs::path& report) { return picturesNamed(report / "report.json", report); }

std::set<std::string> picturesNamed(const fs::path& document, const fs::path& report) {
  std::ifstream stream(document, std::ios::binary);
  if (!stream) return {};
  std::set<std::string> names = picturesNamedIn(std::string(std::istreambuf_iterator<char>(stream), {}));
  // A link is not what we wrote, even under the name of what we wrote.
  std::error_code code;
  std::erase_if(names, [&](const std::string& name) {
    return !fs::is_regular_file(fs::symlink_status(report / kImageFolder / name, code));
  });
  return names;
}

}  // namespace rigel::tools
