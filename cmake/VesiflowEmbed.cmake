# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# vesiflow_embed(TARGET NAMESPACE FUNCTION FILE): std::string NAMESPACE::FUNCTION(), the contents of the file, in a source made when the file
# changes; FILE may be empty, and so is then the text. FUNCTION_sha256() is its SHA-256.
# As a script (cmake -P) it makes the source.
if(CMAKE_SCRIPT_MODE_FILE)
  set(text "")
  set(digest "")
  if(NOT FILE STREQUAL "")
    file(READ "${FILE}" text)
    file(SHA256 "${FILE}" digest)
  endif()
  # Compilers take literals of any length, but some no longer ones than 64 kB.
  set(piece 16000)
  string(LENGTH "${text}" length)
  string(CONCAT source "// Made by cmake/VesiflowEmbed.cmake.\n#include <string>\n\nnamespace ${NAMESPACE} {\n\n"
    "std::string ${FUNCTION}_sha256();\nstd::string ${FUNCTION}_sha256() {\n  return \"${digest}\";\n}\n\n"
    "std::string ${FUNCTION}();\nstd::string ${FUNCTION}() {\n  std::string text;\n  text.reserve(${length});\n")
  file(WRITE "${OUTPUT}" "${source}")
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} ${piece} part)
    file(APPEND "${OUTPUT}" "  text += R\"__vesiflow(${part})__vesiflow\";\n")
    math(EXPR begin "${begin} + ${piece}")
  endwhile()
  file(APPEND "${OUTPUT}" "  return text;\n}\n\n}  // namespace ${NAMESPACE}\n")
  return()
endif()

set(VESIFLOW_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(vesiflow_embed target namespace function file)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${function}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DFILE=${file}" -DNAMESPACE=${namespace} -DFUNCTION=${function} -DOUTPUT=${output}
            -P ${VESIFLOW_EMBED_SCRIPT}
    DEPENDS ${file} ${VESIFLOW_EMBED_SCRIPT} VERBATIM)
  target_sources(${target} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
