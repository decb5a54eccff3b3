// What the glTF validator says of a file (FILE.report.json beside it), and which of its errors concern Rigel.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace rigel::test {

struct ValidatorError {
  std::string code, pointer;
};

/// Errors in what Rigel does not read or read all the same, each with its reason. `where` is a part of the JSON
/// pointer.
struct Unread {
  std::string_view code, where, reason;
};
inline constexpr Unread kUnread[] = {
    {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "", "min and max are computed where they are needed"},
    {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "", "min and max are computed where they are needed"},
    {"ACCESSOR_MAX_MISMATCH", "", "min and max are computed where they are needed"},
    {"ACCESSOR_MIN_MISMATCH", "", "min and max are computed where they are needed"},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", "", "min and max are computed where they are needed"},
    {"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", "", "min and max are computed where they are needed"},
    {"EMPTY_ENTITY", "/children", "an empty list says what none says"},
    {"CAMERA_XMAG_YMAG_ZERO", "/cameras", "cameras are not read"},
    {"ONE_OF_MISMATCH", "/cameras", "cameras are not read"},
    {"IMAGE_DATA_INVALID", "/images", "images are not read"},
    {"IMAGE_UNEXPECTED_EOS", "/images", "images are not read"},
    {"INVALID_URI", "/images", "images are not read"},
    {"IO_ERROR", "/images", "images are not read"},
    {"UNRESOLVED_REFERENCE", "/images", "images are not read"},
    {"UNRESOLVED_REFERENCE", "/textures", "textures are not read"},
    {"UNRESOLVED_REFERENCE", "/emissiveTexture", "textures are not read"},
    {"UNRESOLVED_REFERENCE", "/normalTexture", "textures are not read"},
    {"MESH_PRIMITIVE_ACCESSOR_UNALIGNED", "/COLOR_0", "vertex colours are not read"},
    {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", "UNKNOWN", "attributes of unknown names are not read"},
    {"UNDECLARED_EXTENSION", "/EXT_undeclared_extension", "unknown extensions are not read"},
};

inline bool concernsRigel(const ValidatorError& error) {
  // Lists of the root ("/nodes") as much as those of children.
  if (error.code == "EMPTY_ENTITY" && error.pointer.rfind('/') == 0) return false;
  for (const Unread& unread : kUnread)
    if (unread.code == error.code && error.pointer.find(unread.where) != std::string::npos) return false;
  return true;
}

struct ValidatorReport {
  bool found = false;                  // is there a report?
  std::vector<ValidatorError> errors;  // severity 0
  bool concernsRigel() const {
    for (const ValidatorError& error : errors)
      if (test::concernsRigel(error)) return true;
    return false;
  }
  std::string codes() const {
    std::string text;
    for (const ValidatorError& error : errors) text += " " + error.code + " " + error.pointer;
    return text;
  }
};

inline ValidatorReport validatorReport(const std::filesystem::path& file) {
  ValidatorReport report;
  std::ifstream stream(file.string() + ".report.json");
  if (!stream) return report;
  report.found = true;
  const auto json = nlohmann::json::parse(stream);
  for (const auto& message : json["issues"]["messages"])
    if (message["severity"] == 0) report.errors.push_back({message["code"], message.value("pointer", "")});
  return report;
}

/// Valid files that Rigel refuses all the same.
inline bool isBeyondRigel(const std::filesystem::path& file) {
  return file.filename() == "min_version_valid.gltf";  // asks for glTF 2.1, which there is not
}

}  // namespace rigel::test
