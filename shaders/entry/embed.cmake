# Writes SPIR-V files into one C++ source that defines rigel::shaderBinary().
# cmake -DOUTPUT=shader_binaries.cpp "-DFILES=a.spv;b.spv" -P embed.cmake
set(arrays "")
set(entries "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  string(REGEX REPLACE "\\.spv$" "" name "${name}")
  file(READ "${file}" content HEX)
  # Words are little-endian in the file.
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${content}")
  string(REGEX REPLACE "(0x........,0x........,0x........,0x........,0x........,0x........,0x........,0x........,)" "\\1\n" words
    "${words}")
  string(APPEND arrays "constexpr std::uint32_t kWords${number}[] = {\n${words}};\n")
  string(APPEND entries "    {\"${name}\", kWords${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}"
  "#include \"shader_binaries.h\"\n\n"
  "namespace rigel {\n"
  "namespace {\n\n"
  "${arrays}\n"
  "struct Entry {\n  std::string_view name;\n  std::span<const std::uint32_t> words;\n};\n"
  "constexpr Entry kEntries[] = {\n${entries}};\n\n"
  "}  // namespace\n\n"
  "std::span<const std::uint32_t> shaderBinary(std::string_view name) noexcept {\n"
  "  for (const Entry& entry : kEntries)\n"
  "    if (entry.name == name) return entry.words;\n"
  "  return {};\n"
  "}\n\n"
  "}  // namespace rigel\n")
