# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# vesiflow_describe_build(NAME): gives the library its functions version() and built_with(). What is built in is read off the target,
# and gathered for vesiflow/version.h as have_OpenMP, have_CHOLMOD ...: 1 or 0.
foreach(package OpenMP CHOLMOD SUNDIALS HDF5C)
  set(have_${package} 0)
endforeach()

macro(vesiflow_describe_build name)
  get_target_property(linked_by_${name} vesiflow_${name} LINK_LIBRARIES)
  set(built_with "")
  foreach(package OpenMP CHOLMOD SUNDIALS HDF5C)
    if("${linked_by_${name}}" MATCHES "${package}::")
      set(have_${package} 1)
      list(APPEND built_with ${package})
    endif()
  endforeach()
  list(TRANSFORM built_with REPLACE "HDF5C" "HDF5")
  list(APPEND built_with ${VESIFLOW_ARCH})
  list(JOIN built_with ", " built_with)
  set(library ${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/version.cpp.in ${PROJECT_BINARY_DIR}/lib${name}/version.cpp @ONLY)
  target_sources(vesiflow_${name} PRIVATE ${PROJECT_BINARY_DIR}/lib${name}/version.cpp)
endmacro()
