# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# SUNDIALS, the parts asked for as components: targets SUNDIALS::arkode, SUNDIALS::kinsol, SUNDIALS::cvode. Each of these libraries brings the
# serial vectors and dense solvers along. (The package's own configuration file asks for OpenMP in C, which projects that
# enable C++ only cannot answer.)
find_path(SUNDIALS_INCLUDE_DIR sundials/sundials_config.h)
set(SUNDIALS_LIBRARIES_NEEDED "")
foreach(component IN LISTS SUNDIALS_FIND_COMPONENTS)
  find_library(SUNDIALS_${component}_LIBRARY sundials_${component})
  list(APPEND SUNDIALS_LIBRARIES_NEEDED SUNDIALS_${component}_LIBRARY)
  mark_as_advanced(SUNDIALS_${component}_LIBRARY)
endforeach()
if(SUNDIALS_INCLUDE_DIR)
  file(STRINGS ${SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h version_line REGEX "define SUNDIALS_VERSION \"")
  string(REGEX MATCH "[0-9]+(\\.[0-9]+)+" SUNDIALS_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SUNDIALS REQUIRED_VARS ${SUNDIALS_LIBRARIES_NEEDED} SUNDIALS_INCLUDE_DIR
  VERSION_VAR SUNDIALS_VERSION HANDLE_VERSION_RANGE
  REASON_FAILURE_MESSAGE "install SUNDIALS 6.4 or a later 6 (Debian: libsundials-dev), or configure with -DVESIFLOW_WITH_SUNDIALS=OFF")
mark_as_advanced(SUNDIALS_INCLUDE_DIR)
if(SUNDIALS_FOUND)
  foreach(component IN LISTS SUNDIALS_FIND_COMPONENTS)
    if(NOT TARGET SUNDIALS::${component})
      add_library(SUNDIALS::${component} UNKNOWN IMPORTED)
      set_target_properties(SUNDIALS::${component} PROPERTIES
        IMPORTED_LOCATION "${SUNDIALS_${component}_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${SUNDIALS_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
