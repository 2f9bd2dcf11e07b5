# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# vesiflow_library(NAME): the target vesiflow_NAME, for users Vesiflow::NAME, from lib<NAME>/include and lib<NAME>/src, with the
# project's language level, warnings and code generation. Callers add sources and link dependencies.
include(GNUInstallDirs)
set(VESIFLOW_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Vesiflow)

function(vesiflow_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
    -fno-math-errno -fno-trapping-math
    $<$<CONFIG:Release>:-O3>
    # It knows no GCC ivdep, and tells of loops that it does not vectorise.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-pragmas> $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>
    $<$<BOOL:${VESIFLOW_ARCH}>:-march=${VESIFLOW_ARCH}>
    # GCC 12.0 to 12.2 make the undefined registers in their own headers of AVX-512 as `__m512d y = y` and then warn of it wherever
    # that is inlined (GCC bug 105593). Without this warning such a line is taken as meant; all else uninitialised is still found.
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,12.3>>:-Wno-init-self>
    # Sources that are compiled as one look to GCC like one header, whose types of one file must not be members of others; and what is
    # local in one hides nothing but names of the others.
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage$<SEMICOLON>-Wno-shadow$<SEMICOLON>-Wshadow=local>
    $<$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-shadow>
    $<$<BOOL:${VESIFLOW_WERROR}>:-Werror>
    $<$<BOOL:${VESIFLOW_COVERAGE}>:--coverage>)
  if(VESIFLOW_SANITIZE)
    # libFuzzer learns from counters that go with the sanitizers.
    target_compile_options(${target} PRIVATE
      -fsanitize=$<$<BOOL:${VESIFLOW_BUILD_FUZZ}>:fuzzer-no-link,>${VESIFLOW_SANITIZE} -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${VESIFLOW_SANITIZE})
  endif()
  if(VESIFLOW_COVERAGE)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()

# vesiflow_compile_quickly(TARGET): for sources without loops that matter, such as tests and command lines: compiled in half the time.
function(vesiflow_compile_quickly target)
  # GCC 12 follows values less far at -O1, and then takes the contents of an empty std::optional for used.
  target_compile_options(${target} PRIVATE
    $<$<CONFIG:Release>:-O1> $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
endfunction()

# vesiflow_precompile(TARGET HEADER...): reads headers that most sources of the target include once for all of them, which is more than
# half of the time of compiling one. Not with a compiler launcher: ccache would have nothing to find again. Such builds, and
# scripts/check_headers.sh, see what a source forgets to include.
function(vesiflow_precompile target)
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER AND NOT CMAKE_CXX_CLANG_TIDY)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

function(vesiflow_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES")
  set(target vesiflow_${name})  # "fluid" alone could meet a target of the project that includes us
  add_library(${target} ${arg_SOURCES})
  add_library(Vesiflow::${name} ALIAS ${target})
  vesiflow_compile_options(${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    POSITION_INDEPENDENT_CODE ON)
  if(BUILD_SHARED_LIBS)
    # What is not marked as in <NAME/export.h> stays inside, except from tests, which link to it.
    if(NOT VESIFLOW_BUILD_TESTS AND NOT VESIFLOW_BUILD_BENCH AND NOT VESIFLOW_BUILD_FUZZ)
      set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    endif()
  else()
    target_compile_definitions(${target} PUBLIC VESIFLOW_STATIC)
  endif()
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>  # vesiflow/version.h
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/vesiflow>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/common)
  target_link_libraries(${target} PRIVATE ${CMAKE_DL_LIBS})  # of common/short_waits.cpp
  # Each library has this one; a program takes it from one of them, if it is an object of its own.
  set_source_files_properties(${PROJECT_SOURCE_DIR}/common/short_waits.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # An install takes what is built. This return leaves the library's own script of the install, and so skips what follows.
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
    message(STATUS \"lib${name} is not built, so it is not installed\")
    return()
  endif()")
  install(TARGETS ${target} EXPORT Vesiflow_${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vesiflow)
  install(FILES ${PROJECT_BINARY_DIR}/include/vesiflow/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vesiflow/vesiflow)
  install(FILES ${PROJECT_BINARY_DIR}/vesiflow-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  install(EXPORT Vesiflow_${name} NAMESPACE Vesiflow:: DESTINATION ${VESIFLOW_CONFIG_DIR})
  install(FILES ${PROJECT_BINARY_DIR}/Vesiflow_${name}_needs.cmake DESTINATION ${VESIFLOW_CONFIG_DIR})  # by VesiflowInstall.cmake
endfunction()
