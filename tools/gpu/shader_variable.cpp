#include "gpu/shader_variable.h"

#include <functional>
#include <map>
#include <regex>

namespace rigel::tools {
namespace {

const std::map<std::string, int> kComponents = {{"float", 1}, {"int", 1}, {"vec2", 2}, {"vec3", 3}, {"vec4", 4}};

Result<ShaderVariable> parseOne(const std::string& declaration) {
  static const std::regex kForm(R"(\s*(\w+)\s+([A-Za-z]\w*)\s*(\[\s*([1-9]\d{0,5})\s*\])?\s*;?\s*)");
  std::smatch match;
  if (!std::regex_match(declaration, match, kForm) || !kComponents.contains(match[1])) {
    return Error{"not a declaration of a float, int, vec2, vec3, vec4 or an array of them", "\"" + declaration + "\""};
  }
  ShaderVariable variable;
  variable.type = match[1];
  variable.name = match[2];
  variable.components = kComponents.at(variable.type);
  if (match[4].matched) variable.elements = std::stoi(match[4]);
  return variable;
}

/// Calls visit(element, offset) with GLSL for every element of every variable and the offset of its first float.
void forElements(std::span<const ShaderVariable> variables,
                 const std::function<void(const ShaderVariable&, const std::string&, int)>& visit) {
  int offset = 0;
  for (const ShaderVariable& v : variables) {
    for (int i = 0; i < std::max(v.elements, 1); ++i, offset += v.components) {
      visit(v, v.elements > 0 ? v.name + "[" + std::to_string(i) + "]" : v.name, offset);
    }
  }
}

std::string at(const std::string& array, const std::string& base, int offset) {
  return array + "[" + base + " + " + std::to_string(offset) + "u]";
}

}  // namespace

std::string ShaderVariable::declaration() const {
  return type + " " + name + (elements > 0 ? "[" + std::to_string(elements) + "]" : "");
}

Result<std::vector<ShaderVariable>> parseShaderVariables(std::span<const std::string> declarations) {
  std::vector<ShaderVariable> variables;
  for (const std::string& declaration : declarations) {
    auto variable = parseOne(declaration);
    if (!variable) return variable.error();
    variables.push_back(*std::move(variable));
  }
  return variables;
}

int floatsOf(std::span<const ShaderVariable> variables) {
  int sum = 0;
  for (const ShaderVariable& v : variables) sum += v.floats();
  return sum;
}

std::string glslLoads(std::span<const ShaderVariable> variables, const std::string& from, const std::string& base) {
  std::string text;
  for (const ShaderVariable& v : variables) text += "  " + v.declaration() + ";\n";
  forElements(variables, [&](const ShaderVariable& v, const std::string& element, int offset) {
    std::string values;
    for (int c = 0; c < v.components; ++c) values += (c > 0 ? ", " : "") + at(from, base, offset + c);
    text += "  " + element + " = " + v.type + "(" + values + ");\n";
  });
  return text;
}

std::string glslUnset(std::span<const ShaderVariable> variables) {
  std::string text;
  for (const ShaderVariable& v : variables) text += "  " + v.declaration() + ";\n";
  forElements(variables, [&](const ShaderVariable& v, const std::string& element, int) {
    const std::string nan = v.type + "(uintBitsToFloat(0x7fc00000u))";
    text += "  " + element + " = " + (v.isInteger() ? "int(0x80000000u)" : nan) + ";\n";
  });
  return text;
}

std::string glslStores(std::span<const ShaderVariable> variables, const std::string& to, const std::string& base) {
  std::string text;
  forElements(variables, [&](const ShaderVariable& v, const std::string& element, int offset) {
    for (int c = 0; c < v.components; ++c) {
      const std::string component = v.components > 1 ? "[" + std::to_string(c) + "]" : "";
      text += "  " + at(to, base, offset + c) + " = float(" + element + component + ");\n";
    }
  });
  return text;
}

}  // namespace rigel::tools
