// glTF's names for accessors of so many components.
#pragma once

namespace rigel::tools {

constexpr const char* accessorType(int components) noexcept {
  switch (components) {
    case 1:
      return "SCALAR";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    default:
      return "MAT4";
  }
}

}  // namespace rigel::tools
