# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=... -D "FILES=name|path;..." -P embed_files.cmake
# Writes a C++ source with `page_file(name)`, which returns the bytes of these files. So the installed library does not
# need them at run time.
cmake_minimum_required(VERSION 3.22...3.25)
set(pieces "")
set(cases "")
set(number 0)
set(piece_digits 64000)  # hexadecimal digits per literal: compilers need not support literals above 65536 bytes
foreach(entry IN LISTS FILES)
  string(REPLACE "|" ";" parts "${entry}")
  list(GET parts 0 name)
  list(GET parts 1 path)
  file(READ "${path}" digits HEX)
  string(LENGTH "${digits}" length)
  string(APPEND pieces "constexpr std::string_view kFile${number}[] = {\n")
  set(from 0)
  while(from LESS length)
    string(SUBSTRING "${digits}" ${from} ${piece_digits} piece)
    string(LENGTH "${piece}" bytes)
    math(EXPR bytes "${bytes} / 2")
    string(REGEX REPLACE "(..)" "\\\\x\\1" piece "${piece}")
    string(APPEND pieces "    {\"${piece}\", ${bytes}},\n")
    math(EXPR from "${from} + ${piece_digits}")
  endwhile()
  string(APPEND pieces "};\n")
  string(APPEND cases "  if (name == \"${name}\") {\n    return joined(kFile${number});\n  }\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}.new"
     "// Made by cmake/embed_files.cmake.\n#include \"report/page_files.hpp\"\n\n#include <span>\n#include <stdexcept>\n\n"
     "namespace {\n\n${pieces}\n"
     "std::string joined(std::span<const std::string_view> pieces) {\n  std::string whole;\n"
     "  for (const std::string_view piece : pieces) {\n    whole += piece;\n  }\n  return whole;\n}\n\n}  // namespace\n\n"
     "std::string vantage::detail::page_file(std::string_view name) {\n${cases}"
     "  throw std::logic_error(\"there is no page file \" + std::string(name));\n}\n")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
