# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=... -D "FILES=name|path;..." -P embed_files.cmake: a C++ source with `page_file(name)`, the bytes of
# those files, so that an installed library needs none of them where it runs.
cmake_minimum_required(VERSION 3.25)
set(arrays "")
set(cases "")
set(number 0)
foreach(entry IN LISTS FILES)
  string(REPLACE "|" ";" parts "${entry}")
  list(GET parts 0 name)
  list(GET parts 1 path)
  file(READ "${path}" bytes HEX)
  string(REGEX REPLACE "(................................................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "const unsigned char kFile${number}[] = {\n${bytes}};\n")
  string(APPEND cases "  if (name == \"${name}\") {\n"
                      "    return {reinterpret_cast<const char*>(kFile${number}), sizeof kFile${number}};\n  }\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}.new"
     "// Made by cmake/embed_files.cmake.\n#include \"report/page_files.hpp\"\n\n#include <stdexcept>\n#include <string>\n\n"
     "namespace {\n${arrays}}  // namespace\n\n"
     "std::string_view vantage::detail::page_file(std::string_view name) {\n${cases}"
     "  throw std::logic_error(\"there is no page file \" + std::string(name));\n}\n")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
