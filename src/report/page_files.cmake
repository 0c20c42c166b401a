# SPDX-License-Identifier: MIT
# The page of a report and what draws in it become part of the library.
set(page_files "three.js|${VANTAGE_THREE_JS}" "OrbitControls.js|${VANTAGE_ORBIT_CONTROLS_JS}")
set(page_paths "${VANTAGE_THREE_JS}" "${VANTAGE_ORBIT_CONTROLS_JS}")
foreach(name page.html style.css colours.js layers.js scene.js plots.js page.js three_licence.txt
             evaluation.html evaluation.css evaluation.js)
  list(APPEND page_files "${name}|${CMAKE_CURRENT_SOURCE_DIR}/report/page/${name}")
  list(APPEND page_paths "${CMAKE_CURRENT_SOURCE_DIR}/report/page/${name}")
endforeach()
set(page_source "${CMAKE_CURRENT_BINARY_DIR}/report/page_files.cpp")
set(page_script "${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake")
add_custom_command(
  OUTPUT "${page_source}"
  COMMAND "${CMAKE_COMMAND}" -D "OUTPUT=${page_source}" -D "FILES=${page_files}" -P "${page_script}"
  DEPENDS ${page_paths} "${page_script}"
  COMMENT "Embedding the page of a report"
  VERBATIM)
target_sources(vantage_report PRIVATE "${page_source}")
