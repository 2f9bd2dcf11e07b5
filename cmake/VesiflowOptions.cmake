# Every choice a builder has, in one place.
set(VESIFLOW_LIBRARIES "vesicle;fluid;coupling" CACHE STRING
  "Libraries to build: any of vesicle, fluid, coupling (coupling needs the other two)")
set(VESIFLOW_ARCH "native" CACHE STRING
  "Processors to compile for, as -march= names them: native (this machine), x86-64-v3 ...; empty: all that the compiler's default covers")
option(VESIFLOW_NATIVE "Let VESIFLOW_ARCH be native; OFF makes that empty" ON)
option(VESIFLOW_WITH_HDF5 "Write snapshots and checkpoints with HDF5 (libcoupling)" ON)
option(VESIFLOW_WITH_CHOLMOD "Build the sparse direct solver, for small elliptic problems (libfluid)" ON)
set(VESIFLOW_WITH_SUNDIALS "AUTO" CACHE STRING
  "Build what uses SUNDIALS: time.markers = arkode and implicit (libcoupling), methods kinsol and cvode (app equilibrium_shape): ON, OFF, or AUTO, if SUNDIALS is found")
set_property(CACHE VESIFLOW_WITH_SUNDIALS PROPERTY STRINGS AUTO ON OFF)
option(VESIFLOW_WERROR "Treat compiler warnings as errors" OFF)
set(VESIFLOW_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize= names them: address,undefined or thread")
option(VESIFLOW_COVERAGE "Build with coverage counters" OFF)
option(VESIFLOW_BUILD_APPS "Build the apps whose libraries are built" ${PROJECT_IS_TOP_LEVEL})
option(VESIFLOW_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(VESIFLOW_BUILD_BENCH "Build the benchmarks" OFF)
option(VESIFLOW_BUILD_FUZZ "Build the fuzz targets, and all else with coverage counters (clang only)" OFF)

if(VESIFLOW_ARCH STREQUAL "native" AND NOT VESIFLOW_NATIVE)
  set(VESIFLOW_ARCH "")
endif()

if("coupling" IN_LIST VESIFLOW_LIBRARIES)
  foreach(needed vesicle fluid)
    if(NOT needed IN_LIST VESIFLOW_LIBRARIES)
      message(FATAL_ERROR "VESIFLOW_LIBRARIES: coupling needs ${needed}; add it to the list")
    endif()
  endforeach()
endif()

if(VESIFLOW_WITH_SUNDIALS STREQUAL "AUTO")
  set(VESIFLOW_WITH_SUNDIALS OFF)
  if("coupling" IN_LIST VESIFLOW_LIBRARIES OR (VESIFLOW_BUILD_APPS AND "vesicle" IN_LIST VESIFLOW_LIBRARIES))
    find_package(SUNDIALS 6...<7 QUIET COMPONENTS arkode kinsol cvode)
    if(SUNDIALS_FOUND)
      set(VESIFLOW_WITH_SUNDIALS ON)
    else()
      message(STATUS "SUNDIALS 6 is not there, so this build refuses time.markers = arkode and implicit and the methods kinsol and "
        "cvode of equilibrium_shape; to have them, install it (Debian: libsundials-dev) and configure again")
    endif()
  endif()
endif()

if(VESIFLOW_BUILD_FUZZ AND NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND VESIFLOW_SANITIZE))
  message(FATAL_ERROR "VESIFLOW_BUILD_FUZZ needs clang and VESIFLOW_SANITIZE: configure with --preset fuzz")
endif()

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()
