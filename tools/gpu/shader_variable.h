// The inputs and outputs of a ShaderFunction, and the GLSL that moves them between buffers and variables.
#pragma once

#include <rigel/result.h>

#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// A declaration such as "vec3 n" or "float w[12]".
struct ShaderVariable {
  std::string type;
  std::string name;
  int components = 1;  // of the type
  int elements = 0;    // of the array; 0: none

  bool isInteger() const { return type == "int"; }
  int floats() const { return components * (elements > 0 ? elements : 1); }
  /// "vec3 n", "float w[12]".
  std::string declaration() const;
};

/// An error quotes what is not a declaration of float, int, vec2, vec3, vec4 or an array of one.
Result<std::vector<ShaderVariable>> parseShaderVariables(std::span<const std::string> declarations);

int floatsOf(std::span<const ShaderVariable> variables);

/// Statements that declare the variables and fill them from the array `from`, starting at the index in variable `at`.
std::string glslLoads(std::span<const ShaderVariable> variables, const std::string& from, const std::string& at);
/// Statements that declare the variables, set to NaN or INT_MIN.
std::string glslUnset(std::span<const ShaderVariable> variables);
/// Statements that put the variables into the array `to`.
std::string glslStores(std::span<const ShaderVariable> variables, const std::string& to, const std::string& at);

}  // namespace rigel::tools
