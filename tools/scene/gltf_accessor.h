// Checked reading of accessors: formats, bounds, sparse substitution, normalised integers.
#pragma once

#include "scene/gltf_document.h"

#include <cstdint>
#include <vector>

namespace rigel::tools {

/// Which component types an attribute may have, as a set.
enum ComponentSet : unsigned {
  kFloat = 1,
  kNormalizedInt8 = 2,   // signed and unsigned
  kNormalizedInt16 = 4,  // signed and unsigned
  kPlainInt8 = 8,
  kPlainInt16 = 16,
  kUnsigned8 = 32,
  kUnsigned16 = 64,
  kUnsigned32 = 128,
};

class AccessorReader {
 public:
  explicit AccessorReader(const GltfDocument& document);

  int count() const noexcept;                                // how many accessors there are
  std::size_t elements(int accessor) const;                  // its element count
  bool hasData(int accessor) const;                          // or is it all zeros
  bool isMaxIndex(int accessor, std::uint32_t value) const;  // all bits set: primitive restart

  /// Counts `components` numbers that are stored without being read; throws where the file asks for absurdly many.
  void reserve(const JsonPlace& place, std::size_t components);

  /// All elements as floats, `width` components each (1, 3, 4 or 16); normalised integers are mapped to [0, 1] or
  /// [-1, 1]. `user` is the reference being followed; errors of format stand there, errors of layout at the accessor.
  std::vector<float> floats(const JsonPlace& user, int accessor, int width, unsigned allowed);

  /// All elements as unsigned integers.
  std::vector<std::uint32_t> integers(const JsonPlace& user, int accessor, int width, unsigned allowed);

 private:
  struct Layout;
  Layout layout(const JsonPlace& user, int accessor, int width, unsigned allowed);
  const unsigned char* viewData(const JsonPlace& place, int view, std::size_t offset,
                                [[maybe_unused]] std::size_t bytes) const;
  template <class Store>
  void forEachComponent(const Layout& layout, Store&& store) const;

  const GltfDocument& document_;
  std::vector<JsonPlace> places_;
  std::vector<JsonPlace> views_;
  std::size_t componentsLeft_ = 0;
};

}  // namespace rigel::tools
