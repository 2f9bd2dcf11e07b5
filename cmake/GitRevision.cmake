# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# vesiflow_git_revision(TARGET): a header build_info.h with the git revision, made afresh at
# every build so that results name the code that produced them. "unknown" outside a git checkout.
function(vesiflow_git_revision target)
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/generated)
  add_custom_target(${target}_build_info
    COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR}
            -D OUTPUT=${directory}/build_info.h -P ${PROJECT_SOURCE_DIR}/cmake/WriteBuildInfo.cmake
    BYPRODUCTS ${directory}/build_info.h)
  add_dependencies(${target} ${target}_build_info)
  target_include_directories(${target} PRIVATE ${directory})
endfunction()
