# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# The package behind find_package(Vesiflow COMPONENTS ...): one export set per library, so that a component can
# be installed without the others and asks for its own dependencies only. (The libraries' own files: vesiflow_library().)
include(CMakePackageConfigHelpers)
include(VesiflowVersion)
include(VesiflowPkgConfig)
set(find_modules "")

# How a consumer finds what the exported targets link to, by namespace of the target.
set(package_Eigen3 "Eigen3 3.4 NO_MODULE")
set(package_FFTW3 "FFTW3")
set(package_OpenMP "OpenMP COMPONENTS CXX")
set(package_CHOLMOD "CHOLMOD")
set(package_HDF5C "HDF5C")
set(package_SUNDIALS "SUNDIALS COMPONENTS arkode kinsol")
set(package_XxHash "XxHash")
set(package_spdlog "spdlog")
set(package_fmt "fmt")
set(package_tomlplusplus "tomlplusplus")

foreach(library IN LISTS VESIFLOW_LIBRARIES)
  # Read off the target, so that options and static against shared need no case here: a shared library links its
  # private dependencies itself, a static one leaves them to its consumer as $<LINK_ONLY:...>.
  get_target_property(linked vesiflow_${library} INTERFACE_LINK_LIBRARIES)
  set(needs "")
  foreach(item IN LISTS linked)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" item "${item}")
    if(item MATCHES "^([A-Za-z0-9]+)::" AND NOT CMAKE_MATCH_1 STREQUAL "Vesiflow")
      if(NOT DEFINED package_${CMAKE_MATCH_1})
        message(FATAL_ERROR "lib${library} links to ${item}: say in VesiflowInstall.cmake how a consumer finds it, "
          "or link it as $<BUILD_INTERFACE:${item}> if it is private and headers only")
      endif()
      list(APPEND needs "${package_${CMAKE_MATCH_1}}")
      list(APPEND find_modules ${CMAKE_CURRENT_LIST_DIR}/Find${CMAKE_MATCH_1}.cmake)
    endif()
  endforeach()
  list(REMOVE_DUPLICATES needs)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/Vesiflow_${library}_needs.cmake
    CONTENT "set(Vesiflow_${library}_needs \"${needs}\")\n")
  set_target_properties(vesiflow_${library} PROPERTIES INSTALL_RPATH "$ORIGIN")  # shared libraries find their siblings
  vesiflow_describe_build(${library})
  vesiflow_pkg_config(${library})
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.h.in ${PROJECT_BINARY_DIR}/include/vesiflow/version.h @ONLY)

# Of the modules that find these packages, some are ours.
list(REMOVE_DUPLICATES find_modules)
foreach(module IN LISTS find_modules)
  if(EXISTS ${module})
    install(FILES ${module} DESTINATION ${VESIFLOW_CONFIG_DIR})
  endif()
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/VesiflowConfig.cmake.in
  ${PROJECT_BINARY_DIR}/VesiflowConfig.cmake INSTALL_DESTINATION ${VESIFLOW_CONFIG_DIR}
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/VesiflowConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/VesiflowConfig.cmake ${PROJECT_BINARY_DIR}/VesiflowConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/VesiflowComponents.cmake
  DESTINATION ${VESIFLOW_CONFIG_DIR})
