#include "scene/gltf_layout.h"

#include <algorithm>
#include <string_view>

namespace rigel::tools {
namespace {

// Each costs some 2 KB while it is decoded; exports of whole factories stay below a tenth.
constexpr std::size_t kMaxEntries = std::size_t{1} << 19;

struct ElementType {
  std::string_view name;
  std::size_t rows, columns;
};
constexpr ElementType kElementTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
                                         {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

struct View {
  std::size_t byteOffset, byteLength;
  std::optional<std::size_t> stride;
};

std::vector<JsonPlace> entries(const JsonPlace& root, std::string_view key) {
  std::vector<JsonPlace> out = root.items(key);
  if (out.size() > kMaxEntries) root.member(key).fail("has {} entries, more than {}", out.size(), kMaxEntries);
  return out;
}

std::size_t checkBuffer(const JsonPlace& buffer) {
  const std::size_t byteLength = buffer.requiredSize("byteLength");
  if (byteLength == 0) buffer.member("byteLength").fail("must be at least 1");
  return byteLength;
}

View checkView(const JsonPlace& place, const std::vector<std::size_t>& bufferBytes) {
  const int buffer = place.requiredIndex("buffer", bufferBytes.size(), "buffer");
  View view{place.size("byteOffset", 0), place.requiredSize("byteLength"), std::nullopt};
  if (view.byteLength == 0) place.member("byteLength").fail("must be at least 1");
  if (view.byteOffset > bufferBytes[buffer] || view.byteLength > bufferBytes[buffer] - view.byteOffset) {
    place.fail("ends at byte {}, buffer {} has {}", view.byteOffset + view.byteLength, buffer, bufferBytes[buffer]);
  }
  if (const auto stride = place.find("byteStride")) {
    view.stride = stride->asSize();
    if (*view.stride < 4 || *view.stride > 252 || *view.stride % 4 != 0)
      stride->fail("must be a multiple of 4 from 4 to 252, is {}", *view.stride);
    if (*view.stride > view.byteLength) stride->fail("is {}, the view has {} bytes", *view.stride, view.byteLength);
  }
  return view;
}

// Bytes of a component type of glTF, 0 for numbers that are none.
std::size_t componentBytes(std::size_t type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 0, 4, 4};  // 5120 BYTE ... 5126 FLOAT; 5124 is a hole
  return type >= 5120 && type <= 5126 ? kBytes[type - 5120] : 0;
}

// Columns of matrices begin at multiples of 4 bytes.
std::size_t elementBytes(const ElementType& type, std::size_t component) {
  const std::size_t column = type.rows * component;
  return type.columns == 1 ? column : type.columns * ((column + 3) / 4 * 4);
}

void checkFits(const JsonPlace& place, std::size_t offset, std::size_t bytes, int number, const View& view) {
  if (offset > view.byteLength || bytes > view.byteLength - offset) {
    place.fail("needs bytes {} to {} of bufferView {}, which has {}", offset, offset + bytes, number, view.byteLength);
  }
}

void checkAligned(const JsonPlace& place, std::size_t offset, const View& view, std::size_t component) {
  if (offset % component != 0 || (offset + view.byteOffset) % component != 0)
    place.fail("is not aligned to its component size {}", component);
}

// Indices or values of a sparse accessor: `count` things without gaps.
void checkSparsePart(const JsonPlace& part, std::size_t count, std::size_t bytes, std::size_t component,
                     const std::vector<View>& views) {
  const int number = part.requiredIndex("bufferView", views.size(), "bufferView");
  const std::size_t offset = part.size("byteOffset", 0);
  if (offset > 0x7fffffff) part.member("byteOffset").fail("is beyond 2 GiB");  // tinygltf keeps it as int
  if (views[number].stride) part.fail("bufferView {} has a byteStride, which sparse data cannot have", number);
  checkFits(part, offset, count * bytes, number, views[number]);
  checkAligned(part, offset, views[number], component);
}

void checkSparse(const JsonPlace& sparse, std::size_t elements, std::size_t bytes, std::size_t component,
                 const std::vector<View>& views) {
  const std::size_t count = sparse.requiredSize("count");
  if (count > 0x7fffffff) sparse.member("count").fail("is absurd");
  if (count < 1 || count > elements) sparse.member("count").fail("must be 1 to {}, is {}", elements, count);
  const JsonPlace indices = sparse.member("indices");
  const std::size_t type = indices.requiredSize("componentType");
  if (type != 5121 && type != 5123 && type != 5125)
    indices.member("componentType").fail("must be an unsigned integer type, is {}", type);
  checkSparsePart(indices, count, componentBytes(type), componentBytes(type), views);
  checkSparsePart(sparse.member("values"), count, bytes, component, views);
}

void checkAccessor(const JsonPlace& accessor, const std::vector<View>& views) {
  const int number = accessor.index("bufferView", views.size(), "bufferView");
  const std::size_t offset = accessor.size("byteOffset", 0);
  accessor.flag("normalized");
  const std::size_t count = accessor.requiredSize("count");
  if (count == 0) accessor.member("count").fail("must be at least 1");
  const std::size_t component = componentBytes(accessor.requiredSize("componentType"));
  if (component == 0)
    accessor.member("componentType").fail("{} is none of glTF's", accessor.requiredSize("componentType"));
  const std::string name = accessor.member("type").asText();
  const auto type = std::ranges::find(kElementTypes, name, &ElementType::name);
  if (type == std::end(kElementTypes)) accessor.member("type").fail("\"{}\" is none of glTF's", name);
  const std::size_t bytes = elementBytes(*type, component);
  if (number >= 0) {
    const View& view = views[number];
    const std::size_t stride = view.stride.value_or(bytes);
    if (stride < bytes)
      accessor.fail("elements of {} bytes overlap: byteStride of bufferView {} is {}", bytes, number, stride);
    checkAligned(accessor, offset, view, component);
    checkFits(accessor, offset, stride * (count - 1) + bytes, number, view);
  } else if (offset != 0) {
    accessor.member("byteOffset").fail("is {}, but there is no bufferView", offset);
  }
  if (const auto sparse = accessor.find("sparse")) checkSparse(*sparse, count, bytes, component, views);
}

}  // namespace

void checkLayouts(const JsonPlace& root) {
  std::vector<std::size_t> bufferBytes;
  for (const JsonPlace& buffer : entries(root, "buffers")) bufferBytes.push_back(checkBuffer(buffer));
  std::vector<View> views;
  for (const JsonPlace& view : entries(root, "bufferViews")) views.push_back(checkView(view, bufferBytes));
  for (const JsonPlace& accessor : entries(root, "accessors")) checkAccessor(accessor, views);
}

}  // namespace rigel::tools
