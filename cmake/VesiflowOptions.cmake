# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Every choice a builder has, in one place. (And CMake's BUILD_SHARED_LIBS: shared libraries show only what their headers mark as public,
# unless tests, benchmarks or fuzz targets are built, which link to private parts.)
set(VESIFLOW_LIBRARIES "vesicle;fluid;coupling;run" CACHE STRING
  "Libraries to build: any of vesicle, fluid, coupling (which needs these two) and run (which needs all three)")
set(VESIFLOW_ARCH "native" CACHE STRING
  "Processors to compile for, as -march= names them: native (this machine), x86-64-v3 ...; empty: all that the compiler's default covers")
option(VESIFLOW_NATIVE "Let VESIFLOW_ARCH be native; OFF makes that empty" ON)
option(VESIFLOW_WITH_HDF5 "Write snapshots and checkpoints with HDF5 (librun)" ON)
option(VESIFLOW_WITH_CHOLMOD "Build the sparse direct solver, for small elliptic problems (libfluid)" ON)
set(VESIFLOW_WITH_SUNDIALS "AUTO" CACHE STRING
  "Build what uses SUNDIALS: time.markers = arkode and implicit (libcoupling), methods kinsol and cvode (app equilibrium_shape): ON, OFF, or AUTO, if SUNDIALS is found")
option(VESIFLOW_WERROR "Treat compiler warnings as errors" OFF)
set(VESIFLOW_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize= names them: address,undefined or thread")
option(VESIFLOW_COVERAGE "Build with coverage counters" OFF)
option(VESIFLOW_BUILD_APPS "Build the apps whose libraries are built" ${PROJECT_IS_TOP_LEVEL})
set(VESIFLOW_BUILD_TESTS AUTO CACHE STRING "Build the tests: ON, OFF, or AUTO, if GoogleTest is found and no other project includes this one")
set(VESIFLOW_BATCH 1 CACHE STRING
  "How many sources are compiled as one: 8 take two thirds of the time of 1, and 1 sees what each forgets to include")
set(VESIFLOW_BUILD_PYTHON AUTO CACHE STRING
  "Build the Python package: ON, OFF, or AUTO, if pybind11 and the headers of Python are found, without sanitizers and no other project includes this one")
set(VESIFLOW_BUILD_BENCH OFF CACHE STRING "Build the benchmarks: ON, OFF, or AUTO, if Google Benchmark is found")
option(VESIFLOW_BUILD_FUZZ "Build the fuzz targets, and all else with coverage counters (clang only)" OFF)

if(VESIFLOW_ARCH STREQUAL "native" AND NOT VESIFLOW_NATIVE)
  set(VESIFLOW_ARCH "")
endif()

set(coupling_needs vesicle fluid)
set(run_needs vesicle fluid coupling)
foreach(library coupling run)
  foreach(needed IN LISTS ${library}_needs)
    if(library IN_LIST VESIFLOW_LIBRARIES AND NOT needed IN_LIST VESIFLOW_LIBRARIES)
      message(FATAL_ERROR "VESIFLOW_LIBRARIES: ${library} needs ${needed}; add it to the list")
    endif()
  endforeach()
endforeach()

# vesiflow_resolve_auto(OPTION LOST PACKAGE ...): an option that is AUTO becomes ON where find_package(PACKAGE ...) finds something; elsewhere
# OFF, with a line that says what is lost. ON where nothing is found is an error.
function(vesiflow_resolve_auto option lost package)
  if(NOT ${option})
    return()
  endif()
  find_package(${package} QUIET ${ARGN})
  if(${package}_FOUND)
    set(${option} ON PARENT_SCOPE)
  elseif(${option} STREQUAL "AUTO")
    set(${option} OFF PARENT_SCOPE)
    message(STATUS "${package} is not there, so there are no ${lost} (scripts/install-deps.sh --test installs it; then configure again)")
  else()
    message(FATAL_ERROR "${option}=${${option}}: ${package} is not there; scripts/install-deps.sh --test installs it, and with AUTO or OFF "
      "the build goes without ${lost}")
  endif()
endfunction()

if("coupling" IN_LIST VESIFLOW_LIBRARIES OR ("vesicle" IN_LIST VESIFLOW_LIBRARIES AND VESIFLOW_BUILD_APPS))
  vesiflow_resolve_auto(VESIFLOW_WITH_SUNDIALS "time.markers = arkode and implicit and no methods kinsol and cvode"
    SUNDIALS 6.4...<7 COMPONENTS arkode kinsol cvode)
endif()
if(VESIFLOW_BUILD_TESTS STREQUAL "AUTO" AND NOT PROJECT_IS_TOP_LEVEL)
  set(VESIFLOW_BUILD_TESTS OFF)
endif()
vesiflow_resolve_auto(VESIFLOW_BUILD_TESTS "tests" GTest)
if(VESIFLOW_BUILD_PYTHON STREQUAL "AUTO" AND
   (NOT PROJECT_IS_TOP_LEVEL OR VESIFLOW_SANITIZE OR VESIFLOW_COVERAGE OR NOT "run" IN_LIST VESIFLOW_LIBRARIES))
  set(VESIFLOW_BUILD_PYTHON OFF)
endif()
if(VESIFLOW_BUILD_PYTHON)
  if(NOT "run" IN_LIST VESIFLOW_LIBRARIES)
    message(FATAL_ERROR "VESIFLOW_BUILD_PYTHON: the package is of all libraries; VESIFLOW_LIBRARIES is ${VESIFLOW_LIBRARIES}")
  endif()
  # The distribution's python has the packages that scripts/python.sh looks for; another one in PATH may hide it.
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  set(PYBIND11_FINDPYTHON ON)
  set(wanted ${VESIFLOW_BUILD_PYTHON})
  vesiflow_resolve_auto(VESIFLOW_BUILD_PYTHON "modules of the Python package" Python 3.9 COMPONENTS Interpreter Development.Module)
  if(VESIFLOW_BUILD_PYTHON)
    find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)  # its commands and targets are of this folder
    set(VESIFLOW_BUILD_PYTHON ${wanted})
    vesiflow_resolve_auto(VESIFLOW_BUILD_PYTHON "modules of the Python package" pybind11 2.10)
  endif()
endif()
vesiflow_resolve_auto(VESIFLOW_BUILD_BENCH "benchmarks" benchmark)

if(VESIFLOW_BUILD_FUZZ AND NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND VESIFLOW_SANITIZE))
  message(FATAL_ERROR "VESIFLOW_BUILD_FUZZ needs clang and VESIFLOW_SANITIZE: configure with --preset fuzz")
endif()

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
if(VESIFLOW_BATCH GREATER 1)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE ${VESIFLOW_BATCH})
endif()
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()
