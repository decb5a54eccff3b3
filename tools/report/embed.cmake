# Writes the files of a list into one C++ source that defines rigel::tools::pageFiles(), or another such function.
# cmake -DOUTPUT=page_files.cpp "-DFILES=a.html;b.css" [-DFUNCTION=paretoPageFiles] -P embed.cmake
if(NOT DEFINED FUNCTION)
  set(FUNCTION pageFiles)
endif()
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" content)
  string(FIND "${content}" ")page\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${file} holds the end mark of its raw string")
  endif()
  string(APPEND entries "    {\"${name}\", R\"page(${content})page\"sv},\n")
endforeach()
file(WRITE "${OUTPUT}"
  "#include \"report/formats/page_files.h\"\n\n"
  "namespace rigel::tools {\n\n"
  "std::span<const PageFile> ${FUNCTION}() noexcept {\n"
  "  using namespace std::string_view_literals;  // which count nothing when they are compiled, however long they are\n"
  "  static constexpr PageFile kFiles[] = {\n${entries}  };\n"
  "  return kFiles;\n"
  "}\n\n"
  "}  // namespace rigel::tools\n")
