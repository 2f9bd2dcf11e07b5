# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# equilibrium_shapes: what finds equilibrium shapes, as objects without SUNDIALS's methods. The app of that name and the Python package are
# made of them. Whoever links them has either sundials/ or without_sundials/ too.
set(VESIFLOW_EQUILIBRIUM_FOLDER ${CMAKE_CURRENT_LIST_DIR}/equilibrium_shape)
if(NOT TARGET equilibrium_shapes)
  set(sources constrained_energy equilibrium gradient_flow meridian method newton stationarity)
  list(TRANSFORM sources PREPEND ${VESIFLOW_EQUILIBRIUM_FOLDER}/)
  list(TRANSFORM sources APPEND .cpp)
  add_library(equilibrium_shapes OBJECT ${sources})
  vesiflow_compile_options(equilibrium_shapes)
  vesiflow_compile_quickly(equilibrium_shapes)
  set_target_properties(equilibrium_shapes PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(equilibrium_shapes PUBLIC ${VESIFLOW_EQUILIBRIUM_FOLDER})
  target_link_libraries(equilibrium_shapes PUBLIC Vesiflow::vesicle PRIVATE fmt::fmt)
  # Has the eigenvalues of dense matrices.
  set_source_files_properties(${VESIFLOW_EQUILIBRIUM_FOLDER}/newton.cpp
    PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3> SKIP_PRECOMPILE_HEADERS ON)
  vesiflow_precompile(equilibrium_shapes <fmt/format.h> <vesicle/surface.h>)
endif()
